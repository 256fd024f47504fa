#include "import/triangles.h"

#include <gtest/gtest.h>

namespace roomlight::importers {
namespace {

// Area of the triangles that point along +z minus that of those that point away.
float areaOf(const std::vector<Vec3>& p, bool* allAlongZ) {
  float area = 0;
  *allAlongZ = true;
  for (const auto& t : triangulate(p)) {
    const float a = cross(p[t[1]] - p[t[0]], p[t[2]] - p[t[0]]).z / 2;
    *allAlongZ = *allAlongZ && a > 0;
    area += a;
  }
  return area;
}

TEST(Polygon, concavePolygonsAreCutInside) {
  const std::vector<std::vector<Vec3>> polygons = {
      {{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}},  // square: 4
      {{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {1, 0.5f, 0}},  // dart
      {{0, 0, 0}, {3, 0, 0}, {3, 1, 0}, {1, 1, 0}, {1, 3, 0}, {0, 3, 0}},  // L: 5
      {{0, 0, 0}, {5, 0, 0}, {5, 3, 0}, {4, 3, 0}, {4, 1, 0}, {1, 1, 0}, {1, 3, 0}, {0, 3, 0}}};  // U: 9
  const float areas[] = {4, 1.5f, 5, 9};
  for (size_t i = 0; i < polygons.size(); ++i) {
    bool allAlongZ = false;
    EXPECT_FLOAT_EQ(areaOf(polygons[i], &allAlongZ), areas[i]) << i;
    EXPECT_TRUE(allAlongZ) << i;
    EXPECT_EQ(triangulate(polygons[i]).size(), polygons[i].size() - 2);
  }
}

// A comb of 1200 corners: teeth of half its width, as a shelf or the door of a fridge with its holes has them.
TEST(Polygon, manyCornersAreCutInsideToo) {
  constexpr int kTeeth = 300;
  std::vector<Vec3> comb = {{2.0f * kTeeth, -1, 0}};
  for (int i = kTeeth; i-- > 0;) {
    const float x = 2.0f * static_cast<float>(i);
    for (const Vec3 p : {Vec3(x + 2, 0, 0), Vec3(x + 1, 0, 0), Vec3(x + 1, 1, 0), Vec3(x, 1, 0)}) comb.push_back(p);
  }
  comb.push_back({0, -1, 0});
  bool allAlongZ = false;
  EXPECT_NEAR(areaOf(comb, &allAlongZ), 2 * kTeeth + kTeeth, 0.1f);
  EXPECT_TRUE(allAlongZ);
}

// A file of many such combs would take minutes: their budget is one for all.
TEST(Polygon, whatTheBudgetDoesNotCoverIsAFan) {
  std::vector<Vec3> comb = {{40, -1, 0}};
  for (int i = 20; i-- > 0;) {
    const float x = 2.0f * static_cast<float>(i);
    for (const Vec3 p : {Vec3(x + 2, 0, 0), Vec3(x + 1, 0, 0), Vec3(x + 1, 1, 0), Vec3(x, 1, 0)}) comb.push_back(p);
  }
  comb.push_back({0, -1, 0});
  EarBudget budget{.testsLeft = 20'000};
  for (size_t i = 0; i < 50; ++i) EXPECT_EQ(triangulate(comb, budget).size(), comb.size() - 2);
  EXPECT_EQ(budget.testsLeft, 0u);
  EXPECT_GT(budget.fans, 0u);
  EXPECT_LT(budget.fans, 50u);
}

TEST(Polygon, degenerateAndHugePolygonsStillGiveAllTriangles) {
  EXPECT_EQ(triangulate(std::vector<Vec3>(5)).size(), 3u);
  EXPECT_EQ(triangulate(std::vector<Vec3>(100'000)).size(), 99'998u);
  EXPECT_TRUE(triangulate(std::vector<Vec3>(2)).empty());
}

}  // namespace
}  // namespace roomlight::importers
