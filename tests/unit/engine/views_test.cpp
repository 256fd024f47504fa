#include "engine/views.h"

#include <gtest/gtest.h>

#include "engine/render.h"
#include "engine/sights.h"
#include "reference/path_tracer.h"
#include "support/rooms.h"
#include "support/techniques.h"

namespace roomlight {
namespace {

Room room(const std::string& name, Vec2 low, Vec2 high, float elevationM, float heightM = 2.5f) {
  Room r;
  r.name = name, r.elevationM = elevationM, r.heightM = heightM;
  r.floor = {low, {low.x, high.y}, high, {high.x, low.y}};
  return r;
}

// Two storeys; the lower has a cupboard and a step.
std::vector<Room> house() {
  return {room("bedroom", {0, 0}, {4, 3}, 2.8f, 2.4f), room("hall", {0, 0}, {5, 3}, 0, 2.5f),
          room("living", {5, 0}, {9, 6}, -0.4f, 2.9f), room("cupboard", {4, 3}, {5, 4}, 0, 1.2f)};
}

Viewed view(const Scene& scene, std::span<const Room> rooms, const ViewWish& wish) {
  const Result<Viewed> out = makeView(scene, rooms, Camera(), false, {960, 540}, wish);
  EXPECT_TRUE(out.ok()) << out.error();
  return out.ok() ? out.value() : Viewed();
}

TEST(Views, levelsAreRoomsOfLikeHeight) {
  const std::vector<Level> levels = levelsOf(house());
  ASSERT_EQ(levels.size(), 2u);
  EXPECT_FLOAT_EQ(levels[0].elevationM, -0.4f);
  EXPECT_FLOAT_EQ(levels[0].ceilingM, 2.5f) << "not that of the cupboard";
  EXPECT_FLOAT_EQ(levels[0].high.x, 9);
  EXPECT_FLOAT_EQ(levels[1].ceilingM, 5.2f);
}

TEST(Views, panoramasFromACameraThatCutsAreWhole) {
  Camera placed;
  placed.cutHeightM = 2;
  ViewWish wish;
  wish.view = View::Panorama;
  const Result<Viewed> out = makeView({}, {}, placed, true, {960, 540}, wish);
  ASSERT_TRUE(out.ok()) << out.error();
  EXPECT_EQ(out.value().camera.cutHeightM, kInfinity);
}

TEST(Views, planIsAsLargeAsTheLevelAndCutsUnderItsCeiling) {
  const std::vector<Room> rooms = house();
  ViewWish wish;
  wish.view = View::Plan;
  wish.metresPerPixel = 0.02f;
  const Viewed ground = view({}, rooms, wish);
  EXPECT_EQ(ground.width, 550);  // 9 m and a metre on both sides
  EXPECT_EQ(ground.height, 400);
  EXPECT_FLOAT_EQ(CameraRays(ground.camera, ground.width, ground.height).metresPerPixel(), 0.02f);
  EXPECT_FLOAT_EQ(ground.camera.cutHeightM, 2.45f);
  EXPECT_TRUE(ground.camera.emptyBackdrop);
  // North west is top left.
  const Ray corner = CameraRays(ground.camera, ground.width, ground.height).ray(0, 0);
  EXPECT_LT(length(corner.origin - Vec3{-1, 2.45f, -1}), 1e-4f);
  EXPECT_LT(length(corner.direction - Vec3{0, -1, 0}), 1e-6f);
  wish.level = "1", wish.cutM = 1.2f;
  EXPECT_FLOAT_EQ(view({}, rooms, wish).camera.cutHeightM, 4);
  // All of it fits into a size that is given.
  wish = {};
  wish.view = View::Plan;
  wish.size = {100, 400};
  EXPECT_NEAR(CameraRays(view({}, rooms, wish).camera, 100, 400).metresPerPixel(), 0.11f, 1e-6f);
}

TEST(Views, topFitsTheLevelAtTheCut) {
  ViewWish wish;
  wish.view = View::Top;
  const Viewed top = view({}, house(), wish);
  const CameraRays rays(top.camera, top.width, top.height);
  EXPECT_LT(length(rays.ray(0, 0).origin - Vec3{-1, 2.45f, -1}), 0.02f);
  EXPECT_LT(length(rays.ray(static_cast<float>(top.width), static_cast<float>(top.height)).origin - Vec3{10, 2.45f, 7}),
            0.02f);
}

TEST(Views, panoramaStandsInTheMiddleOfARoom) {
  ViewWish wish;
  wish.view = View::Panorama;
  EXPECT_LT(length(view({}, house(), wish).camera.worldFromCamera.w - Vec3{7, 1.2f, 3}), 1e-3f) << "of the largest";
  wish.room = "bedroom";
  EXPECT_LT(length(view({}, house(), wish).camera.worldFromCamera.w - Vec3{2, 4.4f, 1.5f}), 1e-3f);
  wish.room.clear();
  wish.eye = Vec3{1, 1, 1}, wish.target = Vec3{5, 0.2f, 1};
  const Viewed viewed = view({}, house(), wish);
  EXPECT_LT(length(CameraRays(viewed.camera, 200, 100).ray(100, 50).direction - Vec3{1, 0, 0}), 1e-6f)
      << "upright, to the target's side";
  EXPECT_EQ(viewed.width, 2 * viewed.height);
}

TEST(Views, middleOfAnAngleIsInside) {
  Room angle;
  angle.floor = {{0, 0}, {0, 6}, {1, 6}, {1, 2}, {6, 2}, {6, 0}};
  const Vec2 middle = middleOf(angle);
  EXPECT_LT(middle.y, 1.6f);
  EXPECT_GT(middle.y, 0.6f);
}

TEST(Views, whatThereIsNotIsNamed) {
  const auto error = [](const ViewWish& wish, std::span<const Room> rooms) {
    const Result<Viewed> out = makeView({}, rooms, Camera(), false, {960, 540}, wish);
    return out.ok() ? std::string() : out.error();
  };
  const std::vector<Room> rooms = house();
  ViewWish wish;
  wish.view = View::Plan, wish.level = "attic";
  EXPECT_EQ(error(wish, rooms), "--level attic: no such level; there are 0 at -0.40 m, 1 at 2.80 m");
  EXPECT_NE(error(wish, {}).find("--level attic: the scene knows no rooms"), std::string::npos);
  wish.level.clear(), wish.room = "9";
  EXPECT_NE(error(wish, rooms).find("--room: no room '9'; there are 'bedroom'"), std::string::npos);
  wish = {};
  wish.view = View::Panorama, wish.size = {100, 60};
  EXPECT_NE(error(wish, rooms).find("twice as wide as high"), std::string::npos);
  wish.view = View::Stereo;
  EXPECT_NE(error(wish, rooms).find("as wide as high"), std::string::npos);
  wish = {};
  wish.eye = wish.target = Vec3{1, 2, 3};
  EXPECT_NE(error(wish, rooms).find("--target"), std::string::npos);
}

// A box of 1 x 0.5 m cut at half its height and one of 0.5 x 0.5 m below the cut, at 1 cm a pixel.
TEST(Views, sectionsAndBackdropCoverExactPixels) {
  Scene scene;
  const int white = test::addMaterial(scene, test::lambertian(0.5f));
  test::addBox(scene, {0, 0, 0}, {1, 2, 0.5f}, white);
  test::addBox(scene, {2, 0, 0}, {2.5f, 0.4f, 0.5f}, white);
  Camera camera;
  camera.projection = Projection::Orthographic;
  camera.yMagM = 1;
  camera.worldFromCamera = {{1, 0, 0}, {0, 0, -1}, {0, 1, 0}, {1.5f, 5, 0.5f}};
  camera.cutHeightM = 1;
  camera.emptyBackdrop = true;
  const Sights sights = sightsOf(RayScene(scene), camera, 400, 200);
  double section = 0, backdrop = 0;
  for (size_t i = 0; i < sights.section.size(); ++i)
    section += static_cast<double>(sights.section[i]), backdrop += static_cast<double>(sights.backdrop[i]);
  EXPECT_NEAR(section, 100 * 50, 1);
  EXPECT_NEAR(400 * 200 - section - backdrop, 50 * 50, 1);
}

// A front that a slanted camera sees before the floor is no room: it is outdoors, and shown as dark as that.
TEST(Views, slantedCamerasSeeRoomsThroughTheCutAlone) {
  Scene scene;
  scene.rooms = {room("living", {0, 0}, {6, 4}, 0)};
  Camera camera;
  camera.worldFromCamera = looking({3, 10, 12}, {0, -1, -1});
  camera.cutHeightM = 2.45f;
  const std::vector<bool> mask = roomMask(scene, camera, 90, 90);
  const CameraRays rays(camera, 90, 90);
  const auto isRoom = [&](Vec3 place) {
    const std::optional<Vec2> at = rays.pixelOf(place);
    return at && mask.at(static_cast<size_t>(at->y) * 90 + static_cast<size_t>(at->x));
  };
  EXPECT_TRUE(isRoom({3, 2.45f, 2}));
  EXPECT_FALSE(isRoom({3, 1.2f, 4})) << "its front";
  EXPECT_FALSE(isRoom({3, 0, 6}));
  camera.worldFromCamera = looking({3, 10, 2}, {0, -1, 0});
  EXPECT_TRUE(roomMask(scene, camera, 90, 90).at(45 * 90 + 45));
}

TEST(Views, sectionsAreDrawnOverTheRest) {
  const Sights sights{{1, 0.5f, 0, 0}, {0, 0.25f, 1, 0}};
  Image light(4, 1);
  light.pixels = {Vec3(0), Vec3(2), Vec3(0), Vec3(8)};
  const Image rest = unmixed(light, sights);
  EXPECT_EQ(rest.pixels[1], Vec3(8));
  EXPECT_EQ(rest.pixels[0], Vec3(0));
  Image encoded(4, 1);
  encoded.pixels = {Vec3(0), Vec3(0.8f), Vec3(0), Vec3(0.4f)};
  const Image onPaper = drawn(encoded, sights, Vec3(0.2f), Vec3(1)),
              clear = drawn(encoded, sights, Vec3(0.2f), std::nullopt);
  EXPECT_FLOAT_EQ(onPaper.pixels[0].x, 0.2f);
  EXPECT_FLOAT_EQ(onPaper.pixels[1].x, 0.25f * 0.8f + 0.5f * 0.2f + 0.25f);
  EXPECT_FLOAT_EQ(onPaper.pixels[2].x, 1);
  EXPECT_FLOAT_EQ(onPaper.pixels[3].x, 0.4f);
  EXPECT_FLOAT_EQ(clear.pixels[1].x, (0.25f * 0.8f + 0.5f * 0.2f) / 0.75f);
}

class ViewsByTechnique : public testing::TestWithParam<std::string> {
 protected:
  Image picture(const Scene& scene, const Camera& camera, int width, int height, int samples) const {
    RenderSettings settings;
    settings.technique = GetParam();
    settings.width = width, settings.height = height, settings.samples = samples;
    settings.voxel.voxelSizeM = 0.1f;
    const Result<Rendered> rendered = render(scene, camera, settings);
    EXPECT_TRUE(rendered.ok()) << rendered.error();
    return rendered.ok() ? rendered.value().image : Image(width, height);
  }
  bool isHybrid() const { return GetParam() == "hybrid"; }
  bool isPath() const { return GetParam() == "path"; }
};

// Walls emit 10 and reflect half of what they get: 20 in every direction.
TEST_P(ViewsByTechnique, furnaceIsEvenAllAround) {
  Scene scene;
  const int wall = test::addMaterial(scene, test::lambertian(0.5f, 10));
  test::addRoom(scene, {0.013f, 0.007f, 0.021f}, {4, 2.6f, 3}, std::vector<int>(6, wall));
  for (const Projection projection : {Projection::Panorama, Projection::StereoPanorama}) {
    Camera camera;
    camera.projection = projection;
    camera.worldFromCamera.w = {1.7f, 1.4f, 1.6f};
    const Image image = picture(scene, camera, 48, projection == Projection::Panorama ? 24 : 48, isPath() ? 64 : 0);
    double sum = 0;
    for (const Vec3 p : image.pixels) {
      sum += static_cast<double>(luminance(p)) / static_cast<double>(image.pixels.size());
      EXPECT_NEAR(luminance(p), 20, isHybrid() ? 2 : 20);
    }
    EXPECT_NEAR(sum, 20, 0.2);
  }
}

// What the floor sends up in a plan is what a meter on it reads, with a lamp and a white ceiling above the cut: the cut
// takes no light away.
TEST_P(ViewsByTechnique, cutTakesNoLightAway) {
  Scene scene;
  const int white = test::addMaterial(scene, test::lambertian(0.7f));
  test::addRoom(scene, {0, 0, 0}, {4, 2.6f, 4}, std::vector<int>(6, white));
  scene.lamps.push_back(test::pointLamp({2, 2.4f, 2}, 100));
  Camera camera;
  camera.projection = Projection::Orthographic;
  camera.yMagM = 1;
  camera.worldFromCamera = {{1, 0, 0}, {0, 0, -1}, {0, 1, 0}, {2, 9, 2}};
  camera.cutHeightM = 2;
  camera.emptyBackdrop = true;
  const Image image = picture(scene, camera, 16, 16, isPath() ? 256 : 0);
  const RayScene rays(scene);
  const Lights lights(scene);
  for (const auto& [x, y] : {std::pair{4, 4}, {8, 12}}) {
    double seen = 0, lux = 0;
    std::vector<SurfaceElement> places;
    for (int j = 0; j < 4; ++j) {
      for (int i = 0; i < 4; ++i) {
        seen += static_cast<double>(luminance(image.at(x + i, y + j))) / 16;
        places.push_back(
            {{1 + (static_cast<float>(x + i) + 0.5f) / 8, 0, 1 + (static_cast<float>(y + j) + 0.5f) / 8}, {0, 1, 0}});
      }
    }
    for (const MeterReading& reading : measureIlluminance(rays, lights, places, {0, 1 << 14, 1 << 14, 3}))
      lux += static_cast<double>(luminance(reading.illuminanceLux)) / 16;
    const double expected = lux * 0.7 / std::acos(-1.0);
    EXPECT_NEAR(seen, expected, (isPath() ? 0.02 : isHybrid() ? 0.03 : 0.1) * expected);
  }
}

// Nothing of the sky comes through an empty backdrop, nothing of the inside of walls out of sections.
TEST_P(ViewsByTechnique, sectionsAndEmptyBackdropAreBlack) {
  Scene scene;
  const int white = test::addMaterial(scene, test::lambertian(0.5f, 10));
  test::addBox(scene, {0, 0, 0}, {1, 2, 1}, white);
  scene.sky.luminanceCdM2 = Vec3(100);
  Camera camera;
  camera.projection = Projection::Orthographic;
  camera.yMagM = 1;
  camera.worldFromCamera = {{1, 0, 0}, {0, 0, -1}, {0, 1, 0}, {0.5f, 5, 0.5f}};
  camera.cutHeightM = 1;
  camera.emptyBackdrop = true;
  const Image closed = picture(scene, camera, 16, 16, 8);
  for (const Vec3 p : closed.pixels) EXPECT_EQ(p, Vec3(0));
  camera.cutHeightM = 3;
  const Image whole = picture(scene, camera, 16, 16, isPath() ? 64 : 8);
  EXPECT_NEAR(luminance(whole.at(8, 8)), 60, 6);
  EXPECT_EQ(whole.at(1, 8), Vec3(0));
}

INSTANTIATE_TEST_SUITE_P(Techniques, ViewsByTechnique, testing::ValuesIn(test::validatedTechniques()),
                         [](const auto& test) { return test.param; });

}  // namespace
}  // namespace roomlight
