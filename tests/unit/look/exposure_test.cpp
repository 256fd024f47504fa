#include "look/exposure.h"

#include <gtest/gtest.h>

#include "base/tone.h"

namespace roomlight {
namespace {

// A room of one luminance with a window over `share` of the width.
Image room(float cdM2, float windowCdM2, double share) {
  Image image(120, 80);
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) image.at(x, y) = Vec3(x < share * image.width ? windowCdM2 : cdM2);
  }
  return image;
}

TEST(LookedAt, isMiddleGrey) { EXPECT_NEAR(exposureFromEv100(lookedAtEv100(room(40, 40, 0))) * 40, 0.18f, 1e-4f); }

TEST(LookedAt, windowsLampsAndHolesDoNotRule) {
  const float ev100 = lookedAtEv100(room(40, 40, 0));
  EXPECT_NEAR(lookedAtEv100(room(40, 4000, 0.35)), ev100, 1e-3f);
  EXPECT_NEAR(lookedAtEv100(room(40, 0.1f, 0.35)), ev100, 1e-3f);
  EXPECT_EQ(lookedAtEv100(room(0, 0, 0)), 0);
}

TEST(LookedAt, voidIsShownALittleBrighter) {
  const float ev100 = lookedAtEv100(room(40, 40, 0)), half = lookedAtEv100(room(40, 0, 0.5));
  EXPECT_LT(half, ev100 - 0.1f);
  EXPECT_GT(half, ev100 - 0.3f);
}

TEST(LookedAt, theMiddleCountsMoreThanTheEdges) {
  Image image = room(10, 10, 0);
  for (int y = 24; y < 56; ++y) {
    for (int x = 36; x < 84; ++x) image.at(x, y) = Vec3(20);
  }
  EXPECT_GT(lookedAtEv100(image), lookedAtEv100(room(10, 10, 0)) + 0.16f + 0.05f);  // 16 % of the area
}

TEST(HeldGrounds, liePutAtMostTwoThirdsOfAStopAboveTheRooms) {
  Image plan(20, 10);
  std::vector<bool> rooms(plan.pixels.size());
  for (size_t i = 0; i < plan.pixels.size(); ++i)
    rooms[i] = i % 20 < 10, plan.pixels[i] = rooms[i] ? Vec3(100) : Vec3(4000, 5000, 2000);
  const float ev100 = lookedAtEv100(pixelsWhere(plan, rooms, true));
  holdGrounds(plan, rooms, ev100);
  EXPECT_EQ(plan.pixels[3], Vec3(100));
  EXPECT_NEAR(lookedAtEv100(pixelsWhere(plan, rooms, false)), ev100 + 2.0f / 3, 0.01f);
  EXPECT_NEAR(plan.pixels[15].y / plan.pixels[15].x, 1.25f, 1e-4f);
  const Image before = plan;
  holdGrounds(plan, rooms, ev100);
  for (size_t i = 0; i < plan.pixels.size(); ++i)
    EXPECT_NEAR(plan.pixels[i].y, before.pixels[i].y, 1e-3f * before.pixels[i].y);
}

void expose(Image& image, const Plane& gains) {
  for (size_t i = 0; i < image.pixels.size(); ++i) image.pixels[i] *= gains.values[i];
}

TEST(LocalExposure, leavesWhatIsEvenlyLit) {
  const float ev100 = std::log2(1 / 1.2f);
  for (const auto gains : {localExposure, quickLocalExposure}) {
    Image grey = room(0.18f, 0.18f, 0);
    expose(grey, gains(grey, ev100, 1));
    for (const Vec3& p : grey.pixels) EXPECT_NEAR(p.y, 0.18f, 0.002f);
  }
}

TEST(LocalExposure, bringsWindowAndRoomNearerAndKeepsHues) {
  const float ev100 = std::log2(1 / 1.2f);
  for (const auto gains : {localExposure, quickLocalExposure}) {
    Image image = room(0.03f, 3, 0.4);
    for (Vec3& p : image.pixels) p = p * Vec3{1, 0.8f, 0.5f};
    const float before = image.at(5, 40).y / image.at(115, 40).y, metered = lookedAtEv100(image);
    expose(image, gains(image, ev100, 0.6f));
    EXPECT_LT(image.at(5, 40).y / image.at(115, 40).y, 0.6f * before);
    EXPECT_NEAR(lookedAtEv100(image), metered, 0.04f);
    for (const Vec3& p : image.pixels) {
      EXPECT_NEAR(p.y / p.x, 0.8f, 1e-4f);
      EXPECT_NEAR(p.z / p.x, 0.5f, 1e-4f);
    }
  }
}

// Edges stay where they are: beside six stops the quick one differs by a rim as wide as its windows, elsewhere by
// nothing that is seen.
TEST(LocalExposure, theQuickOneFollowsEdges) {
  const Image image = room(0.06f, 4, 0.4);
  const float ev100 = std::log2(1 / 1.2f);
  const Plane exact = localExposure(image, ev100, 1), quick = quickLocalExposure(image, ev100, 1);
  for (int x = 0; x < image.width; ++x) {
    const bool beside = std::abs(2 * x - 95) < 16;
    for (int y = 0; y < image.height; ++y)
      EXPECT_LT(std::abs(std::log2(quick.at(x, y) / exact.at(x, y))), beside ? 0.7f : 0.15f) << x << " " << y;
  }
}

}  // namespace
}  // namespace roomlight
