// Trees of triangles answer as a look at all triangles would.
#include "scene/triangle_tree.h"

#include <gtest/gtest.h>

#include "scene/primitives.h"

namespace roomlight {
namespace {

Mesh sphere(Vec3 centre, float radius) {
  Scene scene;
  addSphere(scene, centre, radius, addMaterial(scene, lambertian(0.5f)));
  return scene.meshes[0];
}

Affine movedBy(Vec3 by) {
  Affine out;
  out.w = by;
  return out;
}

TEST(TriangleTree, lineCrossesFrontAndBack) {
  const Mesh ball = sphere({0, 0, 0}, 1);
  TriangleTree tree(ball, movedBy({5, 0, 0}));
  EXPECT_NEAR(tree.bounds().centre().x, 5, 1e-5f);
  std::vector<LineCrossing> met;
  addCrossings(tree, {5.03f, 3, 0.02f}, {5.03f, -3, 0.02f}, met);
  ASSERT_EQ(met.size(), 2u);
  std::sort(met.begin(), met.end(), [](const LineCrossing& a, const LineCrossing& b) { return a.t < b.t; });
  EXPECT_NEAR(met[0].t, 1.0f / 3, 2e-3f);
  EXPECT_NEAR(met[1].t, 2.0f / 3, 2e-3f);
  EXPECT_LT(met[0].cosine, -0.9f);
  EXPECT_GT(met[1].cosine, 0.9f);
  met.clear();
  addCrossings(tree, {5, 3, 0}, {5, 1.1f, 0}, met);
  EXPECT_TRUE(met.empty());
}

TEST(TriangleTree, surfacesMeetWhereTheyPassOrComeNear) {
  const Mesh ball = sphere({0, 0, 0}, 1);
  TriangleTree a(ball, Affine()), b(ball, movedBy({2.1f, 0, 0}));
  EXPECT_FALSE(trianglesMeet(a, b, Affine(), 0));
  EXPECT_FALSE(trianglesMeet(a, b, Affine(), 0.09f));
  EXPECT_TRUE(trianglesMeet(a, b, Affine(), 0.11f));
  EXPECT_TRUE(trianglesMeet(a, b, movedBy({0.15f, 0, 0}), 0));
  const Mesh small = sphere({0, 0, 0}, 0.5f);
  TriangleTree inner(small, Affine());
  EXPECT_FALSE(trianglesMeet(inner, a, Affine(), 0));
}

TEST(TriangleTree, whatStandsOnAPlaneDoesNotPassThroughIt) {
  Scene scene;
  const int grey = addMaterial(scene, lambertian(0.5f));
  addRectangle(scene, {0, 0, 0}, {0, 0, 4}, {4, 0, 0}, grey);
  addRectangle(scene, {2, 0, 1}, {1, 0, 0}, {0, 1, 0}, grey);
  TriangleTree floor(scene.meshes[0], Affine()), panel(scene.meshes[1], Affine());
  EXPECT_FALSE(trianglesMeet(panel, floor, Affine(), 0));
  EXPECT_FALSE(trianglesMeet(panel, floor, movedBy({0, -1e-5f, 0}), 0));
  EXPECT_TRUE(trianglesMeet(panel, floor, movedBy({0, -1e-3f, 0}), 0));
  EXPECT_TRUE(trianglesMeet(floor, panel, movedBy({0, 1e-3f, 0}), 0));
}

TEST(TriangleTree, thePointNearestToAnother) {
  const Corners q{Vec3{0, 0, 0}, Vec3{1, 0, 0}, Vec3{0, 1, 0}};
  EXPECT_EQ(nearestOn(q, {-1, -1, 2}), Vec3(0, 0, 0));
  EXPECT_EQ(nearestOn(q, {0.5f, -1, 0}), Vec3(0.5f, 0, 0));
  EXPECT_NEAR(length(nearestOn(q, {1, 1, 5}) - Vec3(0.5f, 0.5f, 0)), 0, 1e-6f);
  EXPECT_NEAR(length(nearestOn(q, {0.25f, 0.25f, -3}) - Vec3(0.25f, 0.25f, 0)), 0, 1e-6f);
}

}  // namespace
}  // namespace roomlight
