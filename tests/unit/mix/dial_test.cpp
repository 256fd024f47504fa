#include "mix/layer_info.h"

#include <gtest/gtest.h>

#include "photometry/colour_temperature.h"
#include "unit/mix/layers.h"

namespace roomlight {
namespace {

TEST(Dial, readsLevelsTemperaturesAndColours) {
  EXPECT_FLOAT_EQ(parseDial("60%").value().level.value(), 0.6f);
  EXPECT_FLOAT_EQ(parseDial("62.5 %").value().level.value(), 0.625f);
  EXPECT_FLOAT_EQ(parseDial("off").value().level.value(), 0);
  EXPECT_FLOAT_EQ(parseDial("on").value().level.value(), 1);
  EXPECT_FALSE(parseDial("2700K").value().level.has_value());
  const Dial both = parseDial("40%, 2700 K").value();
  EXPECT_FLOAT_EQ(both.level.value(), 0.4f);
  EXPECT_EQ(both.tint.value(), blackBodyColour(2700));
  const Vec3 hex = parseDial("#ffffff").value().tint.value();
  EXPECT_NEAR(luminance(hex), 1, 1e-6f);
  EXPECT_NEAR(hex.x, hex.z, 1e-6f);
}

TEST(Dial, badDialsAreOneClearLine) {
  for (const char* text : {"", "60", "bright", "-1%", "1001%", "nan%", "900K", "50000K", "#12345", "#12345g", "#000000",
                           "60%,", ",60%", "60%;2700K"}) {
    const Result<Dial> dial = parseDial(text);
    ASSERT_FALSE(dial.ok()) << text;
    EXPECT_EQ(dial.error().find('\n'), std::string::npos);
    EXPECT_GT(dial.error().size(), 10u);
  }
}

TEST(Dial, dimmingIsLinearAndANewColourKeepsTheFlux) {
  LayerInfo lamp;
  lamp.name = "Lamp";
  lamp.colour = blackBodyColour(2700);
  EXPECT_EQ(gainOf(lamp, {0.25f, {}}).value(), Vec3(0.25f));
  const Vec3 cold = gainOf(lamp, {0.5f, blackBodyColour(6500)}).value();
  const Vec3 light = lamp.colour * cold;  // what a white card under the lamp shows
  EXPECT_NEAR(luminance(light), 0.5f, 1e-5f);
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(light[c], 0.5f * blackBodyColour(6500)[c], 1e-5f);
  const Vec3 same = gainOf(lamp, {1.0f, blackBodyColour(2700)}).value();
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(same[c], 1, 1e-5f);
}

TEST(Dial, lightThatWasNotRenderedCannotBeMixed) {
  LayerInfo red;
  red.name = "Red LED";
  red.colour = Vec3(1, 0, 0) / luminance({1, 0, 0});
  const Result<Vec3> gain = gainOf(red, {1.0f, Vec3(1)});
  ASSERT_FALSE(gain.ok());
  EXPECT_NE(gain.error().find("'Red LED' was rendered with light that has next to no green"), std::string::npos);
  EXPECT_TRUE(gainOf(red, {0.0f, Vec3(1)}).ok()) << "off is off in any colour";
  EXPECT_TRUE(gainOf(red, {0.5f, red.colour}).ok());
}

}  // namespace
}  // namespace roomlight
