#include "measure/drawings.h"

#include <gtest/gtest.h>

#include <cmath>

#include "measure/false_colour.h"

namespace roomlight {
namespace {

double area(const std::vector<ContourPoint>& loop) {
  double twice = 0;
  for (size_t i = 0; i < loop.size(); ++i) {
    const Vec2 a = loop[i].p, b = loop[(i + 1) % loop.size()].p;
    twice += static_cast<double>(a.x) * static_cast<double>(b.y) - static_cast<double>(b.x) * static_cast<double>(a.y);
  }
  return twice / 2;
}

std::vector<float> cone(int n) {
  std::vector<float> values;
  for (int y = 0; y < n; ++y) {
    for (int x = 0; x < n; ++x)
      values.push_back(static_cast<float>(n) - std::hypot(static_cast<float>(x) + 0.5f - static_cast<float>(n) / 2,
                                                          static_cast<float>(y) + 0.5f - static_cast<float>(n) / 2));
  }
  return values;
}

TEST(Contour, ofAConeIsACircle) {
  const auto loops = contours(cone(64), 64, 64, 44);
  ASSERT_EQ(loops.size(), 1u);
  EXPECT_NEAR(std::abs(area(loops[0])), 3.14159265 * 400, 5);
  for (const ContourPoint& p : loops[0]) {
    EXPECT_FALSE(p.rim);
    EXPECT_NEAR(std::hypot(p.p.x - 32, p.p.y - 32), 20, 0.05);
  }
}

TEST(Contour, closesAtTheRim) {
  const auto loops = contours(std::vector<float>(12, 5), 4, 3, 1);
  ASSERT_EQ(loops.size(), 1u);
  for (const ContourPoint& p : loops[0]) EXPECT_TRUE(p.rim);
  EXPECT_TRUE(contours(std::vector<float>(12, 5), 4, 3, 6).empty());
}

TEST(Contour, ringsHaveTwoLinesOfOppositeSense) {
  std::vector<float> values = cone(64);
  for (float& v : values) v = -std::abs(v - 44);  // highest on a circle of radius 20
  const auto loops = contours(values, 64, 64, -5);
  ASSERT_EQ(loops.size(), 2u);
  EXPECT_NEAR(std::abs(area(loops[0]) + area(loops[1])), 3.14159265 * (625 - 225), 10);
}

TEST(Contour, saddlesCloseToo) {
  for (const float middle : {0.0f, 10.0f}) {
    const std::vector<float> values = {9, middle, 1, middle, 1, middle, 1, middle, 9, 1, 9, 1, 9, 1, 9, 1};
    for (const auto& loop : contours(values, 4, 4, 5)) EXPECT_GE(loop.size(), 4u);
  }
}

TEST(Contour, gapsAreFilledFromTheirNeighbours) {
  const float gap = std::nanf("");
  const std::vector<float> filled = withoutGaps(std::vector<float>{4, 4, 4, 4, gap, 4, gap, gap, 4}, 3, 3);
  for (const float v : filled) EXPECT_EQ(v, 4);
}

TEST(FalseColour, growsEvenlyInLightness) {
  double before = -1;
  for (int i = 0; i <= 100; ++i) {
    const Vec3 c = falseColour(i / 100.0);
    EXPECT_GE(minComponent(c), 0);
    EXPECT_LE(maxComponent(c), 1);
    const auto linear = [](float v) { return v <= 0.04045f ? v / 12.92f : std::pow((v + 0.055f) / 1.055f, 2.4f); };
    // CIE 1976 lightness of the colour: it must rise by much the same at every step.
    const double y = static_cast<double>(luminance({linear(c.x), linear(c.y), linear(c.z)})),
                 lightness = y > 0.008856 ? 116 * std::cbrt(y) - 16 : 903.3 * y;
    if (before >= 0) {
      EXPECT_GT(lightness - before, 0.4) << i;
      EXPECT_LT(lightness - before, 1.4) << i;
    }
    before = lightness;
  }
}

TEST(FalseColour, scalesEndAtRoundNumbers) {
  std::vector<float> values;
  for (int i = 0; i <= 1000; ++i) values.push_back(12 + 0.7f * static_cast<float>(i));
  const LightScale scale = scaleOf(values);
  EXPECT_DOUBLE_EQ(scale.low, 30);
  EXPECT_DOUBLE_EQ(scale.high, 750);
  EXPECT_DOUBLE_EQ(scale.position(30), 0);
  EXPECT_DOUBLE_EQ(scale.position(750), 1);
  EXPECT_EQ(roundSteps(30, 200), (std::vector<double>{30, 50, 75, 100, 150, 200}));
  EXPECT_GE(scaleOf(std::vector<float>(10, 100)).high / scaleOf(std::vector<float>(10, 100)).low, 3);
  EXPECT_EQ(scaleOf({}).high, 1000);
}

}  // namespace
}  // namespace roomlight
