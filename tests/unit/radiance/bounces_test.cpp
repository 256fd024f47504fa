// Furnaces: closed rooms whose every wall emits Le and reflects rho send out Le / (1 - rho).
#include <gtest/gtest.h>

#include "radiance/radiance_field.h"
#include "support/rooms.h"
#include "voxel/voxelise.h"

namespace roomlight {
namespace {

constexpr float kLe = 10;

// Luminance of the walls, mean over their area, from what they receive.
double furnace(float rho, float angleRad, const RadianceSettings& settings) {
  Scene scene;
  const int wall = test::addMaterial(scene, test::lambertian(rho, kLe));
  test::addRoom(scene, {0, 0, 0}, {4, 2.6f, 3}, std::vector<int>(6, wall));
  const float c = std::cos(angleRad), s = std::sin(angleRad);
  for (Instance& i : scene.instances)
    i.worldFromObject = Affine{{c, 0, -s}, {0, 1, 0}, {s, 0, c}, {0.013f, 0.007f, 0.021f}} * i.worldFromObject;
  VoxelSettings voxel;
  voxel.voxelSizeM = 0.1f;
  const Voxelisation v = voxelise(scene, voxel);
  const RayScene rays(scene);
  const RadianceField field = illuminate(rays, Lights(scene), v.voxels, settings);
  const Affine roomFromWorld = inverse(Affine{{c, 0, -s}, {0, 1, 0}, {s, 0, c}, {0.013f, 0.007f, 0.021f}});
  double sum = 0, area = 0;
  for (size_t i = 0; i < v.voxels.slots.size(); ++i) {
    const FaceSlot& slot = v.voxels.slots[i];
    const Vec3 inwards = Vec3{2, 1.3f, 1.5f} - roomFromWorld.point(slot.position);
    if (dot(roomFromWorld.vector(slot.normal), inwards) < 0) continue;
    sum += static_cast<double>(luminance(field.irradianceLux[i]) * slot.areaM2),
        area += static_cast<double>(slot.areaM2);
  }
  return kLe + static_cast<double>(rho) * sum / area / kPi;
}

double meanOfSeeds(float rho, float angleRad, RadianceSettings settings) {
  double sum = 0;
  for (settings.seed = 0; settings.seed < 3; ++settings.seed) sum += furnace(rho, angleRad, settings) / 3;
  return sum;
}

TEST(BouncesByRays, furnaceIsEmissionOverOneMinusAlbedo) {
  for (const float rho : {0.5f, 0.8f}) {
    for (const float angle : {0.0f, 0.5f}) {
      const double exact = kLe / (1 - rho);
      EXPECT_NEAR(meanOfSeeds(rho, angle, {}), exact, 0.01 * exact) << rho << " " << angle;
    }
  }
}

// Walls at an angle to the voxels leak along their steps.
TEST(BouncesByCones, furnaceIsEmissionOverOneMinusAlbedo) {
  RadianceSettings settings;
  settings.bounceBy = BounceBy::Cones;
  for (const float rho : {0.5f, 0.8f}) {
    for (const float angle : {0.0f, 0.5f}) {
      const double exact = kLe / (1 - rho);
      EXPECT_NEAR(meanOfSeeds(rho, angle, settings), exact, (angle > 0 ? 0.02 : 0.01) * exact) << rho << " " << angle;
    }
  }
}

}  // namespace
}  // namespace roomlight
