// Frames that reuse the light of frames before: as right as pictures made anew, and less noisy; nothing is left where
 // it no longer is.
#include <gtest/gtest.h>

#include <cmath>

#include "base/parallel.h"
#include "engine/lit_scene.h"
#include "gather/frame.h"
#include "support/rooms.h"
#include "support/techniques.h"
#include "trace/camera_rays.h"

namespace roomlight {
namespace {

constexpr int kWidth = 64, kHeight = 40;

// A room with a red box before a green wall, and a lamp.
struct Home {
  Scene scene;
  uint32_t firstOfBox = 0;
  Home() {
    const auto coloured = [&](Vec3 colour) {
      Material m = test::lambertian(0.5f);
      m.baseColor = colour;
      return test::addMaterial(scene, m);
    };
    const int white = coloured(Vec3(0.7f)), green = coloured({0.1f, 0.6f, 0.1f}), red = coloured({0.7f, 0.05f, 0.05f});
    std::vector<int> walls(6, white);
    walls[4] = walls[5] = green;
    test::addRoom(scene, {0, 0, 0}, {4, 2.6f, 5}, walls);
    firstOfBox = static_cast<uint32_t>(scene.instances.size());
    test::addBox(scene, {1.52f, 0.41f, 1.53f}, {2.43f, 1.97f, 2.04f}, red);
    scene.lamps = {test::pointLamp({3.1f, 2.2f, 3.9f}, 80), test::pointLamp({0.6f, 2.2f, 4.1f}, 20)};
  }
};

RenderSettings small(const std::string& technique) {
  RenderSettings s;
  s.technique = technique;
  s.samples = 1;
  s.voxel.voxelSizeM = 0.15f;
  s.hybrid.tolerance = 0;
  s.vxgi.resolution = 32, s.vxgi.levels = 2;
  s.lpv.cells = 16, s.lpv.coarseCells = 0, s.lpv.mapSize = 64;
  s.photon.photons = 20000, s.photon.causticPhotons = 0, s.photon.importons = 1000;
  return s;
}

double rms(const Image& a, const Image& b, const std::vector<uint8_t>& where = {}) {
  double sum = 0, n = 0;
  for (size_t i = 0; i < a.pixels.size(); ++i) {
    if (!where.empty() && !where[i]) continue;
    const double d = luminance(a.pixels[i]) - luminance(b.pixels[i]);
    sum += d * d, n += 1;
  }
  return std::sqrt(sum / n);
}

double meanOf(const Image& a, const std::vector<uint8_t>& where = {}) {
  double sum = 0, n = 0;
  for (size_t i = 0; i < a.pixels.size(); ++i) {
    if (where.empty() || where[i]) sum += luminance(a.pixels[i]), n += 1;
  }
  return sum / n;
}

class Frames : public ::testing::TestWithParam<std::string> {
 protected:
  Home home_;
  RenderStats stats_;
  RenderProgress silent_;
  Stages stages_{silent_, stats_};

  RenderSettings settings(int samples = 1, int filterPasses = 5) const {
    RenderSettings s = small(GetParam());
    s.samples = samples;
    for (PictureSettings* p : {static_cast<PictureSettings*>(&s.hybrid), static_cast<PictureSettings*>(&s.cone),
                               static_cast<PictureSettings*>(&s.vxgi), static_cast<PictureSettings*>(&s.lpv),
                               static_cast<PictureSettings*>(&s.photon)})
      p->filterPasses = filterPasses;
    return s;
  }
  std::unique_ptr<LitScene> open(const RenderSettings& s) {
    return std::move(lightScene(home_.scene, s, stages_).value());
  }
  static Camera cameraAt(float x) { return test::cameraAt({x, 1.4f, 4.6f}); }
  // Pixels that lie within one surface.
  std::vector<uint8_t> inner(const RayScene& rays, const Camera& camera) const {
    const CameraRays through(camera, kWidth, kHeight);
    std::vector<uint8_t> out(static_cast<size_t>(kWidth) * kHeight);
    for (size_t i = 0; i < out.size(); ++i) {
      const float x = static_cast<float>(i % kWidth), y = static_cast<float>(i / kWidth);
      const uint32_t first = rays.intersect(through.ray(x, y)).instance;
      out[i] = first == rays.intersect(through.ray(x + 1, y)).instance &&
               first == rays.intersect(through.ray(x, y + 1)).instance &&
               first == rays.intersect(through.ray(x + 1, y + 1)).instance;
    }
    return out;
  }
};

// As a picture of more and more samples does, on edges too.
TEST_P(Frames, ofAStillCameraConvergeToTheMean) {
  FrameSettings use;
  use.everyStill = 1;
  const auto one = open(settings(1, 0));
  const Image truth = open(settings(128, 0))->picture(cameraAt(2), kWidth, kHeight);
  FrameHistory history(use);
  const Image first = one->picture(cameraAt(2), kWidth, kHeight, {}, &history);
  Image last;
  for (int k = 1; k < 64; ++k) last = one->picture(cameraAt(2), kWidth, kHeight, {}, &history);
  EXPECT_LT(rms(last, truth), 0.25 * rms(first, truth));
  EXPECT_NEAR(meanOf(last), meanOf(truth), 0.01 * meanOf(truth));
}

TEST_P(Frames, ofAStillCameraGetBetter) {
  const auto one = open(settings());
  const Image truth = open(settings(64))->picture(cameraAt(2), kWidth, kHeight);
  FrameHistory history;
  const Image first = one->picture(cameraAt(2), kWidth, kHeight, {}, &history);
  Image last;
  for (int k = 1; k < 48; ++k) last = one->picture(cameraAt(2), kWidth, kHeight, {}, &history);
  EXPECT_LT(rms(last, truth), 0.7 * rms(first, truth));
}

// Light that moves from pixel to pixel loses its even spread: errors stay of the size of frames made anew, and do not
// grow.
TEST_P(Frames, alongAWallAreAboutAsGoodAsOnesMadeAnew) {
  const auto one = open(settings()), many = open(settings(64));
  FrameHistory history;
  Image last;
  for (int k = 0; k < 24; ++k)
    last = one->picture(cameraAt(1.8f + 0.02f * static_cast<float>(k)), kWidth, kHeight, {}, &history);
  const Camera there = cameraAt(1.8f + 0.02f * 23);
  const Image anew = one->picture(there, kWidth, kHeight), truth = many->picture(there, kWidth, kHeight);
  const std::vector<uint8_t> where = inner(one->rays(), there);
  EXPECT_LT(rms(last, truth, where), 1.5 * rms(anew, truth, where));
  EXPECT_NEAR(meanOf(last, where), meanOf(truth, where), 0.03 * meanOf(truth, where));
}

// The wall that the box uncovers is green from the first frame on.
TEST_P(Frames, leaveNoGhostsWhereSomethingWasUncovered) {
  const auto lit = open(settings(1, 0));
  FrameHistory history;
  Image last;
  for (int k = 0; k < 8; ++k)
    last = lit->picture(cameraAt(2 + 0.1f * static_cast<float>(k)), kWidth, kHeight, {}, &history);
  const Camera there = cameraAt(2.7f);
  const CameraRays through(there, kWidth, kHeight);
  const std::vector<uint8_t> where = inner(lit->rays(), there);
  int greens = 0;
  for (size_t i = 0; i < where.size(); ++i) {
    const Hit hit = lit->rays().intersect(
        through.ray(static_cast<float>(i % kWidth) + 0.5f, static_cast<float>(i / kWidth) + 0.5f));
    const Material& m = home_.scene.materials[static_cast<size_t>(
        home_.scene.meshes[static_cast<size_t>(home_.scene.instances[hit.instance].mesh)].material)];
    if (!where[i] || m.baseColor.y < 0.5f || m.baseColor.x > 0.2f) continue;
    ++greens;
    EXPECT_LT(last.pixels[i].x, 0.35f * last.pixels[i].y) << i;
  }
  EXPECT_GT(greens, 100);
}

TEST_P(Frames, followALampThatIsSwitchedOff) {
  const auto lit = open(settings());
  FrameHistory history;
  for (int k = 0; k < 20; ++k) lit->picture(cameraAt(2), kWidth, kHeight, {}, &history);
  home_.scene.lamps[0].intensityCd = Vec3(0);
  const SceneChange change{{}, {}, true};
  lit->update(change, stages_);
  history.sceneChanged(change, home_.scene);
  Image last;
  for (int k = 0; k < 4; ++k) last = lit->picture(cameraAt(2), kWidth, kHeight, {}, &history);
  const Image settled = open(settings(64))->picture(cameraAt(2), kWidth, kHeight);
  EXPECT_NEAR(meanOf(last), meanOf(settled), 0.1 * meanOf(settled));
}

TEST_P(Frames, followAThingThatMoves) {
  const auto lit = open(settings());
  FrameHistory history;
  for (int k = 0; k < 20; ++k) lit->picture(cameraAt(2), kWidth, kHeight, {}, &history);
  SceneChange change;
  for (uint32_t i = home_.firstOfBox; i < home_.scene.instances.size(); ++i) {
    home_.scene.instances[i].worldFromObject.w += Vec3(0.8f, 0, 0.3f);
    change.moved.push_back(i);
  }
  lit->update(change, stages_);
  history.sceneChanged(change, home_.scene);
  Image last;
  for (int k = 0; k < 4; ++k) last = lit->picture(cameraAt(2), kWidth, kHeight, {}, &history);
  const Image anew = lit->picture(cameraAt(2), kWidth, kHeight),
              settled = open(settings(64))->picture(cameraAt(2), kWidth, kHeight);
  const std::vector<uint8_t> where = inner(lit->rays(), cameraAt(2));
  EXPECT_LT(rms(last, settled, where), 1.5 * rms(anew, settled, where));
}

TEST_P(Frames, doNotDependOnThreads) {
  const auto lit = open(settings());
  const auto walk = [&](int threads) {
    FrameHistory history;
    Image last;
    withThreads(threads, [&] {
      for (int k = 0; k < 5; ++k)
        last = lit->picture(cameraAt(2 + 0.03f * static_cast<float>(k)), kWidth, kHeight, {}, &history);
    });
    return last;
  };
  EXPECT_TRUE(walk(1).pixels == walk(4).pixels);
}

// What was seen from elsewhere has reflections, and veils a background, of its own.
TEST(FrameHistoryTest, forgetsWhatWasBeforeAJump) {
  const Home home;
  const Lights lights(home.scene);
  const SeenSurface wall{{2, 1.3f, 0}, {0, 0, 1}, {0, 0, 1}, 0, false, 1, {2, 1.3f, 0}};
  const auto estimatesAfter = [&](float moveM) {
    FrameHistory history;
    const auto begin = [&](float z) {
      Camera c;
      c.worldFromCamera = looking({2, 1.3f, z}, {0, 0, -1});
      history.begin(c, kWidth, kHeight, lights);
    };
    begin(4);
    for (size_t i = 0; i < size_t{kWidth * kHeight}; ++i) {
      PastLight& l = history.light(i);
      l.position = wall.position, l.normal = wall.normal, l.instance = wall.instance, l.estimates = 4;
    }
    history.end({}, false);
    begin(4 - moveM);
    return history.find(kWidth / 2, kHeight / 2, wall).estimates;
  };
  EXPECT_EQ(estimatesAfter(0.2f), 4);
  EXPECT_EQ(estimatesAfter(3), 0);
}

INSTANTIATE_TEST_SUITE_P(Techniques, Frames, ::testing::ValuesIn(test::walkingTechniques()),
                         [](const auto& test) { return test.param; });

}  // namespace
}  // namespace roomlight
