#include "radiance/slot_cache.h"

#include <gtest/gtest.h>

#include "support/rooms.h"
#include "voxel/voxelise.h"

namespace roomlight {
namespace {

constexpr float kVoxelM = 0.1f;

// A floor with a thin wall across one of its voxels, lit evenly.
struct Floor {
  Scene scene;
  Voxels voxels;
  RadianceField field;

  Floor() {
    const int white = test::addMaterial(scene, test::lambertian(0.5f));
    test::addRectangle(scene, {0, 0, 0}, {0, 0, 2}, {2, 0, 0}, white);
    test::addRectangle(scene, {1.03f, 0, 0}, {0, 1, 0}, {0, 0, 2}, white);
    voxels = voxelise(scene, {.voxelSizeM = kVoxelM}).voxels;
    field.irradianceLux.assign(voxels.slots.size(), Vec3(100));
  }
};

TEST(SlotCache, readsReflectedLight) {
  const Floor floor;
  const SlotCache cache(floor.voxels, floor.field);
  const SlotCache::Place place = cache.find({0.52f, 0, 0.77f}, {0, 1, 0});
  ASSERT_GE(place.slot, 0);
  EXPECT_EQ(place.trust, Trust::Sure);
  EXPECT_NEAR(cache.radiance(place.slot).x, 50 / kPi, 0.05f);
  EXPECT_EQ(cache.instance(place.slot), 0u);
}

TEST(SlotCache, isUnsureWhereAWallCrossesAVoxel) {
  const Floor floor;
  const SlotCache cache(floor.voxels, floor.field);
  const RayScene rays(floor.scene);
  int free = 0, parted = 0;
  for (const float x : {1.005f, 1.02f, 1.04f, 1.08f}) {
    const Vec3 p{x, 0, 0.77f}, n{0, 1, 0};
    const SlotCache::Place place = cache.find(p, n);
    ASSERT_EQ(place.trust, Trust::Unsure) << x;
    (luminance(rays.transmittance(cache.between(place.slot, p, n))) > 0.5f ? free : parted) += 1;
  }
  // Its slot stands for one side of the wall.
  EXPECT_EQ(free, 2);
  EXPECT_EQ(parted, 2);
}

TEST(SlotCache, knowsNothingOfPlacesOffItsSurfaces) {
  const Floor floor;
  const SlotCache cache(floor.voxels, floor.field);
  EXPECT_EQ(cache.find({0.52f, 0.06f, 0.77f}, {0, 1, 0}).trust, Trust::None);
  EXPECT_EQ(cache.find({0.52f, 0.7f, 0.77f}, {0, 1, 0}).slot, -1);
  EXPECT_EQ(cache.find({-5, 40, 3}, {0, 1, 0}).slot, -1);
}

}  // namespace
}  // namespace roomlight
