// Technique cone held against closed forms: furnaces at any voxel size and orientation, occlusion, independence of
 // settings.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "base/parallel.h"
#include "gather/cone_gather.h"
#include "support/record.h"
#include "support/rooms.h"
#include "voxel/voxelise.h"

namespace roomlight {
namespace {

struct ConeSetup {
  float voxelSizeM = 0.1f;
  ConeGatherSettings gather;
  RadianceSettings radiance;
};

ConeSetup small() {
  ConeSetup s;
  s.gather.width = s.gather.height = 24;
  s.gather.samples = 16;
  s.gather.filterPasses = 0;
  return s;
}

// Turns a scene built around the axes, and the camera with it.
struct Turn {
  float angleRad = 0;
  Affine matrix() const {
    const float c = std::cos(angleRad), s = std::sin(angleRad);
    return {{c, 0, -s}, {0, 1, 0}, {s, 0, c}, {0.013f, 0.007f, 0.021f}};
  }
};

GatheredPicture render(Scene scene, Vec3 eye, const ConeSetup& setup, Turn turn = {}) {
  for (Instance& i : scene.instances) i.worldFromObject = turn.matrix() * i.worldFromObject;
  Camera camera;
  camera.worldFromCamera = turn.matrix() * Affine{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, eye};
  camera.yFovRad = 1.2f;
  const RayScene rays(scene);
  const Lights lights(scene);
  VoxelSettings voxel;
  voxel.voxelSizeM = setup.voxelSizeM;
  const Voxelisation v = voxelise(scene, voxel);
  const RadianceField field = illuminate(rays, lights, v.voxels, setup.radiance);
  return gatherCones({rays, lights}, v.voxels, field, camera, setup.gather);
}

double mean(const Image& image) {
  double sum = 0;
  for (const Vec3 p : image.pixels) sum += luminance(p);
  return sum / static_cast<double>(image.pixels.size());
}

Scene furnace(float rho) {
  Scene scene;
  const int wall = test::addMaterial(scene, test::lambertian(rho, 10));
  test::addRoom(scene, {0, 0, 0}, {4, 2.6f, 3}, std::vector<int>(6, wall));
  return scene;
}

struct Furnace {
  float voxelSizeM, angleRad, halfAngleDeg, tolerance;
};
void PrintTo(const Furnace& f, std::ostream* out) {
  *out << f.voxelSizeM << " m, turned " << f.angleRad << ", cones of " << f.halfAngleDeg << " degrees";
}

class ConeFurnace : public testing::TestWithParam<Furnace> {};

// Every wall emits 10 and reflects one half: 20 everywhere, whatever the voxels and the cones.
TEST_P(ConeFurnace, radianceIsEmissionOverOneMinusAlbedo) {
  ConeSetup s = small();
  s.voxelSizeM = GetParam().voxelSizeM;
  s.gather.coneHalfAngleDeg = GetParam().halfAngleDeg;
  const double measured = mean(render(furnace(0.5f), {1.7f, 1.4f, 2.6f}, s, {GetParam().angleRad}).image);
  test::record("Furnace, walls of 10 cd/m² each, luminance",
               fmt::format("albedo 0.5, voxels of {} m turned by {} rad, cones of {}°", GetParam().voxelSizeM,
                           GetParam().angleRad, GetParam().halfAngleDeg),
               "cone", 20, measured);
  EXPECT_NEAR(measured, 20, 20 * GetParam().tolerance);
}
INSTANTIATE_TEST_SUITE_P(Rooms, ConeFurnace,
                         testing::Values(Furnace{0.1f, 0, 5, 0.02f}, Furnace{0.05f, 0, 5, 0.02f},
                                         Furnace{0.2f, 0, 5, 0.02f}, Furnace{0.1f, 0.5f, 5, 0.02f},
                                         Furnace{0.1f, 0.785398f, 5, 0.02f}, Furnace{0.1f, 0, 15, 0.02f},
                                         Furnace{0.1f, 0.5f, 15, 0.02f}));

// A room with a lamp, a table, a shelf and a partition that does not reach the ceiling.
Scene furnishedRoom() {
  Scene scene;
  const int white = test::addMaterial(scene, test::lambertian(0.75f)),
            floor = test::addMaterial(scene, test::lambertian(0.35f)),
            wood = test::addMaterial(scene, test::lambertian(0.5f));
  test::addRoom(scene, {0, 0, 0}, {4.13f, 2.57f, 3.61f}, {white, white, floor, white, white, white});
  test::addBox(scene, {0.6f, 0.7f, 0.5f}, {1.9f, 0.74f, 1.3f}, wood);
  test::addBox(scene, {3.2f, 0, 0.01f}, {4.0f, 1.9f, 0.35f}, wood);
  test::addBox(scene, {2.3f, 0, 0.9f}, {2.36f, 1.8f, 2.2f}, white);
  scene.lamps.push_back(test::pointLamp({1.3f, 2.1f, 1.2f}, 80));
  return scene;
}

TEST(Cone, meanLuminanceDoesNotDependOnTheSizeOfVoxels) {
  ConeSetup s = small();
  s.gather.width = 64, s.gather.height = 36;
  std::vector<double> means;
  for (const float size : {0.04f, 0.06f, 0.1f}) {
    s.voxelSizeM = size;
    means.push_back(mean(render(furnishedRoom(), {1.9f, 1.5f, 3.4f}, s).image));
  }
  const auto [low, high] = std::minmax_element(means.begin(), means.end());
  EXPECT_LT(*high / *low, 1.03) << means[0] << " " << means[1] << " " << means[2];
}

// A sunlit roof, which the room below it does not see, must not end the bounces before the room has had its own.
TEST(Cone, lightOutdoorsDoesNotShortenBouncesIndoors) {
  ConeSetup s = small();
  const double alone = mean(render(furnishedRoom(), {1.9f, 1.5f, 3.4f}, s).image);
  Scene scene = furnishedRoom();
  test::addRectangle(scene, {-10, 4, -10}, {0, 0, 24}, {24, 0, 0}, test::addMaterial(scene, test::lambertian(0.2f)));
  Sun sun;
  sun.illuminanceLux = Vec3(50000);
  scene.suns.push_back(sun);
  EXPECT_NEAR(mean(render(scene, {1.9f, 1.5f, 3.4f}, s).image), alone, 0.01 * alone);
}

// A lamp-lit room whose walls have no thickness, with a window frame in one of them, before and after sunrise: no
// daylight comes in.
TEST(Cone, daylightStaysOutside) {
  Scene night;
  const int wall = test::addMaterial(night, test::lambertian(0.6f));
  test::addRoom(night, {0, 0, 0}, {3, 2.6f, 3}, std::vector<int>(6, wall));
  test::addBox(night, {1, 0.9f, -0.03f}, {2, 0.97f, 0.03f}, wall);
  test::addBox(night, {1, 1.8f, -0.03f}, {2, 1.87f, 0.03f}, wall);
  night.lamps.push_back(test::pointLamp({1.5f, 2.1f, 1.5f}, 20));
  Scene day = night;
  Sun sun;
  sun.toLight = normalize(Vec3{0.3f, 0.7f, -0.8f});
  sun.illuminanceLux = Vec3(50000);
  day.suns.push_back(sun);
  day.sky.luminanceCdM2 = Vec3(3000);
  const double dark = mean(render(night, {1.5f, 1.3f, 2.7f}, small()).image),
               bright = mean(render(day, {1.5f, 1.3f, 2.7f}, small()).image);
  EXPECT_NEAR(bright, dark, 0.02 * dark);
}

TEST(Cone, sameBitsWithAnyNumberOfThreads) {
  ConeSetup s = small();
  s.gather.filterPasses = 3;
  s.gather.samples = 2;
  std::vector<Image> images;
  for (const int threads : {1, 2}) {
    withThreads(threads, [&] { images.push_back(render(furnishedRoom(), {1.9f, 1.5f, 3.4f}, s).image); });
  }
  for (size_t i = 0; i < images[0].pixels.size(); ++i) {
    for (int k = 0; k < 3; ++k) ASSERT_EQ(images[0].pixels[i][k], images[1].pixels[i][k]) << "pixel " << i;
  }
}

// In a room of metres, f(r) = 1 / (1 + r) of its walls lies between that of the nearest and of the farthest point.
// Asked to stop at any of its reports, illuminate traces nothing more and leaves no light that could be taken for all
// of it.
TEST(Cone, illuminateStopsWhereItIs) {
  const Scene scene = furnishedRoom();
  const RayScene rays(scene);
  const Lights lights(scene);
  VoxelSettings voxel;
  voxel.voxelSizeM = 0.1f;
  const Voxelisation v = voxelise(scene, voxel);
  const RadianceSettings settings;
  uint64_t before = 0;
  for (const float from : {0.0f, 0.5f, 0.8f}) {
    std::atomic<bool> stop = from <= 0;
    const Progress progress{[&](float fraction) { stop = stop || fraction >= from; }, &stop};
    const RadianceField field = illuminate(rays, lights, v.voxels, settings, progress);
    EXPECT_TRUE(field.levels.empty()) << from;
    EXPECT_EQ(field.bounces, 0) << from;
    EXPECT_EQ(field.rays > before, from > 0) << from;
    before = field.rays;
  }
}

TEST(Cone, occlusionFallsWithDistance) {
  ConeSetup s = small();
  const double whole = mean(render(furnace(0.5f), {1.7f, 1.4f, 2.6f}, s).occlusion);
  s.gather.occlusionLambda = 1;
  const double faded = mean(render(furnace(0.5f), {1.7f, 1.4f, 2.6f}, s).occlusion);
  EXPECT_NEAR(whole, 1, 0.02) << "a closed room lets nothing out";
  EXPECT_GT(faded, whole / (1 + 5.6));
  EXPECT_LT(faded, whole / (1 + 0.5));
}

}  // namespace
}  // namespace roomlight
