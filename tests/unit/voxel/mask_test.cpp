// Sub-voxel masks: no ray slips through a closed surface, and walls are no thicker than they need to be.
#include <gtest/gtest.h>

#include "voxel_checks.h"

namespace roomlight {
namespace {

bool isSet(const Voxels& voxels, const std::array<int, 3>& cell) {
  if (cell[0] < 0 || cell[1] < 0 || cell[2] < 0) return false;
  const int64_t i = voxels.voxelAt({cell[0] / 4, cell[1] / 4, cell[2] / 4});
  if (i < 0) return false;
  return (voxels.voxels[static_cast<size_t>(i)].mask >> ((cell[0] & 3) + 4 * (cell[1] & 3) + 16 * (cell[2] & 3))) & 1;
}

// Marches from cell to cell (Amanatides and Woo 1987) until a set one or the end of the grid.
bool escapes(const Voxels& voxels, Vec3 from, Vec3 direction) {
  const double sub = static_cast<double>(voxels.voxelSizeM) / 4;
  std::array<int, 3> cell{}, step{};
  std::array<double, 3> next{}, delta{};
  const std::array<int, 3> end{voxels.brickDims.x * 32, voxels.brickDims.y * 32, voxels.brickDims.z * 32};
  for (size_t k = 0; k < 3; ++k) {
    const int axis = static_cast<int>(k);
    const double q = (static_cast<double>(from[axis]) - static_cast<double>(voxels.origin[axis])) / sub,
                 d = static_cast<double>(direction[axis]);
    cell[k] = static_cast<int>(std::floor(q));
    step[k] = d < 0 ? -1 : 1;
    delta[k] = d == 0 ? 1e30 : 1 / std::abs(d);
    next[k] = d == 0 ? 1e30 : (d < 0 ? q - cell[k] : cell[k] + 1 - q) * delta[k];
  }
  while (true) {
    if (isSet(voxels, cell)) return false;
    const size_t k = next[0] < next[1] ? (next[0] < next[2] ? 0 : 2) : (next[1] < next[2] ? 1 : 2);
    cell[k] += step[k];
    next[k] += delta[k];
    if (cell[k] < 0 || cell[k] >= end[k]) return true;
  }
}

int countEscapes(const Scene& scene, float voxelSizeM, Vec3 from, int rays) {
  const Voxelisation v = voxelise(scene, test::withSize(voxelSizeM));
  std::mt19937 random(5);
  std::normal_distribution<float> normal;
  int escaped = 0;
  for (int i = 0; i < rays; ++i) {
    const Vec3 d = normalize(Vec3{normal(random), normal(random), normal(random)});
    escaped += escapes(v.voxels, from, d);
  }
  return escaped;
}

Scene closedRoom(int cells) {
  Scene scene;
  const int grey = test::addMaterial(scene, test::lambertian(0.5f));
  const Vec3 lo{-2, -1.5f, -1.8f}, hi{2, 1.5f, 1.8f};
  test::addRoom(scene, lo, hi, std::vector<int>(6, grey));
  if (cells > 1) {
    scene = {};
    test::addMaterial(scene, test::lambertian(0.5f));
    const Vec3 x{4, 0, 0}, y{0, 3, 0}, z{0, 0, 3.6f};
    test::addRectangle(scene, lo, y, z, 0, cells), test::addRectangle(scene, lo + x, z, y, 0, cells);
    test::addRectangle(scene, lo, z, x, 0, cells), test::addRectangle(scene, lo + y, x, z, 0, cells);
    test::addRectangle(scene, lo, x, y, 0, cells), test::addRectangle(scene, lo + z, y, x, 0, cells);
  }
  return scene;
}

TEST(VoxelMasks, HoldEveryRayInARoomAlongTheAxes) {
  for (const float h : {0.05f, 0.1f, 0.33f})
    EXPECT_EQ(countEscapes(closedRoom(1), h, {0.013f, 0.021f, 0.017f}, 20000), 0) << h;
}

TEST(VoxelMasks, HoldEveryRayInATurnedRoomOfSmallTriangles) {
  for (int turn = 1; turn <= 8; ++turn) {
    Scene scene = closedRoom(9);
    const Affine m =
        test::turned(0.37f * static_cast<float>(turn), {1, 0.3f * static_cast<float>(turn), 2}, {3, 1, -7});
    for (Instance& instance : scene.instances) instance.worldFromObject = m;
    EXPECT_EQ(countEscapes(scene, 0.09f, {3, 1, -7}, 20000), 0) << turn;
  }
}

int cellsSetAlongX(const Voxels& voxels, int y, int z) {
  int set = 0;
  for (int x = 0; x < voxels.brickDims.x * 32; ++x) set += isSet(voxels, {x, y, z});
  return set;
}

TEST(VoxelMasks, AFlatWallIsOneSubVoxelThickWhereverItStands) {
  for (const float x : {0.0f, 0.1f, 0.125f, 0.15f, 0.175f, 0.1834f, 0.8f, -0.4f, -0.025f}) {
    Scene scene;
    test::addRectangle(scene, {x, -0.4f, -0.4f}, {0, 0.8f, 0}, {0, 0, 0.8f},
                       test::addMaterial(scene, test::lambertian(0.5f)), 3);
    const Voxels voxels = voxelise(scene, test::withSize(0.1f)).voxels;
    const Int3 middle = voxels.voxelOf({x, 0, 0});
    for (int k = -12; k < 12; ++k)
      EXPECT_EQ(cellsSetAlongX(voxels, middle.y * 4 + k, middle.z * 4 + k), 1) << x << ' ' << k;
  }
}

TEST(VoxelMasks, ASlantedWallIsAtMostThreeSubVoxelsThick) {
  Scene scene;
  test::addRectangle(scene, {0.03f, 0, 0}, {0.8f, 1.0f, 0.1f}, {0.2f, -0.1f, 1.1f},
                     test::addMaterial(scene, test::lambertian(0.5f)));
  const Voxels voxels = voxelise(scene, test::withSize(0.1f)).voxels;
  int thickest = 0;
  for (int y = 0; y < voxels.brickDims.y * 32; ++y) {
    for (int z = 0; z < voxels.brickDims.z * 32; ++z) thickest = std::max(thickest, cellsSetAlongX(voxels, y, z));
  }
  EXPECT_LE(thickest, 3);
}

TEST(VoxelOpacity, OfAWallIsFullAcrossAndThinAlong) {
  Scene scene;
  test::addRectangle(scene, {0.053f, -1, -1}, {0, 2, 0}, {0, 0, 2}, test::addMaterial(scene, test::lambertian(0.5f)));
  const Voxels voxels = voxelise(scene, test::withSize(0.1f)).voxels;
  const int64_t i = voxels.voxelAt(voxels.voxelOf({0.053f, 0.05f, 0.05f}));
  ASSERT_GE(i, 0);
  const Vec3 opacity = voxels.voxels[static_cast<size_t>(i)].opacity;
  EXPECT_NEAR(opacity.x, 1, 1e-4);
  EXPECT_LE(opacity.y, 0.25f);
  EXPECT_LE(opacity.z, 0.25f);
}

}  // namespace
}  // namespace roomlight
