#include "photometry/sky_image.h"

#include <gtest/gtest.h>

#include <numbers>

#include "photometry/white_balance.h"

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
  const Image grey = skyImage(sky, 10000, Vec3(1), Vec3(500)), coloured = skyImage(sky, 10000, clearSky(), Vec3(500));
  for (size_t i = 0; i < grey.pixels.size(); ++i) ASSERT_NEAR(luminance(coloured.pixels[i]) / luminance(grey.pixels[i]), 1, 1e-3f) << i;
}

TEST(SkyImage, clearSkiesAreBluestWhereTheyAreDarkest) {
  const Image image = skyImage(sky, 10000, clearSky(), Vec3(500));
  const double zenithK = nearestWhiteK(image.at(0, 2)), horizonK = nearestWhiteK(image.at(0, 126));
  EXPECT_GT(zenithK, 1.2 * horizonK);
  const double decades = std::log10(static_cast<double>(luminance(image.at(0, 126)) / luminance(image.at(0, 2))));
  EXPECT_NEAR(1e6 / horizonK - 1e6 / zenithK, kClearSkyMiredPerDecade * decades, 1.5);
}

TEST(SkyImage, groundFadesIntoHaze) {
  SkyColour colour;
  colour.hazeRad = kHazeRad;
  const Image image = skyImage(sky, 10000, colour, Vec3(100));
  const float horizon = image.at(7, 127).y;
  EXPECT_GT(image.at(7, 128).y, 0.7f * horizon);
  for (int y = 129; y < 256; ++y) EXPECT_LE(image.at(7, y).y, image.at(7, y - 1).y);
  EXPECT_NEAR(image.at(7, 200).y, 100, 0.1);
  EXPECT_EQ(skyImage(sky, 10000, Vec3(1), Vec3(100)).at(7, 128).y, 100);
}

}  // namespace
}  // namespace roomlight
