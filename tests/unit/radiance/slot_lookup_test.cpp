// Surfaces on borders of voxels: rounding puts their points to either side.
#include "radiance/slot_lookup.h"

#include <gtest/gtest.h>

#include "radiance/slot_cache.h"
#include "support/rooms.h"
#include "voxel/voxelise.h"

namespace roomlight {
namespace {

constexpr float kGroundM = -0.01f;
constexpr Vec3 kUp{0, 1, 0};

// A floor on a border of voxels, and of bricks; the ground lies close below.
struct FloorOverGround {
  Scene scene;
  Voxels voxels;
  RadianceField field;

  explicit FloorOverGround(float voxelM) {
    const int white = test::addMaterial(scene, test::lambertian(0.5f));
    test::addRectangle(scene, {0, 0, 0}, {0, 0, 2}, {2, 0, 0}, white);
    test::addRectangle(scene, {-1, kGroundM, -1}, {0, 0, 4}, {4, 0, 0}, white);
    voxels = voxelise(scene, {.voxelSizeM = voxelM}).voxels;
    field.irradianceLux.assign(voxels.slots.size(), Vec3(100));
  }
};

class SlotLookup : public testing::TestWithParam<float> {
 protected:
  const FloorOverGround over{GetParam()};
};

TEST_P(SlotLookup, borderOfVoxelsFindsTheSurfaceItself) {
  const SlotCache cache(over.voxels, over.field);
  for (const float off : {-2e-7f, 0.0f, 2e-7f, -1e-5f}) {
    for (const float x : {0.13f, 0.77f, 1.52f}) {
      const Vec3 p{x, off, 0.9f};
      const int64_t slot = slotAtSurface(over.voxels, p, kUp);
      ASSERT_GE(slot, 0) << off;
      EXPECT_NEAR(over.voxels.slots[static_cast<size_t>(slot)].position.y, 0, 1e-4f) << off;
      const SlotCache::Place place = cache.find(p, kUp);
      EXPECT_EQ(place.slot, slot) << off;
      EXPECT_EQ(place.trust, Trust::Sure) << off;
    }
  }
  const int64_t ground = slotAtSurface(over.voxels, {0.52f, kGroundM, 0.9f}, kUp);
  ASSERT_GE(ground, 0);
  EXPECT_NEAR(over.voxels.slots[static_cast<size_t>(ground)].position.y, kGroundM, 1e-4f);
}

TEST_P(SlotLookup, brickIsThatOfTheSlot) {
  const int32_t above = brickAtSurface(over.voxels, {0.52f, 0.0f, 0.9f}, kUp),
                below = brickAtSurface(over.voxels, {0.52f, kGroundM, 0.9f}, kUp);
  ASSERT_GE(above, 0);
  ASSERT_GE(below, 0);
  EXPECT_NE(above, below);
  EXPECT_EQ(brickAtSurface(over.voxels, {0.52f, -2e-7f, 0.9f}, kUp), above);
  EXPECT_EQ(brickSideAt(over.voxels, {0.52f, -2e-7f, 0.9f}, kUp),
            brickSide(static_cast<size_t>(above), dominantFace(kUp)));
}

TEST_P(SlotLookup, whereNoSurfaceIsThereIsNoSlot) {
  EXPECT_EQ(slotAtSurface(over.voxels, {0.52f, 0.75f, 0.9f}, kUp), -1);
  EXPECT_EQ(brickAtSurface(over.voxels, {-50, 0, 0}, kUp), -1);
}

// Of large ones the ground is nearer than what is taken for rounding.
INSTANTIATE_TEST_SUITE_P(Voxels, SlotLookup, testing::Values(0.1f, 0.25f));

}  // namespace
}  // namespace roomlight
