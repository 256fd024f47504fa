#include "measure/false_colour.h"

#include <gtest/gtest.h>

#include "base/tone.h"

namespace roomlight {
namespace {

Image ramp() {
  Image image(100, 60);
  for (int y = 0; y < 60; ++y) {
    for (int x = 0; x < 100; ++x) image.at(x, y) = Vec3{2, 1, 0.5f} * static_cast<float>(x + 1);
  }
  return image;
}

TEST(LuminancePicture, losesOnlyTheColour) {
  const Image image = ramp(), grey = luminanceOnly(image);
  EXPECT_FLOAT_EQ(grey.at(40, 3).x, luminance(image.at(40, 3)));
  EXPECT_FLOAT_EQ(grey.at(40, 3).z, grey.at(40, 3).x);
}

TEST(LuminancePicture, greyIsInProportion) {
  const Image grey = greyPicture(ramp(), 200);
  EXPECT_NEAR(srgbDecode(grey.at(40, 3).y), luminance(ramp().at(40, 3)) / 200, 1e-4);
}

TEST(LuminancePicture, falseColoursHaveALegend) {
  const Image image = ramp();
  const LightScale scale{1, 100};
  const Image picture = falseColourPicture(image, scale);
  EXPECT_GT(picture.width, image.width);
  EXPECT_EQ(picture.height, image.height);
  EXPECT_TRUE(picture.at(40, 3) == falseColour(scale.position(static_cast<double>(luminance(image.at(40, 3))))));
  int dark = 0;
  for (int y = 0; y < picture.height; ++y) {
    for (int x = image.width + 25; x < picture.width; ++x) dark += picture.at(x, y).x < 0.2f ? 1 : 0;
  }
  EXPECT_GT(dark, 30);  // numbers
}

}  // namespace
}  // namespace roomlight
