#include "bake/chart_border.h"

#include <gtest/gtest.h>

#include <array>
#include <vector>

namespace roomlight::bake {
namespace {

// A rectangle of two triangles, 2 m x 0.1 m.
ChartBorder strip() {
  const Vec2 a{0, 0}, b{2, 0}, c{2, 0.1f}, d{0, 0.1f};
  return ChartBorder(std::vector<std::array<Vec2, 3>>{{a, b, c}, {a, c, d}});
}

void expectAt(Vec2 found, Vec2 expected) {
  EXPECT_NEAR(found.x, expected.x, 2e-4f);
  EXPECT_NEAR(found.y, expected.y, 2e-4f);
}

TEST(ChartBorder, placesMoveAcrossTheEdge) {
  expectAt(strip().inset({0.7f, 0}, 0.01f), {0.7f, 0.01f});
  expectAt(strip().inset({0.7f, 0.098f}, 0.01f), {0.7f, 0.09f});
}

TEST(ChartBorder, placesInCornersMoveOffBothEdges) {
  expectAt(strip().inset({0, 0}, 0.01f), {0.01f, 0.01f});
  expectAt(strip().inset({2, 0.1f}, 0.01f), {1.99f, 0.09f});
}

// Nor does the edge that both triangles share.
TEST(ChartBorder, whatIsFarFromTheBorderStays) { expectAt(strip().inset({1, 0.05f}, 0.01f), {1, 0.05f}); }

TEST(ChartBorder, noBorderMovesNothing) {
  EXPECT_TRUE(ChartBorder().empty());
  expectAt(ChartBorder().inset({3, 4}, 0.01f), {3, 4});
}

}  // namespace
}  // namespace roomlight::bake
