#include "bake/rings.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>

#include "bake/atlas.h"
#include "support/rooms.h"
#include "trace/surface_point.h"

namespace roomlight::bake {
namespace {

constexpr float kWideM = 3.2f;
constexpr uint32_t kGround = 0;

// A chair's bounds on 60 x 60 m, whose texture coordinates are its place.
Scene boxOnGround() {
  Scene scene;
  const int grey = addMaterial(scene, lambertian(0.5f));
  addRectangle(scene, {-30, 0, -30}, {0, 0, 60}, {60, 0, 0}, grey);
  Mesh& ground = scene.meshes[0];
  for (const Vec3 p : ground.positions) ground.uv[0].push_back({p.x, p.z});
  addBox(scene, {1, 0, 2}, {1.6f, 1, 2.6f}, grey);
  return scene;
}

float areaOf(const Scene& scene, uint32_t instance, uint32_t triangle) {
  const TriangleVertices v = worldTriangle(scene, instance, triangle);
  return length(cross(v.b - v.a, v.c - v.a)) / 2;
}

TEST(Rings, areAroundWhatStandsOnTheGroundAndItsShadow) {
  Scene scene = boxOnGround();
  const Rings rings = cutIntoRings(scene, kWideM);
  ASSERT_EQ(rings.size(), scene.meshes.size());
  ASSERT_EQ(rings[0].size(), scene.meshes[0].triangleCount());
  std::map<int, float> areas;
  for (uint32_t t = 0; t < rings[0].size(); ++t) areas[rings[0][t]] += areaOf(scene, kGround, t);
  // The box and a metre around it: 2.6 m; then 10.4 m, and 41.6 would leave too little.
  ASSERT_EQ(areas.size(), 3u);
  EXPECT_NEAR(areas[0], 2.6f * 2.6f, 0.01f);
  EXPECT_NEAR(areas[1], 10.4f * 10.4f - 2.6f * 2.6f, 0.1f);
  EXPECT_NEAR(areas[0] + areas[1] + areas[2], 3600, 1);
}

TEST(Rings, leaveTheSurfaceAsItWas) {
  Scene scene = boxOnGround();
  cutIntoRings(scene, kWideM);
  const Mesh& ground = scene.meshes[0];
  ASSERT_EQ(ground.uv[0].size(), ground.positions.size());
  for (size_t i = 0; i < ground.positions.size(); ++i) {
    EXPECT_EQ(ground.positions[i].y, 0);
    EXPECT_NEAR(ground.uv[0][i].x, ground.positions[i].x, 1e-4f);
    EXPECT_NEAR(ground.uv[0][i].y, ground.positions[i].z, 1e-4f);
  }
  // No slits: each edge but those of the border belongs to two triangles, one each way.
  std::multiset<std::pair<uint32_t, uint32_t>> edges;
  for (size_t i = 0; i < ground.indices.size(); ++i)
    edges.insert({ground.indices[i], ground.indices[i / 3 * 3 + (i + 1) % 3]});
  for (const auto& [a, b] : edges) {
    EXPECT_EQ(edges.count({a, b}), 1u);
    const Vec3 middle = (ground.positions[a] + ground.positions[b]) / 2;
    const bool border = std::abs(std::abs(middle.x) - 30) < 1e-3f || std::abs(std::abs(middle.z) - 30) < 1e-3f;
    EXPECT_EQ(edges.count({b, a}), border ? 0u : 1u) << middle.x << " " << middle.z;
  }
}

TEST(Rings, areChartsOfTheirOwnWithTexelsAsFineAsTheyAreNear) {
  Scene scene = boxOnGround();
  const Rings rings = cutIntoRings(scene, kWideM);
  SeenSides seen(scene);
  for (uint32_t t = 0; t < rings[0].size(); ++t) seen.mark(kGround, t, false);
  const Atlas atlas = atlasOf(scene, chartsOf(scene, seen, {}, rings), {}).value();
  ASSERT_EQ(atlas.charts.size(), 3u);
  std::map<int, float> texelM;
  for (const PlacedChart& placed : atlas.charts) texelM[placed.chart.ring] = 1 / placed.grid.perM.x;
  EXPECT_NEAR(texelM[0], 0.05f, 0.001f);
  EXPECT_NEAR(texelM[1], 10.4f / 63, 0.001f);
  EXPECT_NEAR(texelM[2], 60.0f / 63, 0.01f);
}

// Triangles that share no vertices, as flat shading has them.
TEST(Rings, areWholeWhereTrianglesHaveVerticesOfTheirOwn) {
  Scene scene = boxOnGround();
  Mesh& ground = scene.meshes[0];
  ground.uv[0].clear(), ground.normals.clear();
  ground.positions = {{-20.3f, 0, -19.1f}, {19.7f, 0, 20.3f},   {19.7f, 0, -19.1f},
                      {19.7f, 0, 20.3f},   {-20.3f, 0, -19.1f}, {-20.3f, 0, 20.3f}};
  ground.indices = {0, 1, 2, 3, 4, 5};
  const Rings rings = cutIntoRings(scene, kWideM);
  SeenSides seen(scene);
  for (uint32_t t = 0; t < rings[0].size(); ++t) seen.mark(kGround, t, false);
  EXPECT_EQ(chartsOf(scene, seen, {}, rings).size(), 3u);
}

TEST(Rings, aTinyOneHasTexelsToo) {
  Scene scene;
  addRectangle(scene, {-3, 0, -3}, {0, 0, 6}, {6, 0, 0}, addMaterial(scene, lambertian(0.5f)));
  addBox(scene, {0, 0, 0}, {0.1f, 0.02f, 0.1f}, 0);
  const Rings rings = cutIntoRings(scene, kWideM);
  ASSERT_FALSE(rings[0].empty());
  SeenSides seen(scene);
  for (uint32_t t = 0; t < rings[0].size(); ++t) seen.mark(kGround, t, false);
  for (const Chart& chart : chartsOf(scene, seen, {}, rings)) EXPECT_FALSE(chart.byVertices);
}

TEST(Rings, ofACeilingOverThingsThereAreNone) {
  Scene scene = boxOnGround();
  scene.instances[0].worldFromObject.w.y = 3;
  EXPECT_TRUE(cutIntoRings(scene, kWideM)[0].empty());
}

TEST(Rings, aThingBesideABuildingIsNotAllThatIsLookedAt) {
  Scene scene = boxOnGround();
  EXPECT_NEAR(extentLookedAt(scene), 1, 1e-5f);
  addBox(scene, {-20, 0, -20}, {20, 9, 20}, 0);
  EXPECT_NEAR(extentLookedAt(scene), 60, 1e-4f);
}

TEST(Rings, areNotCutWhereThingsStandAllOver) {
  Scene scene = boxOnGround();
  addBox(scene, {-15, 0, -15}, {-14, 1, -14}, 0);
  addBox(scene, {15, 0, 15}, {16, 1, 16}, 0);
  const size_t triangles = scene.meshes[0].triangleCount();
  const Rings rings = cutIntoRings(scene, kWideM);
  EXPECT_TRUE(rings[0].empty());
  EXPECT_EQ(scene.meshes[0].triangleCount(), triangles);
}

TEST(Rings, ofAMeshPlacedTwiceThereAreNone) {
  Scene scene = boxOnGround();
  scene.instances.push_back(scene.instances[0]);
  scene.instances.back().worldFromObject.w = {100, 0, 0};
  EXPECT_TRUE(cutIntoRings(scene, kWideM)[0].empty());
}

TEST(Rings, ofADomeThereAreNoneButTheGroundInItHasSome) {
  Scene scene = boxOnGround();
  addSphere(scene, {0, 0, 0}, 40, 0);
  const Rings rings = cutIntoRings(scene, kWideM);
  EXPECT_FALSE(rings[0].empty());
}

}  // namespace
}  // namespace roomlight::bake
