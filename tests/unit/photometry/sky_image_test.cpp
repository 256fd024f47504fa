#include "photometry/sky_image.h"

#include <gtest/gtest.h>

#include <numbers>

#include "photometry/colour_temperature.h"

namespace roomlight {
namespace {

// Brighter towards the horizon.
double sky(Vec3 d) { return 3 - 2 * static_cast<double>(d.y); }

SkyColour clearSky() {
  SkyColour colour(whiteColour(9000));
  colour.miredPerDecade = kClearSkyMiredPerDecade;
  return colour;
}

TEST(SkyImage, coloursChangeNoLuminance) {
  const Image grey = skyImage(sky, 10000, Vec3(1)), coloured = skyImage(sky, 10000, clearSky());
  for (size_t i = 0; i < grey.pixels.size() / 2; ++i)
    ASSERT_NEAR(luminance(coloured.pixels[i]) / luminance(grey.pixels[i]), 1, 1e-3f) << i;
}

TEST(SkyImage, clearSkiesAreBluestWhereTheyAreDarkest) {
  const Image image = skyImage(sky, 10000, clearSky());
  const double zenithK = nearestWhiteK(image.at(0, 2)), horizonK = nearestWhiteK(image.at(0, 126));
  EXPECT_GT(zenithK, 1.2 * horizonK);
  const double decades = std::log10(static_cast<double>(luminance(image.at(0, 126)) / luminance(image.at(0, 2))));
  EXPECT_NEAR(1e6 / horizonK - 1e6 / zenithK, kClearSkyMiredPerDecade * decades, 1.5);
}

TEST(SkyImage, groundIsAsBrightAsALevelSurfaceOfItsReflectance) {
  Image image = skyImage(sky, 10000, clearSky());
  const Vec3 lux = horizontalLux(image);
  EXPECT_NEAR(luminance(lux), 10000, 20);
  paintGround(image, Vec3(0.2f, 0.3f, 0.1f), Vec3(5000, 4000, 3000), 0);
  const Vec3 expected = (lux + Vec3(5000, 4000, 3000)) * Vec3(0.2f, 0.3f, 0.1f) / kPi;
  for (const int y : {128, 200, 255}) {
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(image.at(7, y)[c], expected[c], 1e-4f * expected[c]);
  }
}

TEST(SkyImage, groundFadesIntoHaze) {
  Image image = skyImage(sky, 10000, {});
  paintGround(image, Vec3(0.03f), Vec3(0), kHazeRad);
  const float horizon = image.at(7, 127).y, ground = 0.03f * 10000 / kPi;
  EXPECT_GT(image.at(7, 128).y, 0.5f * horizon);
  for (int y = 129; y < 256; ++y) EXPECT_LE(image.at(7, y).y, image.at(7, y - 1).y);
  EXPECT_NEAR(image.at(7, 200).y, ground, 0.01f * ground);
}

}  // namespace
}  // namespace roomlight
