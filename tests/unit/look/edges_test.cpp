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
    EXPECT_LT(worst(displayed(light, plain(), {}, kEv100), slope, kWall, 1), 0.2f) << slope;
    EXPECT_GT(worst(toneMap(light, kEv100, ToneCurve::Clip), slope, kWall, 1), 0.25f) << slope;
  }
}

// At a contrast of 2 the sky is brighter than white already.
TEST(Edges, changeWithTheirContrastWithoutAStep) {
  std::optional<float> before;
  for (float sky = 1; sky < 6; sky += 0.05f) {
    const Image shown = displayed(window(0.2f, Vec3(1), Vec3(sky)), plain(), {}, kEv100 + 0.3f);
    const float now = srgbDecode(shown.at(24, 20).y);
    EXPECT_NEAR(now, before.value_or(now), 0.03f) << sky;
    before = now;
  }
}

TEST(Edges, ofLittleContrastAreLeftAlone) {
  const Image light = window(0.3f, Vec3(0.5f), Vec3(0.95f));
  EXPECT_TRUE(edgePixels(light).empty());
  EXPECT_TRUE(edgePixels(window(0, Vec3(kWall), Vec3(kWall))).empty());
}

TEST(Edges, whatShinesAloneStays) {
  Image light = window(0, Vec3(kWall), Vec3(kWall));
  light.at(30, 20) = Vec3(kSky);
  const Image shown = displayed(light, plain(), {}, kEv100);
  EXPECT_GT(shown.at(30, 20).y, 0.99f);
  EXPECT_NEAR(srgbDecode(shown.at(31, 20).y), kWall, 0.01f);
}

// Of a column of one light between a wall and a sky.
Vec3 shownColumn(Vec3 column, Vec3 sky, const Display& display) {
  Image light = window(0, Vec3(kWall), sky);
  for (int y = 0; y < kHeight; ++y) light.at(20, y) = column, light.at(21, y) = sky;
  const Vec3 shown = displayed(light, display, {}, kEv100).at(20, 20);
  return {srgbDecode(shown.x), srgbDecode(shown.y), srgbDecode(shown.z)};
}

// Half of it a wall, half a sky whose colour differs from that beside by 5 %, or the leaves of a tree before it.
TEST(Edges, takeNoColourFromASkyThatIsUneven) {
  const Vec3 sky(kSky);
  for (const Vec3 beyond : {Vec3{1.05f, 1, 1} * kSky, Vec3{1, 1, 0.95f} * kSky, Vec3{12, 20, 7}}) {
    const Vec3 shown = shownColumn(lerp(Vec3(kWall), beyond, 0.5f), sky, plain());
    EXPECT_LT(maxComponent(shown) - minComponent(shown), 0.12f) << beyond.x << " " << beyond.z;
  }
}

TEST(Edges, thingsKeepTheirColourBesideAWindow) {
  const Vec3 leaf = shownColumn({0.6f, 0.05f, 0.05f}, Vec3(kSky), plain());
  EXPECT_GT(leaf.x, 0.3f);
  EXPECT_LT(leaf.y, 0.1f);
}

// The lit underside of a lintel, a pixel wide: brighter than white, and greener than any mixture of wall and sky.
TEST(Edges, aThirdThingIsShownAsItIs) {
  const Vec3 lintel{3, 3.2f, 1}, sky{8, 9, 10}, shown = shownColumn(lintel, sky, plain());
  EXPECT_GT(minComponent(shown), 0.95f);
}

// What has a five-hundredth of the sky is no mixture that a few rays could have found.
TEST(Edges, thingsFarDarkerThanTheSkyKeepTheirBrightness) {
  EXPECT_NEAR(shownColumn(Vec3(0.5f), Vec3(250), plain()).y, 0.5f, 0.02f);
}

TEST(Edges, glareIsAddedToBothSides) {
  Display display = plain();
  display.glare = 0.1f;
  for (const float wall : {0.0f, 1e-30f, 0.001f}) {
    const Image shown = displayed(window(0.3f, Vec3(wall), Vec3(20)), display, {}, kEv100);
    for (int y = 10; y < 40; ++y) {
      for (int x = 12; x < 40; ++x)
        EXPECT_GE(srgbDecode(shown.at(x, y).y), srgbDecode(shown.at(x - 1, y).y) - 0.1f) << wall << " " << x;
    }
  }
}

TEST(Edges, whatIsNotFiniteIsLeftAlone) {
  for (const float bad : {INFINITY, NAN}) {
    Image light = window(0, Vec3(0.1f), Vec3(0.1f));
    light.at(29, 20) = Vec3(0.5f), light.at(30, 20) = Vec3(bad);
    EXPECT_NEAR(srgbDecode(displayed(light, plain(), {}, kEv100).at(29, 20).y), 0.5f, 0.01f);
  }
}

TEST(Edges, ofThePictureItselfAreNone) {
  Image light(9, 1);
  for (int x = 0; x < 9; ++x) light.at(x, 0) = Vec3(x < 4 ? kWall : kSky);
  light.at(0, 0) = Vec3(5), light.at(8, 0) = Vec3(5);
  EXPECT_TRUE(edgePixels(light).empty());
  EXPECT_TRUE(edgePixels(Image(0, 3)).empty());
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
