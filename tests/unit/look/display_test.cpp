// White balance, glare and noise of what is shown, and looks.
#include "look/display.h"

#include <gtest/gtest.h>

#include "photometry/colour_temperature.h"

namespace roomlight {
namespace {

Image even(Vec3 value, int width = 64, int height = 48) {
  Image image(width, height);
  std::fill(image.pixels.begin(), image.pixels.end(), value);
  return image;
}

double sumOf(const Image& image) {
  double sum = 0;
  for (const Vec3& p : image.pixels) sum += static_cast<double>(p.x + p.y + p.z);
  return sum;
}

TEST(White, surfacesHaveTheirOwnColoursWhereNoWarmthIsKept) {
  Display display;
  display.warmth = 0;
  const Vec3 oak{0.5f, 0.3f, 0.15f};
  for (const double kelvin : {2200.0, 2700.0, 4000.0, 6504.0, 9000.0}) {
    const Vec3 light = whiteColour(kelvin), shown = oak * light * whiteOf(display, light).gains;
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(shown[c] / oak[c], 1, 0.01f) << kelvin;
  }
}

TEST(White, isTheSameByTheTableOfWhites) {
  const Display display;
  for (const ShownWhite& white : shownWhites(display)) {
    const Vec3 shown = max(white.light, Vec3(0.02f)) * whiteOf(display, white.light).gains;
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(shown[c], white.shown[c], 0.01f);
  }
  Display fixed;
  fixed.whiteK = 4000;
  EXPECT_TRUE(shownWhites(fixed).empty());
}

// Light that walls of wood have made redder and greener is white too.
TEST(White, isTheLightAsItIsNotItsTemperatureAlone) {
  Display display;
  display.warmth = 0;
  const Vec3 light = whiteColour(2700) * Vec3{1.05f, 0.98f, 0.85f}, shown = light * whiteOf(display, light).gains;
  EXPECT_NEAR(shown.x / shown.y, 1, 0.01f);
  EXPECT_NEAR(shown.z / shown.y, 1, 0.01f);
}

TEST(White, keepsATraceOfWarmthByDefault) {
  for (const double kelvin : {2200.0, 2700.0, 4000.0, 6504.0}) {
    const Vec3 light = whiteColour(kelvin), shown = light * whiteOf(Display(), light).gains;
    EXPECT_GT(shown.x, shown.y) << kelvin;
    EXPECT_GT(shown.y, shown.z) << kelvin;
    EXPECT_LT(shown.x / shown.z, 1.45f) << kelvin;
  }
}

TEST(White, duskStaysBlueUnlessAskedOtherwise) {
  const Vec3 light = whiteColour(14000), shown = light * whiteOf(Display(), light).gains;
  EXPECT_GT(shown.z, 1.1f * shown.x);
  Display neutral;
  neutral.warmth = 0;
  const Vec3 grey = light * whiteOf(neutral, light).gains;
  EXPECT_NEAR(grey.z / grey.x, 1, 0.01f);
}

TEST(White, colouredLightStaysColoured) {
  const Vec3 light{3, 0.4f, 0.9f}, shown = light / luminance(light) * whiteOf(Display(), light).gains;
  EXPECT_LT(shown.y, 0.7f * shown.x);
}

TEST(White, isTheWishedOneOrNone) {
  Display display;
  display.whiteK = 3000;
  const Vec3 shown = whiteColour(3000) * whiteOf(display, {1, 1, 1}).gains;
  EXPECT_NEAR(shown.x / shown.z, 1, 1e-3f);
  display.whiteK.reset(), display.automaticWhite = false;
  EXPECT_TRUE(whiteOf(display, whiteColour(2700)).gains == Vec3(1));
  EXPECT_TRUE(whiteOf(Display(), {}).gains == Vec3(1));
}

TEST(Displayed, noiseIsBelowTheLastStepAndHasNoMean) {
  Display display;
  display.tone = ToneCurve::Clip;
  const Image shown = displayed(even(Vec3(0.2f)), display, {}, std::log2(1 / 1.2f));
  const float value = srgbEncode(0.2f);
  for (const Vec3& p : shown.pixels) EXPECT_NEAR(p.x, value, 0.51f / 255);
  EXPECT_NEAR(sumOf(shown) / 3 / static_cast<double>(shown.pixels.size()), value, 0.05 / 255);
}

TEST(Glare, keepsTheLightAndSpreadsIt) {
  Image lamp = even(Vec3(1), 128, 128);
  lamp.at(64, 64) = Vec3(1000);
  const double before = sumOf(lamp);
  addGlare(lamp, 0.1f);
  EXPECT_NEAR(sumOf(lamp) / before, 1, 0.05);
  EXPECT_NEAR(lamp.at(64, 64).y, 900, 20);
  EXPECT_GT(lamp.at(70, 64).y, lamp.at(90, 64).y);
  EXPECT_GT(lamp.at(90, 64).y, 1);
}

TEST(Look, everyNameHasOne) {
  for (const auto& [name, what] : lookNames()) {
    EXPECT_TRUE(displayOfLook(name)) << name;
    EXPECT_FALSE(what.empty());
  }
  EXPECT_NE(displayOfLook("moody").error().find("natural, bright, evening, technical"), std::string::npos);
}

TEST(Look, theTechnicalOneAddsNothing) {
  const Display d = displayOfLook("technical").value();
  EXPECT_TRUE(d.tone.plain());
  EXPECT_EQ(d.localExposure + d.glare + d.vignette + d.brighterEv, 0);
}

}  // namespace
}  // namespace roomlight
