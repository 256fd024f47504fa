// What a slot reflects is the mean over the surfaces on its side.
#include <gtest/gtest.h>

#include "voxel_checks.h"

namespace roomlight {
namespace {

// Squares of black and white, `squares` along an edge, as the base colour.
Texture checker(int squares, int texelsPerSquare) {
  Texture texture;
  texture.width = texture.height = squares * texelsPerSquare;
  for (int y = 0; y < texture.height; ++y) {
    for (int x = 0; x < texture.width; ++x) {
      const auto value = static_cast<uint8_t>((x / texelsPerSquare + y / texelsPerSquare) % 2 ? 255 : 0);
      for (const uint8_t byte : {value, value, value, uint8_t{255}}) texture.rgba.push_back(byte);
    }
  }
  return texture;
}

// A floor of 2 m under the checker.
Scene checkeredFloor(int squares, int texelsPerSquare) {
  Scene scene;
  scene.textures.push_back(checker(squares, texelsPerSquare));
  Material material = test::lambertian(1);
  material.baseColorTexture.texture = 0;
  test::addRectangle(scene, {0.013f, 0.02f, 0.017f}, {2, 0, 0}, {0, 0.01f, 2}, test::addMaterial(scene, material));
  scene.meshes[0].uv[0] = {{0, 0}, {1, 0}, {0, 1}, {1, 1}};
  return scene;
}

double meanAlbedo(const Voxels& voxels) {
  double sum = 0, area = 0;
  for (const FaceSlot& slot : voxels.slots) {
    sum += static_cast<double>(luminance(slot.albedo)) * static_cast<double>(slot.areaM2);
    area += static_cast<double>(slot.areaM2);
  }
  return sum / area;
}

TEST(VoxelAlbedo, OfACoarseCheckerIsBlackOrWhiteInsideItsSquares) {
  const Voxels voxels = voxelise(checkeredFloor(4, 8), test::withSize(0.05f)).voxels;
  int pure = 0;
  for (const FaceSlot& slot : voxels.slots) pure += slot.albedo.x < 0.01f || slot.albedo.x > 0.99f;
  EXPECT_GT(pure, static_cast<int>(voxels.slots.size() * 6 / 10));
  EXPECT_NEAR(meanAlbedo(voxels), 0.5, 0.02);
}

TEST(VoxelAlbedo, OfAFineCheckerIsGreyInEveryVoxel) {
  const Voxels voxels = voxelise(checkeredFloor(128, 8), test::withSize(0.1f)).voxels;  // 40 squares in a voxel
  EXPECT_NEAR(meanAlbedo(voxels), 0.5, 0.02);
  double squares = 0, count = 0;
  for (const FaceSlot& slot : voxels.slots) {
    if (slot.areaM2 < 0.008f) continue;
    EXPECT_NEAR(slot.albedo.x, 0.5f, 0.3f);  // from sixteen samples a triangle
    squares += static_cast<double>((slot.albedo.x - 0.5f) * (slot.albedo.x - 0.5f));
    ++count;
  }
  EXPECT_LT(std::sqrt(squares / count), 0.12);
}

TEST(VoxelAlbedo, IsThatOfEachSideOfAThinWall) {
  Scene scene;
  const int dark = test::addMaterial(scene, test::lambertian(0.1f)),
            bright = test::addMaterial(scene, test::lambertian(0.9f));
  test::addRectangle(scene, {0.052f, 0, 0}, {0, 1, 0}, {0, 0, 1}, dark);    // faces +x
  test::addRectangle(scene, {0.032f, 0, 0}, {0, 0, 1}, {0, 1, 0}, bright);  // faces -x, 2 cm apart
  const Voxels voxels = voxelise(scene, test::withSize(0.1f)).voxels;
  const int64_t i = voxels.voxelAt(voxels.voxelOf({0.04f, 0.55f, 0.55f}));
  ASSERT_GE(i, 0);
  const SurfaceVoxel& voxel = voxels.voxels[static_cast<size_t>(i)];
  const auto side = [&](int face) { return voxels.slots[static_cast<size_t>(voxels.slotAt(voxel, face))]; };
  EXPECT_NEAR(side(0).position.x, 0.052f, 1e-5f);
  EXPECT_NEAR(side(1).position.x, 0.032f, 1e-5f);
  EXPECT_NEAR(side(0).albedo.x, 0.1f, 1e-3f);
  EXPECT_NEAR(side(1).albedo.x, 0.9f, 1e-3f);
}

TEST(VoxelAlbedo, OfASingleSheetIsTheSameOnBothSides) {
  Scene scene;
  test::addRectangle(scene, {0.05f, 0, 0}, {0, 1, 0}, {0, 0, 1}, test::addMaterial(scene, test::lambertian(0.3f)));
  for (const FaceSlot& slot : voxelise(scene, test::withSize(0.1f)).voxels.slots) {
    EXPECT_NEAR(slot.albedo.x, 0.3f, 1e-5f);
    EXPECT_NEAR(std::abs(slot.normal.x), 1, 1e-6f);
    EXPECT_GT(slot.normal.x * faceDirection(slot.face).x, 0);
  }
}

}  // namespace
}  // namespace roomlight
