// Sizes chosen and sizes given: the memory budget, empty and degenerate scenes, absurd extents.
#include <gtest/gtest.h>

#include "voxel_checks.h"

namespace roomlight {
namespace {

Scene roomWithSoup(float scale) {
  Scene scene = test::triangleSoup(2000, 6, 9);
  test::addRoom(scene, {-3, -3, -3}, {3, 3, 3}, std::vector<int>(6, 0));
  for (Instance& instance : scene.instances) {
    for (Vec3* column : {&instance.worldFromObject.x, &instance.worldFromObject.y, &instance.worldFromObject.z})
      *column *= scale;
  }
  return scene;
}

TEST(ChooseVoxelSize, KeepsToTheMemoryBudget) {
  for (const float budgetMiB : {16.0f, 64.0f, 256.0f}) {
    VoxelSettings settings;
    settings.memoryBudgetMiB = budgetMiB;
    settings.smallestM = 0.001f;
    settings.largestM = 100;
    const Scene scene = roomWithSoup(4);
    settings.voxelSizeM = chooseVoxelSize(scene, settings);
    const Voxelisation v = voxelise(scene, settings);
    // The budget also covers the light: about three times what the voxels alone take.
    EXPECT_LT(static_cast<double>(v.voxels.bytes()) / 1048576, static_cast<double>(budgetMiB)) << settings.voxelSizeM;
    EXPECT_GT(static_cast<double>(v.voxels.bytes()) / 1048576, 0.1 * static_cast<double>(budgetMiB))
        << settings.voxelSizeM;
  }
}

TEST(ChooseVoxelSize, StaysWithinItsLimitsAndObeysTheHand) {
  VoxelSettings settings;
  EXPECT_FLOAT_EQ(chooseVoxelSize(roomWithSoup(0.1f), settings), settings.smallestM);
  settings.voxelSizeM = 0.123f;
  EXPECT_EQ(chooseVoxelSize(roomWithSoup(1), settings), 0.123f);
}

TEST(ChooseVoxelSize, OfAHomeOnAHugeGroundKeepsTheIndexSmall) {
  Scene scene = roomWithSoup(1);
  test::addRectangle(scene, {-20000, 0, -20000}, {40000, 0, 0}, {0, 0, 40000}, 0);
  const float size = chooseVoxelSize(scene, {});
  EXPECT_TRUE(std::isfinite(size));
  EXPECT_LT(voxelise(scene, {}).voxels.bytes(), size_t{2048} << 20);
}

TEST(Voxelise, OfNothingIsEmpty) {
  const Voxelisation v = voxelise({}, {});
  EXPECT_TRUE(v.voxels.bricks.empty());
  EXPECT_TRUE(v.voxels.brickIndex.empty());
  EXPECT_EQ(v.voxels.voxelAt({0, 0, 0}), -1);
  EXPECT_EQ(v.firstReference.size(), 1u);
}

TEST(Voxelise, LeavesDegenerateTrianglesOut) {
  Scene scene;
  Mesh mesh;
  mesh.material = test::addMaterial(scene, test::lambertian(0.5f));
  mesh.positions = {{0, 0, 0}, {1, 1, 1}, {2, 2, 2}, {0.5f, 0.5f, 0.5f}};
  mesh.indices = {0, 0, 0, 0, 1, 2, 3, 3, 1};
  scene.meshes.push_back(mesh);
  scene.instances.push_back({"points and lines", 0, 0, {}});
  scene.instances.push_back({"flattened", 0, 1, {{0, 0, 0}, {0, 0, 0}, {0, 0, 0}, {1, 2, 3}}});
  const Voxelisation v = voxelise(scene, test::withSize(0.1f));
  EXPECT_TRUE(v.voxels.voxels.empty());
}

TEST(Voxelise, KeepsNeedlesFinite) {
  Scene scene;
  Mesh mesh;
  mesh.material = test::addMaterial(scene, test::lambertian(0.5f));
  mesh.positions = {{0, 0, 0}, {3, 0.1f, 0.2f}, {3, 0.1f, 0.200001f}, {-1, 1, 1e-6f}, {2, 1.00001f, 0}, {-1, 1, 0}};
  mesh.indices = {0, 1, 2, 3, 4, 5};
  scene.meshes.push_back(mesh);
  scene.instances.push_back({"needles", 0, 0, {}});
  for (const FaceSlot& slot : voxelise(scene, test::withSize(0.02f)).voxels.slots) {
    EXPECT_TRUE(isFinite(slot.position) && isFinite(slot.normal) && std::isfinite(slot.areaM2));
    EXPECT_NEAR(length(slot.normal), 1, 1e-4);
  }
}

void expectSane(const Voxelisation& v, float distanceM) {
  EXPECT_TRUE(std::isfinite(v.voxels.voxelSizeM)) << distanceM;
  EXPECT_LE(v.voxels.brickIndex.size(), 16'000'000u) << distanceM;
  for (const FaceSlot& slot : v.voxels.slots) ASSERT_TRUE(isFinite(slot.position)) << distanceM;
}

TEST(Voxelise, SurvivesScenesOfAbsurdSize) {
  VoxelSettings small;
  small.memoryBudgetMiB = 4;
  for (const float scale : {1e-12f, 1e-6f, 1e4f, 1e9f, 1e15f}) expectSane(voxelise(roomWithSoup(scale), small), scale);
}

TEST(Voxelise, SurvivesAbsurdDistancesWithASizeGivenByHand) {
  for (const float distanceM : {1e3f, 1e6f, 1e12f, 1e25f}) {
    Scene scene;
    test::addBox(scene, {0, 0, 0}, {1, 1, 1}, test::addMaterial(scene, test::lambertian(0.5f)));
    scene.instances.push_back(scene.instances[0]);
    scene.instances.back().worldFromObject.w = {distanceM, -distanceM, 0.1f * distanceM};
    expectSane(voxelise(scene, test::withSize(0.04f)), distanceM);
  }
}

TEST(Voxelise, FarFromTheOriginKeepsItsAreas) {
  Scene scene = test::triangleSoup(300, 3, 4);
  scene.instances[0].worldFromObject.w = {900, 20, -1100};
  double slots = 0;
  for (const FaceSlot& slot : voxelise(scene, test::withSize(0.04f)).voxels.slots)
    slots += static_cast<double>(slot.areaM2);
  EXPECT_NEAR(slots, 2 * test::meshAreaM2(scene), 0.005 * slots);
}

}  // namespace
}  // namespace roomlight
