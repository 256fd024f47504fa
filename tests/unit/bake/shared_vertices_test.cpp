#include "bake/shared_vertices.h"

#include <gtest/gtest.h>

#include "bake/simplify.h"
#include "support/rooms.h"

namespace roomlight::bake {
namespace {

constexpr std::array<Vec3, 3> kSmall{{{0, 0, 0}, {0, 0, 0.01f}, {0.01f, 0, 0}}};
constexpr std::array<Vec3, 3> kLarge{{{0.001f, 0, 0}, {0, 0, 1}, {1, 0, 0}}};

TEST(SharedVertices, thoseInOneCellThatFaceTheSameWayShareAPlace) {
  SharedVertices shared(0.02f);
  const auto placeOf = [&](uint32_t vertex, Vec3 position, Vec3 normal, const std::array<Vec3, 3>& triangle) {
    return shared.placeOf(shared.add(vertex, position, normal, triangle));
  };
  const size_t first = placeOf(0, kSmall[0], {0, 1, 0}, kSmall);
  EXPECT_EQ(placeOf(1, kLarge[0], {0.05f, 1, 0}, kLarge), first);
  EXPECT_NE(placeOf(2, kSmall[0], {0, -1, 0}, kSmall), first) << "the other side of a leaf";
  EXPECT_NE(placeOf(3, {0.03f, 0, 0}, {0, 1, 0}, kSmall), first);
  EXPECT_EQ(shared.count(), 4u);
  EXPECT_EQ(shared.places()[first].position, kLarge[0]) << "place and middle are of one triangle";
  EXPECT_NEAR(shared.places()[first].middle.z, 1 / 3.0f, 1e-5f);
}

TEST(SharedVertices, withoutCellsThoseAtOnePlaceAlone) {
  SharedVertices shared(0);
  shared.add(0, {0, 0, 0}, {0, 1, 0}, kSmall), shared.add(1, {1e-6f, 0, 0}, {0, 1, 0}, kSmall);
  shared.add(2, {0, 0, 0}, {0, 1, 0}, kSmall);
  EXPECT_EQ(shared.places().size(), 2u);
}

TEST(Simplify, whatIsFarFromAllEyesMayBeCoarser) {
  Scene scene;
  const int grey = addMaterial(scene, lambertian(0.5f));
  addRectangle(scene, {-1, 0, 5}, {2, 0, 0}, {0, 2, 0}, grey);
  addRectangle(scene, {-1, 0, 100}, {2, 0, 0}, {0, 2, 0}, grey);
  addRectangle(scene, {-1, 0, 0.2f}, {2, 0, 0}, {0, 2, 0}, grey);
  const std::vector<Vec3> eyes{{0, 1, 0}, {0, 1, -3}};
  EXPECT_EQ(coarserFar(scene, eyes), (std::vector<float>{5, 20, 1}));
  EXPECT_EQ(coarserFar(scene, {}), (std::vector<float>{1, 1, 1}));
}

}  // namespace
}  // namespace roomlight::bake
