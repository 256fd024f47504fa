// Nothing of a surface is lost or counted twice between voxels.
#include <gtest/gtest.h>

#include "voxel_checks.h"

namespace roomlight {
namespace {

struct Sums {
  double areaM2 = 0, fluxLm = 0;
};

Sums sumsOf(const Voxels& voxels) {
  Sums sums;
  for (const FaceSlot& slot : voxels.slots) {
    sums.areaM2 += static_cast<double>(slot.areaM2);
    sums.fluxLm +=
        static_cast<double>(luminance(slot.emission)) * static_cast<double>(slot.areaM2) * static_cast<double>(kPi);
  }
  return sums;
}

TEST(VoxelAreas, SlotsOfBothSidesAddUpToTheTriangles) {
  for (const float voxelSizeM : {0.03f, 0.1f, 0.37f}) {
    const Scene scene = test::triangleSoup(400, 4, 7);
    const double area = test::meshAreaM2(scene);
    EXPECT_NEAR(sumsOf(voxelise(scene, test::withSize(voxelSizeM)).voxels).areaM2, 2 * area, 2e-5 * area) << voxelSizeM;
  }
}

TEST(VoxelAreas, HoldUnderTransformsThatMirrorAndStretch) {
  Scene scene = test::triangleSoup(200, 3, 3);
  Affine& m = scene.instances[0].worldFromObject;
  m = test::turned(0.7f, {1, 2, 3}, {30, -20, 10});
  m.x *= -1.5f;
  const double area = test::meshAreaM2(scene);
  EXPECT_NEAR(sumsOf(voxelise(scene, test::withSize(0.08f)).voxels).areaM2, 2 * area, 5e-5 * area);
}

TEST(VoxelAreas, WallsOnTheLatticeBelongToOneVoxelEach) {
  Scene scene;
  const int grey = test::addMaterial(scene, test::lambertian(0.5f));
  test::addRectangle(scene, {0.8f, 0, 0}, {0, 1.6f, 0}, {0, 0, 1.6f}, grey, 3);  // on a plane between bricks
  const Voxelisation v = voxelise(scene, test::withSize(0.1f));
  EXPECT_NEAR(sumsOf(v.voxels).areaM2, 2 * 1.6 * 1.6, 1e-5);
  EXPECT_EQ(v.voxels.voxels.size(), 16u * 16u);
}

TEST(VoxelFlux, OfAOneSidedPanelIsPiTimesLuminanceTimesArea) {
  Scene scene;
  const int lamp = test::addMaterial(scene, test::lambertian(0.0f, 1000));
  test::addRectangle(scene, {0.13f, 2, 0.2f}, {0.9f, 0.1f, 0.05f}, {-0.1f, 0.3f, 0.7f}, lamp, 5);
  const double expected = static_cast<double>(kPi) * 1000 * test::meshAreaM2(scene);
  EXPECT_NEAR(sumsOf(voxelise(scene, test::withSize(0.07f)).voxels).fluxLm, expected, 2e-5 * expected);
}

TEST(VoxelFlux, OfADoubleSidedPanelIsTwiceThat) {
  Scene scene;
  Material material = test::lambertian(0.0f, 1000);
  material.doubleSided = true;
  test::addRectangle(scene, {0, 2, 0}, {0.9f, 0.1f, 0.05f}, {-0.1f, 0.3f, 0.7f}, test::addMaterial(scene, material));
  const double expected = 2 * static_cast<double>(kPi) * 1000 * test::meshAreaM2(scene);
  EXPECT_NEAR(sumsOf(voxelise(scene, test::withSize(0.07f)).voxels).fluxLm, expected, 2e-5 * expected);
}

TEST(VoxelFlux, OfABlendedPanelIsWhatThePathTracerSees) {
  Scene scene;
  Material material = test::lambertian(0.0f, 1000);
  material.alphaMode = AlphaMode::Blend;
  material.alpha = 0.25f;
  test::addRectangle(scene, {0, 2, 0}, {1, 0, 0}, {0, 0, 1}, test::addMaterial(scene, material));
  const Sums sums = sumsOf(voxelise(scene, test::withSize(0.1f)).voxels);
  EXPECT_NEAR(sums.areaM2, 2 * 0.25, 1e-4);  // only what blocks light
  EXPECT_NEAR(sums.fluxLm, 0.25 * static_cast<double>(kPi) * 1000, 0.1);
}

}  // namespace
}  // namespace roomlight
