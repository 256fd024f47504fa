// Pixels on the edges of what is much brighter.
#include "look/edges.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "look/display.h"

namespace roomlight {
namespace {

constexpr int kWidth = 64, kHeight = 48;
constexpr float kWall = 0.1f, kSky = 40;

const float kEv100 = std::log2(1 / 1.2f);  // light of 1 is white

Display plain() {
  Display display;
  display.tone = ToneCurve::Clip, display.automaticWhite = false;
  return display;
}

// How much of a pixel lies right of a line that leans by `slope` pixels a row.
float coverage(int x, int y, float slope) {
  constexpr int kRows = 64;
  float sum = 0;
  for (int k = 0; k < kRows; ++k) {
    const float at = 20.3f + slope * (static_cast<float>(y) + (static_cast<float>(k) + 0.5f) / kRows);
    sum += std::clamp(static_cast<float>(x + 1) - at, 0.0f, 1.0f) / kRows;
  }
  return sum;
}

Image window(float slope, Vec3 wall = Vec3(kWall), Vec3 sky = Vec3(kSky)) {
  Image image(kWidth, kHeight);
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) image.at(x, y) = lerp(wall, sky, coverage(x, y, slope));
  }
  return image;
}

// Largest difference of shown light from the mean of what both sides show.
float worst(const Image& shown, float slope, float wall, float sky) {
  float most = 0;
  for (int y = 1; y + 1 < kHeight; ++y) {
    for (int x = 1; x + 1 < kWidth; ++x)
      most = std::max(most, std::abs(srgbDecode(shown.at(x, y).y) - lerp(wall, sky, coverage(x, y, slope))));
  }
  return most;
}

TEST(Edges, ofAWindowAreShownByWhatItCovers) {
  for (const float slope : {0.0f, 0.07f, -0.2f, 0.45f, 1.0f}) {
    const Image light = window(slope);
    EXPECT_LT(worst(displayed(light, plain(), {}, kEv100), slope, kWall, 1), 0.13f) << slope;
    EXPECT_GT(worst(toneMap(light, kEv100, ToneCurve::Clip), slope, kWall, 1), 0.25f) << slope;
  }
}

TEST(Edges, changeWithTheirContrastWithoutAStep) {
  std::optional<float> before;
  for (float sky = 1; sky < 6; sky += 0.05f) {
    const Image shown = displayed(window(0.2f, Vec3(1), Vec3(sky)), plain(), {}, kEv100 + 1);
    const float now = srgbDecode(shown.at(24, 20).y);
    EXPECT_NEAR(now, before.value_or(now), 0.03f) << sky;
    before = now;
  }
}

TEST(Edges, ofLittleContrastAreLeftAlone) {
  const Image light = window(0.3f, Vec3(0.5f), Vec3(0.95f));
  EXPECT_TRUE(std::ranges::all_of(edgePixels(light), [](const EdgePixel& e) { return e.weight == 0; }));
  EXPECT_TRUE(edgePixels(window(0, Vec3(kWall), Vec3(kWall))).empty());
}

TEST(Edges, whatShinesAloneStays) {
  Image light = window(0, Vec3(kWall), Vec3(kWall));
  light.at(30, 20) = Vec3(kSky);
  const Image shown = displayed(light, plain(), {}, kEv100);
  EXPECT_GT(shown.at(30, 20).y, 0.99f);
  EXPECT_NEAR(srgbDecode(shown.at(31, 20).y), kWall, 0.01f);
}

// A red leaf a pixel wide before a wall, beside a window.
TEST(Edges, thingsKeepTheirColourBesideAWindow) {
  Image light = window(0);
  for (int y = 0; y < kHeight; ++y) light.at(19, y) = Vec3{0.6f, 0.05f, 0.05f};
  const Vec3 shown = displayed(light, plain(), {}, kEv100).at(19, 20);
  EXPECT_GT(srgbDecode(shown.x), 0.3f);
  EXPECT_LT(srgbDecode(shown.y), 0.1f);
}

TEST(Edges, andLocalExposureGoTogether) {
  Display display = plain();
  display.localExposure = 0.5f;
  const Image light = window(0.1f), shown = displayed(light, display, {}, kEv100);
  for (int y = 10; y < 40; ++y) {
    for (int x = 10; x < 40; ++x) {
      const float share = coverage(x, y, 0.1f);
      if (share <= 0 || share >= 1) continue;
      const float dark = srgbDecode(shown.at(x - 2, y).y), bright = srgbDecode(shown.at(x + 2, y).y);
      EXPECT_NEAR(srgbDecode(shown.at(x, y).y), lerp(dark, bright, share), 0.15f) << x << " " << y;
    }
  }
}

}  // namespace
}  // namespace roomlight
