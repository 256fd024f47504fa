#include "validate/self_test.h"

#include <gtest/gtest.h>

#include "engine/technique.h"

namespace roomlight {
namespace {

// By hand: 96 m² take in 1000 lm and reflect half, so 20.83 lx fall on them and 3.316 cd/m² come back.
TEST(SelfTest, TheMeanIsThatOfTheClosedForm) { EXPECT_NEAR(knownPicture().meanCdM2, 3.3157, 1e-3); }

TEST(SelfTest, PathAndHybridMeetIt) {
  for (const char* technique : {technique::kPath, technique::kHybrid}) {
    const SelfTest test = selfTest(technique, kSelfTestPercent).value();
    EXPECT_TRUE(test.pass) << technique << ": " << test.meanCdM2 << " for " << test.expectedCdM2;
    EXPECT_GT(test.samplesPerSecond, 0) << technique;
    EXPECT_GT(test.seconds, 0) << technique;
  }
}

TEST(SelfTest, WhatIsFurtherOffThanAllowedFails) {
  EXPECT_FALSE(selfTest(technique::kHybrid, 0).value().pass);
  EXPECT_FALSE(selfTest("guessing", kSelfTestPercent));
}

TEST(SelfTest, StopsWhenAsked) {
  const std::atomic<bool> stop = true;
  Progress progress;
  progress.cancelled = &stop;
  const SelfTest test = selfTest(technique::kHybrid, kSelfTestPercent, progress).value();
  EXPECT_FALSE(test.complete);
  EXPECT_FALSE(test.pass);
}

}  // namespace
}  // namespace roomlight
