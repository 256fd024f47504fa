// Frames for walking: what they keep is what they would find anew, nothing is left where it no longer is, and their
 // light is that of meters.
#include "gather/quick_frames.h"

#include <gtest/gtest.h>

#include <cmath>

#include "engine/lit_scene.h"
#include "support/rooms.h"

namespace roomlight {
namespace {

constexpr int kWidth = 192, kHeight = 108;
constexpr double kPlenty = 1e5;  // ms: everything is lit at once

class QuickFramesTest : public ::testing::Test {
 protected:
  Scene scene_;
  uint32_t firstOfBox_ = 0;
  std::unique_ptr<LitScene> lit_;
  std::shared_ptr<const SlotSnapshot> light_;
  std::unordered_map<uint32_t, Affine> moved_;
  RenderStats stats_;
  RenderProgress silent_;
  Stages stages_{silent_, stats_};

  void SetUp() override {
    const auto coloured = [&](Vec3 colour) {
      Material m = test::lambertian(0.5f);
      m.baseColor = colour;
      return test::addMaterial(scene_, m);
    };
    const int white = coloured(Vec3(0.7f)), green = coloured({0.1f, 0.6f, 0.1f}), red = coloured({0.7f, 0.05f, 0.05f});
    std::vector<int> walls(6, white);
    walls[4] = walls[5] = green;
    test::addRoom(scene_, {0, 0, 0}, {4, 2.6f, 5}, walls);
    firstOfBox_ = static_cast<uint32_t>(scene_.instances.size());
    test::addBox(scene_, {1.52f, 0.41f, 1.53f}, {2.43f, 1.17f, 2.04f}, red);
    scene_.lamps = {test::pointLamp({3.1f, 2.2f, 3.9f}, 80), test::pointLamp({0.6f, 2.2f, 4.1f}, 20)};
    light();
  }
  void light() {
    RenderSettings s;
    s.voxel.voxelSizeM = 0.15f;
    s.radiance.links = 64;
    lit_ = lightScene(scene_, s, stages_).value();
    light_ = lit_->snapshot();
  }
  void addRoomBeside() {
    Material blue = test::lambertian(0.5f);
    blue.baseColor = {0.2f, 0.2f, 0.7f};
    test::addRoom(scene_, {4.2f, 0, 0}, {8.2f, 2.6f, 5}, std::vector<int>(6, test::addMaterial(scene_, blue)));
    scene_.lamps.push_back(test::pointLamp({6.2f, 2.2f, 2.5f}, 60));
    light();
  }
  // Towards the first room.
  static Camera beside(float x) {
    Camera c;
    c.worldFromCamera = looking({x, 1.5f, 2.4f}, {-1, -0.1f, 0.05f});
    return c;
  }
  Camera camera(float x) const {
    Camera c;
    c.worldFromCamera = looking({x, 1.5f, 4.6f}, {0.1f, -0.2f, -1});
    return c;
  }
  Image frame(QuickFrames& frames, const Camera& c, double ms = kPlenty, int width = kWidth, int height = kHeight) {
    return frames.make({lit_->rays(), lit_->lights(), *light_, moved_}, c, width, height, ms);
  }
  Image fresh(const Camera& c) {
    QuickFrames frames;
    for (int i = 0; i < 20; ++i) frame(frames, c);
    return frame(frames, c);
  }
  // Share of pixels that are off by more than a tenth, those beside edges included.
  static double off(const Image& a, const Image& b) {
    double wrong = 0;
    for (size_t i = 0; i < a.pixels.size(); ++i)
      wrong += std::abs(luminance(a.pixels[i]) - luminance(b.pixels[i])) > 0.1f * luminance(b.pixels[i]);
    return wrong / static_cast<double>(a.pixels.size());
  }
  static double meanOf(const Image& a) {
    double sum = 0;
    for (const Vec3& p : a.pixels) sum += static_cast<double>(luminance(p));
    return sum / static_cast<double>(a.pixels.size());
  }
};

TEST_F(QuickFramesTest, theSnapshotTellsWhatMetersRead) {
  std::vector<SurfaceElement> places;
  for (int i = 0; i < 12; ++i) places.push_back({{0.5f + 0.25f * static_cast<float>(i), 0, 3.4f}, {0, 1, 0}});
  const std::vector<MeterReading> read = lit_->illuminance(places, {});
  double sum = 0;
  for (size_t i = 0; i < places.size(); ++i) {
    const SlotIrradiance e = light_->at(places[i].position, places[i].normal);
    ASSERT_TRUE(e.found);
    EXPECT_NEAR(luminance(e.soft + e.sharp) / luminance(read[i].illuminanceLux), 1, 0.12) << i;
    // No lamp is hidden there: the inverse square law.
    float direct = 0;
    for (const Lamp& lamp : scene_.lamps) {
      const Vec3 way = lamp.position - places[i].position;
      direct += luminance(lamp.intensityCd) * way.y / std::pow(length(way), 3.0f);
    }
    EXPECT_NEAR(luminance(e.sharp) / direct, 1, 0.05) << i;
    sum += static_cast<double>(luminance(e.soft + e.sharp) / luminance(read[i].illuminanceLux)) / 12;
  }
  EXPECT_NEAR(sum, 1, 0.03);
}

TEST_F(QuickFramesTest, theSnapshotKeepsTheSidesOfAWallApart) {
  EXPECT_FALSE(light_->at({2, 1.3f, -0.5f}, {0, 0, 1}).found);
  EXPECT_EQ(luminance(light_->at({2, 1.3f, 0}, {0, 0, -1}).sharp), 0);  // behind the wall nothing shines
}

TEST_F(QuickFramesTest, framesAreAsBrightAsPictures) {
  const Image picture = lit_->picture(camera(2), kWidth, kHeight);
  EXPECT_NEAR(meanOf(fresh(camera(2))) / meanOf(picture), 1, 0.03);
}

TEST_F(QuickFramesTest, aWalkEndsAtWhatIsFoundAnew) {
  QuickFrames frames;
  Image last;
  for (int i = 0; i <= 30; ++i) last = frame(frames, camera(1.4f + 0.02f * static_cast<float>(i)));
  EXPECT_LT(frames.count().traced, size_t{kWidth * kHeight / 4});  // most are kept
  const Image anew = fresh(camera(2));
  EXPECT_LT(off(last, anew), 0.04);
  EXPECT_NEAR(meanOf(last) / meanOf(anew), 1, 0.02);
}

TEST_F(QuickFramesTest, standingStillTheyComeToAnEnd) {
  QuickFrames frames;
  for (int i = 0; i < 200 && !frames.settled(); ++i) frame(frames, camera(2), 5);
  EXPECT_TRUE(frames.settled());
  EXPECT_LT(off(frame(frames, camera(2)), fresh(camera(2))), 0.03);
}

TEST_F(QuickFramesTest, whatMovedIsNotLeftBehind) {
  QuickFrames frames;
  for (int i = 0; i < 20; ++i) frame(frames, camera(2));
  const Image before = frame(frames, camera(2));
  SceneChange change;
  const float away = 1.0f;
  for (uint32_t i = firstOfBox_; i < scene_.instances.size(); ++i) {
    const Affine was = scene_.instances[i].worldFromObject;
    scene_.instances[i].worldFromObject.w += Vec3(away, 0, 0);
    change.moved.push_back(i);
    moved_[i] = was * inverse(scene_.instances[i].worldFromObject);
  }
  // As a session does: rays at once, slots not yet.
  SceneRays now(scene_, true, stages_);
  frames.sceneChanged(change, scene_);
  const QuickScene scene{now.rays(), now.lights(), *light_, moved_};
  Image after = frames.make(scene, camera(2), kWidth, kHeight, kPlenty);
  QuickFrames others;
  Image anew = others.make(scene, camera(2), kWidth, kHeight, kPlenty);
  EXPECT_GT(off(before, anew), 0.05);
  EXPECT_LT(off(after, anew), 0.02);
}

// Behind the wall of the first: what was seen there must not stand on that wall.
TEST_F(QuickFramesTest, afterAJumpToAnotherRoomNothingOfTheOldViewIsLeft) {
  addRoomBeside();
  QuickFrames frames;
  for (int i = 0; i < 20; ++i) frame(frames, camera(2));
  const Image first = frame(frames, beside(6.5f));
  QuickFrames others;
  EXPECT_EQ(off(first, frame(others, beside(6.5f))), 0);
  EXPECT_LT(off(frame(frames, beside(6.5f)), fresh(beside(6.5f))), 0.01);
}

// As the eye of `view` may: no step is far, and yet the old view is hidden soon.
TEST_F(QuickFramesTest, walkedThroughAWallNothingOfTheOldViewIsLeft) {
  addRoomBeside();
  QuickFrames frames;
  Image last;
  for (int i = 0; i <= 17; ++i) last = frame(frames, beside(3.5f + 0.05f * static_cast<float>(i)));
  EXPECT_LT(off(last, fresh(beside(4.35f))), 0.02);
}

// Of many small faces: the slots of their voxels are those of the board below, where it is dark.
TEST_F(QuickFramesTest, aClothCloseOverABoardIsNotBlack) {
  const int grey = test::addMaterial(scene_, test::lambertian(0.5f));
  test::addBox(scene_, {1.01f, 0.61f, 2.41f}, {2.99f, 0.7f, 3.99f}, grey);
  const Vec3 corner{1, 0.74f, 4}, x{2, 0, 0}, z{0, 0, -1.6f}, y{0, 0.14f, 0};
  test::addRectangle(scene_, corner, x, z, grey, 60);
  test::addRectangle(scene_, corner - y, x, y, grey);
  test::addRectangle(scene_, corner - y + z, y, x, grey);
  test::addRectangle(scene_, corner - y, y, z, grey);
  test::addRectangle(scene_, corner - y + x, z, y, grey);
  light();
  Camera down;
  down.worldFromCamera = looking({2, 2.3f, 3.3f}, {0.01f, -1, 0.02f});
  QuickFrames frames;
  const Image first = frame(frames, down, 5), picture = lit_->picture(down, kWidth, kHeight);
  size_t dark = 0;
  for (size_t i = 0; i < first.pixels.size(); ++i)
    dark += luminance(first.pixels[i]) < 0.3f * luminance(picture.pixels[i]);
  EXPECT_LT(dark, first.pixels.size() / 200);
}

TEST_F(QuickFramesTest, aDimmedLampShowsInTheNextFrame) {
  QuickFrames frames;
  for (int i = 0; i < 20; ++i) frame(frames, camera(2));
  const double before = meanOf(frame(frames, camera(2)));
  scene_.lamps[0].intensityCd = {}, scene_.lamps[1].intensityCd = {};
  SceneChange change;
  change.lamps = true;
  lit_->update(change, stages_);
  light_ = lit_->snapshot();
  frames.sceneChanged(change, scene_);
  frames.lightChanged();
  EXPECT_LT(meanOf(frame(frames, camera(2))), 1e-3 * before);
}

// There light comes by particles, on slots, and not by a shadow ray as well.
TEST_F(QuickFramesTest, besideALampTheyAreAsBrightAsPictures) {
  Camera up;
  up.worldFromCamera = looking({3.1f, 0.6f, 3.9f}, {0.01f, 1, 0.02f});
  up.yFovRad = 0.6f;
  const double now = meanOf(fresh(up)), picture = meanOf(lit_->picture(up, kWidth, kHeight));
  EXPECT_NEAR(now / picture, 1, 0.06);
}

// What an emissive mesh that was edited sends straight is there before its light has followed.
TEST_F(QuickFramesTest, anEditedEmissiveMeshIsAskedForItsLight) {
  scene_.lamps.clear();
  const int glowing = test::addMaterial(scene_, test::lambertian(0, 40000));
  const auto first = static_cast<uint32_t>(scene_.instances.size());
  test::addBox(scene_, {2.0f, 1.9f, 2.6f}, {2.06f, 1.96f, 2.66f}, glowing);
  SceneChange change;
  for (uint32_t i = first; i < scene_.instances.size(); ++i) change.glow.push_back(i);
  RenderSettings s;
  s.voxel.voxelSizeM = 0.15f;
  s.radiance.links = 64;
  s.radiance.emittersApart = true;
  lit_ = lightScene(scene_, s, stages_).value();
  light_ = lit_->snapshot();
  const double bySlots = meanOf(fresh(camera(2)));
  Vec3& emission = scene_.materials[static_cast<size_t>(glowing)].emission;
  emission *= 0.5f;
  lit_->update(change, stages_);
  light_ = lit_->snapshot();
  EXPECT_NEAR(meanOf(fresh(camera(2))) / bySlots, 0.5, 0.02);
  const Camera c = camera(2);
  const auto withLights = [&](const Lights& lights) {
    QuickFrames frames;
    return meanOf(frames.make({lit_->rays(), lights, *light_, moved_}, c, kWidth, kHeight, kPlenty));
  };
  const double before = withLights(Lights(scene_, true));
  emission *= 2;
  const double brighter = withLights(Lights(scene_, true));
  emission = {};
  const double dark = withLights(Lights(scene_, true));
  EXPECT_LT(dark, 0.75 * before);
  EXPECT_NEAR(brighter - before, before - dark, 0.05 * before);  // what is straight, once more
}

TEST_F(QuickFramesTest, framesOfAnotherSizeGoOnFromThoseBefore) {
  QuickFrames frames;
  for (int i = 0; i < 20; ++i) frame(frames, camera(2), kPlenty, kWidth / 2, kHeight / 2);
  const Image larger = frame(frames, camera(2));
  EXPECT_EQ(larger.width, kWidth);
  EXPECT_LT(frames.count().traced, size_t{kWidth * kHeight * 3 / 4});
  EXPECT_LT(off(larger, fresh(camera(2))), 0.1);
}

TEST_F(QuickFramesTest, coloursOfABetterPictureStay) {
  QuickFrames frames;
  frame(frames, camera(2));
  Image blue(kWidth, kHeight);
  std::fill(blue.pixels.begin(), blue.pixels.end(), Vec3(0, 0, 50));
  frames.adopt(blue);
  Image last;
  for (int i = 1; i <= 5; ++i) last = frame(frames, camera(2 + 0.01f * static_cast<float>(i)));
  size_t kept = 0;
  for (const Vec3& p : last.pixels) kept += p.z == 50 && p.x == 0;
  EXPECT_GT(kept, last.pixels.size() * 9 / 10);
}

// From above a closed room: its ceiling without a cut, what stands in it with one.
TEST_F(QuickFramesTest, framesSeeNothingAboveTheCut) {
  Camera above;
  above.worldFromCamera = looking({2, 7, 4}, {0, -1, -0.4f});
  const auto reds = [](const Image& image) {
    size_t count = 0;
    for (const Vec3 p : image.pixels) count += p.x > 2 * p.y && p.x > 0;
    return count;
  };
  QuickFrames frames;
  EXPECT_EQ(reds(frame(frames, above)), 0u);
  above.cutHeightM = 2.5f;
  const Image cut = frame(frames, above);
  EXPECT_GT(reds(cut), cut.pixels.size() / 200) << "the box";
  const Image fine = lit_->picture(above, kWidth, kHeight);
  EXPECT_NEAR(static_cast<double>(reds(cut)) / static_cast<double>(reds(fine)), 1, 0.2);
  above.cutHeightM = kInfinity;
  EXPECT_EQ(reds(frame(frames, above)), 0u) << "nothing is kept of what was seen through the cut";
}

// Each too faint to send a ray for; together they are a lamp like any other.
TEST_F(QuickFramesTest, manyFaintLampsAreAsBrightAsOne) {
  constexpr int kLamps = 150;
  const auto bright = [&](int lamps) {
    scene_.lamps.clear();
    for (int i = 0; i < lamps; ++i)
      scene_.lamps.push_back(
          test::pointLamp({3.1f + 1e-4f * static_cast<float>(i), 2.2f, 3.9f}, 80.0f / static_cast<float>(lamps)));
    RenderSettings s;
    s.voxel.voxelSizeM = 0.15f;
    lit_ = lightScene(scene_, s, stages_).value();
    light_ = lit_->snapshot();
    return meanOf(fresh(camera(2)));
  };
  const double one = bright(1), many = bright(kLamps);
  EXPECT_NEAR(many / one, 1, 0.03);
}

}  // namespace
}  // namespace roomlight
