// The white of a mix: that of the light which its layers give surfaces.
#include "still/layered_home.h"

#include <gtest/gtest.h>

namespace roomlight {
namespace {

// Two lamps of one colour. What one gives surfaces comes by way of others and is warmer.
MixHome twoLamps(bool firstTells, bool secondTells) {
  LayeredImage picture{Image(2, 1), {{"lamp_01", Image(2, 1)}, {"lamp_02", Image(2, 1)}}, {}};
  for (PictureLayer& l : picture.layers) l.image.pixels.assign(2, Vec3(10));
  const auto json = [](const char* channel, const char* name, const char* light) {
    return std::string(R"({"channel": ")") + channel + R"(", "name": ")" + name +
           R"(", "kind": "lamp", "colour": [1, 1, 1])" + light + "}";
  };
  picture.metadata[std::string(kLayersKey)] =
      R"({"version": 1, "layers": [)" +
      json("lamp_01", "Near", firstTells ? R"(, "lightColour": [0.5, 0.5, 0.5])" : "") + ", " +
      json("lamp_02", "Far", secondTells ? R"(, "lightColour": [0.9, 0.4, 0.2])" : "") + "]}";
  Result<MixHome> home = layersOf(std::move(picture), "a.exr");
  EXPECT_TRUE(home) << home.error();
  return std::move(home).value();
}

White whiteOfMix(const MixHome& home, const std::vector<std::string>& lamps, bool follows) {
  const Result<Mixture> mixture = mixtureOf(home.layers, {lamps, {}, {}, {}});
  EXPECT_TRUE(mixture) << mixture.error();
  return showMix(home, mixture.value(), {}, {false, follows}).white;
}

void expectGains(const White& white, Vec3 lightColour) {
  const Vec3 expected = whiteOf({}, lightColour).gains;
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(white.gains[c], expected[c], 1e-4f) << "channel " << c;
}

TEST(WhiteOfAMix, isThatOfTheLightItsLayersGiveSurfaces) {
  const MixHome home = twoLamps(true, true);
  expectGains(whiteOfMix(home, {"Near=off"}, true), {0.9f, 0.4f, 0.2f});
  expectGains(whiteOfMix(home, {"Far=off"}, true), Vec3(1));
  expectGains(whiteOfMix(home, {"Far=50%"}, true), {0.95f, 0.7f, 0.6f});
  expectGains(whiteOfMix(home, {"Near=off", "Far=#ff0000"}, true), Vec3{0.9f, 0, 0});
}

TEST(WhiteOfAMix, isThatOfTheUnmixedPictureUnlessWished) {
  const MixHome home = twoLamps(true, true);
  expectGains(whiteOfMix(home, {"Near=off"}, false), {1.4f, 0.9f, 0.7f});
}

TEST(WhiteOfAMix, followsTheLampsOwnColourWhereTheFileDoesNotTell) {
  for (const bool first : {false, true}) expectGains(whiteOfMix(twoLamps(first, false), {"Near=off"}, true), Vec3(1));
}

}  // namespace
}  // namespace roomlight
