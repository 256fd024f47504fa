#include "radiance/slot_light.h"

#include <gtest/gtest.h>

#include "radiance/slot_paths.h"
#include "support/rooms.h"
#include "voxel/voxelise.h"

namespace roomlight {
namespace {

Voxels roomOfVoxels() {
  Scene scene;
  const int wall = test::addMaterial(scene, test::lambertian(0.5f));
  test::addRoom(scene, {0, 0, 0}, {3, 3, 3}, std::vector<int>(6, wall));
  VoxelSettings settings;
  settings.voxelSizeM = 0.1f;
  return voxelise(scene, settings).voxels;
}

TEST(SlotLight, keepsHalfFloatsOfWhatItReachesOnly) {
  const Voxels voxels = roomOfVoxels();
  std::vector<Vec3> lux(voxels.slots.size());
  const auto [first, last] = slotsOfBrick(voxels, 5);
  for (size_t s = first; s < last; ++s) lux[s] = {1e6f / static_cast<float>(1 + s - first), 3, 0.01f};
  const SlotLight light(voxels, lux);
  EXPECT_TRUE(light.reaches(5));
  EXPECT_FALSE(light.reaches(4));
  EXPECT_LT(light.bytes(), lux.size() * 3);
  std::vector<Vec3> out(voxels.slots.size(), Vec3(1));
  light.addTo(voxels, {2, 1, 1}, out);
  for (size_t s = 0; s < out.size(); ++s) {
    for (int k = 0; k < 3; ++k) EXPECT_NEAR(out[s][k], 1 + (k ? 1.0f : 2.0f) * lux[s][k], 1e-3f * (1 + 2 * lux[s][k]));
  }
}

TEST(SlotLight, storedAgainIsTheSame) {
  const Voxels voxels = roomOfVoxels();
  std::vector<Vec3> lux(voxels.slots.size()), once(lux.size()), twice(lux.size());
  for (size_t s = 0; s < lux.size(); ++s) lux[s] = Vec3(std::exp(-0.001f * static_cast<float>(s)));
  SlotLight(voxels, lux).addTo(voxels, Vec3(1), once);
  once[0] = Vec3(100);  // another unit
  SlotLight(voxels, once).addTo(voxels, Vec3(1), twice);
  for (size_t s = 1; s < lux.size(); ++s) ASSERT_EQ(once[s].x, twice[s].x) << s;
}

TEST(SlotLight, ofDarknessIsEmpty) {
  const Voxels voxels = roomOfVoxels();
  const SlotLight light(voxels, std::vector<Vec3>(voxels.slots.size()));
  EXPECT_TRUE(light.empty());
  EXPECT_EQ(light.bytes(), 0u);
  EXPECT_FALSE(light.reaches(0));
}

}  // namespace
}  // namespace roomlight
