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

// Two slats, 5 mm apart: none of the places of one comes to lie on the other.
TEST(ChartBorder, placesDoNotCrossASlot) {
  std::vector<std::array<Vec2, 3>> slats;
  for (const float y : {0.0f, 0.035f}) {
    const Vec2 a{0, y}, b{1, y}, c{1, y + 0.03f}, d{0, y + 0.03f};
    slats.push_back({a, b, c}), slats.push_back({a, c, d});
  }
  expectAt(ChartBorder(slats).inset({0.5f, 0.03f}, 0.01f), {0.5f, 0.02f});
}

TEST(ChartBorder, atAReflexCornerPlacesKeepToTheirOwnEdge) {
  const Vec2 corners[] = {{0, 0}, {1, 0}, {1, 0.1f}, {0.1f, 0.1f}, {0.1f, 1}, {0, 1}};
  const ChartBorder border(std::vector<std::array<Vec2, 3>>{{corners[0], corners[1], corners[2]},
                                                            {corners[0], corners[2], corners[3]},
                                                            {corners[0], corners[3], corners[4]},
                                                            {corners[0], corners[4], corners[5]}});
  expectAt(border.inset({0.1f, 0.103f}, 0.01f), {0.09f, 0.103f});
}

// A frame of 5 cm around 1 m x 1 m.
TEST(ChartBorder, aFrameIsAsWideAsItsSides) {
  std::vector<std::array<Vec2, 3>> frame;
  const auto add = [&](Vec2 a, Vec2 b, Vec2 c, Vec2 d) { frame.push_back({a, b, c}), frame.push_back({a, c, d}); };
  const Vec2 out[] = {{0, 0}, {1.1f, 0}, {1.1f, 1.1f}, {0, 1.1f}},
             in[] = {{0.05f, 0.05f}, {1.05f, 0.05f}, {1.05f, 1.05f}, {0.05f, 1.05f}};
  for (size_t k = 0; k < 4; ++k) add(out[k], out[(k + 1) % 4], in[(k + 1) % 4], in[k]);
  EXPECT_NEAR(ChartBorder(frame).widthM(), 0.05f, 1e-4f);
}

TEST(ChartBorder, noBorderMovesNothing) {
  EXPECT_TRUE(ChartBorder().empty());
  expectAt(ChartBorder().inset({3, 4}, 0.01f), {3, 4});
}

}  // namespace
}  // namespace roomlight::bake
