#include "bake/thin_covers.h"

#include <gtest/gtest.h>

#include "support/rooms.h"

namespace roomlight::bake {
namespace {

TEST(ThinCovers, aClothAndWhatItLiesOnAreAGapApart) {
  Scene scene;
  const int grey = addMaterial(scene, lambertian(0.5f));
  addRectangle(scene, {0, 0.4f, 0}, {0, 0, 1}, {2, 0, 0}, grey);  // 0, a mattress
  addRectangle(scene, {0.2f, 0.401f, 0.2f}, {0, 0, 0.5f}, {1, 0, 0}, grey);  // a cloth
  const auto cloth = static_cast<size_t>(scene.instances.back().mesh);
  addBox(scene, {3, 0, 0}, {4, 0.5f, 1}, grey);  // a box beside it
  const auto box = static_cast<size_t>(scene.instances.back().mesh);
  addRectangle(scene, {-5, 0, -5}, {0, 0, 10}, {10, 0, 0}, grey);  // the floor, on which they stand
  const RayScene rays(scene);
  const std::vector<float> gaps = gapsOf(rays, 0.004f);
  EXPECT_NEAR(gaps[0], 0.001f, 1e-4f);
  EXPECT_NEAR(gaps[cloth], 0.001f, 1e-4f);
  EXPECT_EQ(gaps[box], kInfinity);
}

TEST(ThinCovers, aSheetOfTwoSidesIsLookedThrough) {
  Scene scene;
  const int grey = addMaterial(scene, lambertian(0.5f));
  addRectangle(scene, {0, 0.0005f, 0}, {1, 0, 0}, {0, 0, 1}, grey);  // below
  addRectangle(scene, {0, 0.0015f, 0}, {0, 0, 1}, {1, 0, 0}, grey);  // 1 mm thick, half a millimetre above
  const auto upper = static_cast<size_t>(scene.instances.back().mesh);
  addRectangle(scene, {-1, 0, -1}, {0, 0, 3}, {3, 0, 0}, grey);
  const RayScene rays(scene);
  EXPECT_NEAR(gapsOf(rays, 0.004f)[upper], 0.0015f, 1e-4f);
  EXPECT_EQ(gapsOf(rays, 0.001f)[upper], kInfinity);
}

}  // namespace
}  // namespace roomlight::bake
