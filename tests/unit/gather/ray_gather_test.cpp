// Counts of rays follow the size of the picture.
#include "gather/ray_gather.h"

#include <gtest/gtest.h>

namespace roomlight {
namespace {

RayGatherSettings ofSize(int width, int height) {
  RayGatherSettings s;
  s.width = width, s.height = height;
  return s;
}

TEST(RayGather, largerPicturesTakeFewerRaysAPixel) {
  const RayGatherSettings given;
  ASSERT_GT(given.samples, given.firstSamples);
  const RayGatherSettings small = withCounts(ofSize(320, 180)), same = withCounts(ofSize(480, 270));
  for (const RayGatherSettings& s : {small, same}) {
    EXPECT_EQ(s.samples, given.samples);
    EXPECT_EQ(s.raysPerShading, given.raysPerShading);
    EXPECT_EQ(s.laterShare, 1);
  }
  int samples = given.samples, share = given.raysPerShading;
  for (const int width : {560, 640, 960, 1280, 1920, 3840}) {
    const RayGatherSettings s = withCounts(ofSize(width, width * 9 / 16));
    EXPECT_LE(s.samples, samples) << width;
    EXPECT_GE(s.raysPerShading, share) << width;
    EXPECT_GT(s.samples, s.firstSamples) << width;
    samples = s.samples, share = s.raysPerShading;
  }
  EXPECT_EQ(samples, 8);
  const RayGatherSettings wide = withCounts(ofSize(960, 540));
  EXPECT_EQ(wide.samples, 8);
  EXPECT_EQ(wide.raysPerShading, given.raysPerShading);
  EXPECT_EQ(wide.laterShare, 2);
}

TEST(RayGather, aNumberOfRaysThatIsAskedForIsKept) {
  RayGatherSettings s = ofSize(1920, 1080);
  s.samples = 17, s.countsBySize = false;
  EXPECT_EQ(withCounts(s).samples, 17);
  // One pass alone has no later rays.
  s.samples = s.firstSamples, s.countsBySize = true;
  EXPECT_EQ(withCounts(s).samples, s.firstSamples);
}

TEST(RayGather, laterRaysFillWholePasses) {
  for (int width = 480; width < 1200; width += 16) {
    const RayGatherSettings s = withCounts(ofSize(width, width * 9 / 16));
    EXPECT_EQ((s.samples - s.firstSamples) % 4, 0) << width;
  }
}

// Else nothing would tell how noisy a pixel is.
TEST(RayGather, singleEstimatesAreNotShared) {
  RayGatherSettings s = ofSize(1920, 1080);
  s.estimates = 1;
  EXPECT_EQ(withCounts(s).raysPerShading, s.raysPerShading);
  EXPECT_EQ(withCounts(s).laterShare, 1);
}

}  // namespace
}  // namespace roomlight
