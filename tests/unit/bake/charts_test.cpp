#include "bake/charts.h"

#include <gtest/gtest.h>

#include "support/rooms.h"

namespace roomlight::bake {
namespace {

SeenSides allSeen(const Scene& scene, bool front, bool back) {
  SeenSides seen(scene);
  for (uint32_t i = 0; i < scene.instances.size(); ++i) {
    for (uint32_t t = 0; t < scene.meshes[static_cast<size_t>(scene.instances[i].mesh)].triangleCount(); ++t) {
      if (front) seen.mark(i, t, false);
      if (back) seen.mark(i, t, true);
    }
  }
  return seen;
}

float areaOf(const std::vector<Chart>& charts) {
  float sum = 0;
  for (const Chart& c : charts) sum += c.areaM2;
  return sum;
}

TEST(Charts, aRectangleIsOneChartAlongItsEdges) {
  Scene scene;
  addRectangle(scene, {1, 0, 2}, {3, 0, 0}, {0, 0, -2}, addMaterial(scene, lambertian(0.5f)), 4);
  const std::vector<Chart> charts = chartsOf(scene, allSeen(scene, true, false), {});
  ASSERT_EQ(charts.size(), 1u);
  EXPECT_EQ(charts[0].triangles.size(), 32u);
  EXPECT_FALSE(charts[0].byVertices);
  EXPECT_NEAR(charts[0].areaM2, 6, 1e-4);
  EXPECT_NEAR(charts[0].sizeM.x * charts[0].sizeM.y, 6, 1e-3);
  EXPECT_NEAR(charts[0].normal.y, 1, 1e-6);
}

TEST(Charts, bothSidesWhereBothAreSeen) {
  Scene scene;
  addRectangle(scene, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}, addMaterial(scene, lambertian(0.5f)));
  const std::vector<Chart> charts = chartsOf(scene, allSeen(scene, true, true), {});
  ASSERT_EQ(charts.size(), 2u);
  EXPECT_NEAR(dot(charts[0].normal, charts[1].normal), -1, 1e-6);
  EXPECT_NE(charts[0].back, charts[1].back);
}

TEST(Charts, whatNobodySeesIsLeftOut) {
  Scene scene;
  addRectangle(scene, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}, addMaterial(scene, lambertian(0.5f)));
  EXPECT_TRUE(chartsOf(scene, SeenSides(scene), {}).empty());
}

TEST(Charts, aRoomHasSix) {
  Scene scene;
  addRoom(scene, {0, 0, 0}, {4, 2.5f, 3}, std::vector<int>(6, addMaterial(scene, lambertian(0.5f))));
  const std::vector<Chart> charts = chartsOf(scene, allSeen(scene, true, false), {});
  EXPECT_EQ(charts.size(), 6u);
  EXPECT_NEAR(areaOf(charts), 2 * (12 + 10 + 7.5f), 1e-3);
}

TEST(Charts, aRoundThingIsCutIntoNearlyFlatOnes) {
  Scene scene;
  addSphere(scene, {0, 1, 0}, 1, addMaterial(scene, lambertian(0.5f)));
  const std::vector<Chart> charts = chartsOf(scene, allSeen(scene, true, false), {});
  EXPECT_GT(charts.size(), 6u);
  EXPECT_LT(charts.size(), 200u);
  EXPECT_NEAR(areaOf(charts), 4 * kPi, 0.2f);
}

TEST(Charts, whatIsFineIsLitByVerticesTogether) {
  Scene scene;
  addSphere(scene, {0, 1, 0}, 0.04f, addMaterial(scene, lambertian(0.5f)));
  const std::vector<Chart> charts = chartsOf(scene, allSeen(scene, true, false), {});
  ASSERT_EQ(charts.size(), 1u);
  EXPECT_TRUE(charts[0].byVertices);
}

TEST(Charts, facesThatAreThereTwiceAreStillOneChartEach) {
  for (const Vec3 along : {Vec3(0, 0, 2), Vec3(2, 0, 0)}) {  // a wall that faces x, one that faces z
    Scene scene;
    addRectangle(scene, {0, 0, 0}, along, {0, 1, 0}, addMaterial(scene, lambertian(0.5f)));
    Mesh& mesh = scene.meshes[0];
    const std::vector<uint32_t> once = mesh.indices;
    mesh.indices.insert(mesh.indices.end(), once.begin(), once.end());
    const std::vector<Chart> charts = chartsOf(scene, allSeen(scene, true, false), {});
    ASSERT_EQ(charts.size(), 2u);
    for (const Chart& c : charts) {
      EXPECT_FALSE(c.byVertices);
      EXPECT_NEAR(c.sizeM.x * c.sizeM.y, 2, 1e-3);
    }
  }
}

TEST(Charts, trianglesWithoutAreaAndWithoutPlaceAreLeftOut) {
  Scene scene;
  addRectangle(scene, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}, addMaterial(scene, lambertian(0.5f)));
  Mesh& mesh = scene.meshes[0];
  mesh.indices.insert(mesh.indices.end(), {0, 0, 1});
  const std::vector<Chart> charts = chartsOf(scene, allSeen(scene, true, false), {});
  ASSERT_EQ(charts.size(), 1u);
  EXPECT_EQ(charts[0].triangles.size(), 2u);
}

}  // namespace
}  // namespace roomlight::bake
