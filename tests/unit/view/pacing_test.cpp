#include "view/pacing.h"

#include <gtest/gtest.h>

#include "view/window.h"

namespace roomlight::view {
namespace {

TEST(Pacing, sizesFollowWhatPicturesTake) {
  Pace pace;
  const std::pair whole(960, 540);
  for (int i = 0; i < 30; ++i) pace.took(whole, 200);
  const auto [width, height] = pace.sizeFor(50, whole);
  EXPECT_NEAR(width, 480, 2);
  EXPECT_NEAR(height, 270, 2);
  pace.took(whole, 180);
  pace.took(whole, 230);
  EXPECT_EQ(pace.sizeFor(50, whole), std::pair(width, height));  // not to and fro
  for (int i = 0; i < 30; ++i) pace.took(whole, 20);
  EXPECT_EQ(pace.sizeFor(50, whole), whole);
  for (int i = 0; i < 30; ++i) pace.took(whole, 1e5);
  EXPECT_NEAR(pace.sizeFor(50, whole).second, 100, 15);
  for (int i = 0; i < 60; ++i) pace.took(whole, 1);
  const auto [w, h] = pace.sizeFor(50, {1920, 1080});
  EXPECT_LE(w * h, 960 * 540);
}

TEST(Pacing, slowLinesGetWorseJpeg) {
  Line quick, slow;
  for (int i = 0; i < 30; ++i) quick.sent(100'000, 5), slow.sent(100'000, 400);
  EXPECT_EQ(quick.quality(), 90);
  EXPECT_EQ(quick.scale(), 1);
  EXPECT_EQ(slow.quality(), 50);
  EXPECT_LT(slow.scale(), 0.7f);
}

TEST(Pacing, framesKeepTheViewportsAspect) {
  EXPECT_EQ(frameSize({1280, 720, 1}, 1), std::pair(1280, 720));
  EXPECT_EQ(frameSize({1280, 720, 3}, 1), std::pair(1920, 1080));
  EXPECT_EQ(frameSize({390, 844, 3}, 1), std::pair(499, 1080));
  EXPECT_EQ(frameSize({390, 844, 0.5f}, 1), std::pair(195, 422));
}

}  // namespace
}  // namespace roomlight::view
