#include "look/pyramid.h"

#include <gtest/gtest.h>

namespace roomlight {
namespace {

TEST(Pyramid, evenPlanesStayEven) {
  Plane plane(37, 22);
  for (float& v : plane.values) v = 0.7f;
  const std::vector<Plane> levels = gaussianPyramid(plane, 4);
  EXPECT_LE(std::min(levels.back().width, levels.back().height), 4);
  for (const Plane& level : levels) {
    for (const float v : level.values) EXPECT_NEAR(v, 0.7f, 1e-5f);
  }
  for (const float v : doubled(levels[1], 37, 22).values) EXPECT_NEAR(v, 0.7f, 1e-5f);
}

TEST(Pyramid, slopesComeBackAsTheyWere) {
  Plane slope(64, 40);
  for (int y = 0; y < 40; ++y) {
    for (int x = 0; x < 64; ++x) slope.at(x, y) = static_cast<float>(x);
  }
  const Plane back = doubled(halved(slope), 64, 40);
  for (int x = 8; x < 56; ++x) EXPECT_NEAR(back.at(x, 20), static_cast<float>(x), 1e-3f) << x;
}

}  // namespace
}  // namespace roomlight
