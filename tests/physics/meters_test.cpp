// Light meters of every technique: in the air, and with any number of threads. What they read where light is known:
 // src/validate.
#include <gtest/gtest.h>

#include <array>

#include "base/parallel.h"
#include "engine/lit_scene.h"
#include "engine/settings.h"
#include "scene/primitives.h"
#include "support/rooms.h"
#include "support/techniques.h"

namespace roomlight {
namespace {

class Meters : public testing::TestWithParam<std::string> {
 protected:
  std::vector<double> read(const Scene& scene, const std::vector<SurfaceElement>& elements) const {
    RenderSettings settings;
    settings.technique = GetParam();
    RenderStats stats;
    const RenderProgress quiet;
    Stages stages(quiet, stats);
    MeterSettings meter;
    meter.tolerance = 0.002;
    std::vector<double> lux;
    for (const MeterReading& r :
         lightScene(scene, settings, stages, {.changes = false}).value()->illuminance(elements, meter))
      lux.push_back(static_cast<double>(luminance(r.illuminanceLux)));
    return lux;
  }
};

// In the middle of the air there are no voxels.
TEST_P(Meters, hangInTheAir) {
  Scene scene;
  test::addRoom(scene, {0, 0, 0}, {4, 3, 4},
                std::vector<int>(6, test::addMaterial(scene, test::lambertian(0.5f, 100))));
  for (const double lux : read(scene, {{{2, 1.5f, 2}, {0, 1, 0}}, {{1, 0.85f, 3}, {0, 0.6f, 0.8f}}}))
    EXPECT_NEAR(lux, 200 * kPi, 0.01 * 200 * kPi);
}

TEST_P(Meters, doNotDependOnThreads) {
  Scene scene;
  test::addRoom(scene, {0, 0, 0}, {4, 3, 4}, std::vector<int>(6, test::addMaterial(scene, test::lambertian(0.5f))));
  scene.lamps.push_back(test::pointLamp({1, 2, 2}, 100));
  std::vector<double> lux[2];
  for (const int threads : {1, 2})
    withThreads(threads, [&] {
      lux[threads - 1] = read(scene, {{{2, 0, 2}, {0, 1, 0}}, {{1, 1.5f, 3}, {0, 0.6f, 0.8f}}});
    });
  EXPECT_EQ(lux[0], lux[1]);
}

// A sheet 1 m over a black floor keeps the sun from x < 2; a black wall stands at x = 4.
TEST(MetersOfSquares, haveTheMeanOfDirectLight) {
  Scene scene;
  const int black = test::addMaterial(scene, test::lambertian(0));
  addRectangle(scene, {0, 0, 0}, {0, 0, 4}, {4, 0, 0}, black);
  addRectangle(scene, {0, 1, 0}, {0, 0, 4}, {2, 0, 0}, black);
  addRectangle(scene, {4, -1, 0}, {0, 2, 0}, {0, 0, 4}, black);
  scene.suns = {{"", {0, 1, 0}, Vec3(1000), 0.0005f}};
  scene.lamps = {test::pointLamp({2, 40, 2}, 1000 * 40 * 40)};
  const Vec3 up{0, 1, 0};
  const std::vector<SurfaceElement> elements = {
      {{2, 0, 2}, up, 0.2f}, {{2.05f, 0, 2}, up, 0.2f}, {{2.05f, 0, 2}, up, 0}, {{3.99f, 0, 2}, up, 0.2f}};
  RenderSettings settings;
  settings.technique = technique::kHybrid;
  RenderStats stats;
  const RenderProgress quiet;
  Stages stages(quiet, stats);
  const auto lit = lightScene(scene, settings, stages, {.changes = false});
  ASSERT_TRUE(lit);
  const std::vector<MeterReading> lux = lit.value()->illuminance(elements, {0.01, 256, 256, 0});
  const std::array<float, 4> share{0.5f, 0.75f, 1, 1};
  for (size_t i = 0; i < share.size(); ++i) EXPECT_NEAR(luminance(lux[i].illuminanceLux), 2000 * share[i], 40) << i;
}

// A floor throws most of what comes from a window on the wall that faces it, be it even or of tiles.
class MetersBesideGloss : public testing::TestWithParam<bool> {};
TEST_P(MetersBesideGloss, readWhatAFloorReflects) {
  Scene scene;
  Material polished = test::lambertian(GetParam() ? 1 : 0.05f);
  if (GetParam()) {
    const std::vector<uint8_t> tiles = {50, 50, 50, 255, 220, 220, 220, 255, 220, 220, 220, 255, 50, 50, 50, 255};
    scene.textures.push_back({"tiles", 2, 2, Wrap::Repeat, Wrap::Repeat, tiles});
    polished.baseColorTexture = {0, 0, {{40, 0, 0}, {0, 40, 0}}};
  }
  polished.specular = 1, polished.roughness = 0.45f;
  const int black = test::addMaterial(scene, test::lambertian(0));
  std::vector<int> materials(6, black);
  test::addRoom(scene, {0, 0, 0}, {5, 2.6f, 4}, materials);
  addRectangle(scene, {0, 0.1f, 0}, {0, 0, 4}, {5, 0, 0}, test::addMaterial(scene, polished));
  for (const Vec3 p : scene.meshes.back().positions) scene.meshes.back().uv[0].push_back({p.x / 4, p.z / 4});
  addRectangle(scene, {0.1f, 0.9f, 1}, {0, 1.2f, 0}, {0, 0, 2}, test::addMaterial(scene, test::lambertian(0, 1000)));
  std::vector<SurfaceElement> elements;
  for (const float height : {0.3f, 0.6f, 1.2f}) elements.push_back({{4.9f, height, 2}, {-1, 0, 0}});
  elements.push_back({{3, 0.85f, 2}, {0, -1, 0}});  // sees nothing else
  std::array<std::vector<MeterReading>, 2> read;
  for (const bool path : {false, true}) {
    RenderSettings settings;
    settings.technique = path ? technique::kPath : technique::kHybrid;
    RenderStats stats;
    const RenderProgress quiet;
    Stages stages(quiet, stats);
    const auto lit = lightScene(scene, settings, stages, {.changes = false});
    ASSERT_TRUE(lit);
    read[path] = lit.value()->illuminance(elements, {0.002, 1 << 14, 1 << 18, 0});
  }
  for (size_t i = 0; i < elements.size(); ++i) {
    const float expected = luminance(read[true][i].illuminanceLux);
    EXPECT_GT(expected, 5.0f);
    EXPECT_NEAR(luminance(read[false][i].illuminanceLux), expected, 0.015f * expected) << i;
  }
}

INSTANTIATE_TEST_SUITE_P(Tiles, MetersBesideGloss, testing::Bool());
INSTANTIATE_TEST_SUITE_P(Techniques, Meters, testing::ValuesIn(test::validatedTechniques()),
                         [](const auto& p) { return p.param; });

}  // namespace
}  // namespace roomlight
