// Closed boxes whose every wall emits Le and reflects rho: the radiance is Le / (1 - rho) everywhere.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "reference/path_tracer.h"
#include "support/record.h"
#include "support/rooms.h"

namespace roomlight {
namespace {

Camera cameraAt(Vec3 from) {
  Camera camera;
  camera.worldFromCamera = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, from};
  camera.yFovRad = 1.2f;
  return camera;
}

PathResult renderFurnace(const Material& material, int samples) {
  Scene scene;
  const int wall = test::addMaterial(scene, material);
  test::addRoom(scene, {0, 0, 0}, {4, 3, 4}, std::vector<int>(6, wall));
  const RayScene rays(scene);
  const Lights lights(scene);
  PathSettings settings;
  settings.width = settings.height = 24;
  settings.samples = samples;
  return pathTrace(rays, lights, cameraAt({1.7f, 1.4f, 3.2f}), settings);
}

double meanLuminance(const Image& image) {
  double sum = 0;
  for (const Vec3 p : image.pixels) sum += luminance(p);
  return sum / static_cast<double>(image.pixels.size());
}

class LambertianFurnace : public testing::TestWithParam<float> {};

TEST_P(LambertianFurnace, RadianceIsEmissionOverOneMinusAlbedo) {
  const float rho = GetParam();
  const double mean = meanLuminance(renderFurnace(test::lambertian(rho, 10), rho > 0.9f ? 1024 : 256).image);
  test::record("Furnace, walls of 10 cd/m² each, luminance", fmt::format("albedo {}", rho), "path", 10 / (1 - rho),
               mean);
  EXPECT_NEAR(mean, 10 / (1 - rho), 0.01 * 10 / (1 - rho));
}
INSTANTIATE_TEST_SUITE_P(Albedos, LambertianFurnace, testing::Values(0.0f, 0.2f, 0.5f, 0.8f, 0.95f));

// A material of base colour rho under a uniform environment of 1 reflects what its directional albedo says, never more.
class MaterialFurnace : public testing::TestWithParam<std::pair<float, float>> {};

TEST_P(MaterialFurnace, NeverReflectsMoreThanItReceives) {
  const auto [roughness, metallic] = GetParam();
  Scene scene;
  Material m;
  m.baseColor = Vec3(1);
  m.roughness = roughness;
  m.metallic = metallic;
  test::addRectangle(scene, {-1, 0, 1}, {2, 0, 0}, {0, 0, -2}, test::addMaterial(scene, m));
  scene.sky.luminanceCdM2 = Vec3(1);
  const RayScene rays(scene);
  const Lights lights(scene);
  Camera camera;
  camera.worldFromCamera = {{1, 0, 0}, {0, 0.6f, -0.8f}, {0, 0.8f, 0.6f}, {0, 0.8f, 0.6f}};
  camera.yFovRad = 0.2f;
  PathSettings settings;
  settings.width = settings.height = 8;
  settings.samples = 1024;
  const double mean = meanLuminance(pathTrace(rays, lights, camera, settings).image);
  EXPECT_LE(mean, 1.002);
  // Dielectrics over a white base lose nothing; rough metals lose what single scattering cannot return.
  const double floor = metallic > 0 ? 1 - 0.65 * roughness : 0.99;
  EXPECT_GE(mean, floor);
}
INSTANTIATE_TEST_SUITE_P(Materials, MaterialFurnace,
                         testing::Values(std::pair{0.0f, 0.0f}, std::pair{0.2f, 0.0f}, std::pair{0.5f, 0.0f},
                                         std::pair{1.0f, 0.0f}, std::pair{0.0f, 1.0f}, std::pair{0.3f, 1.0f},
                                         std::pair{1.0f, 1.0f}));

}  // namespace
}  // namespace roomlight
