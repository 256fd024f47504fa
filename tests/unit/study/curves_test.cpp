#include "study/curves.h"

#include <gtest/gtest.h>

#include <cmath>

namespace roomlight {
namespace {

StudyPoint point(int samples, double seconds, double mse) {
  StudyPoint p;
  p.samples = samples, p.seconds = seconds, p.mse = mse, p.mseBeyondNoise = mse;
  return p;
}

StudyCurve curve(std::vector<StudyPoint> points) { return {"cone", "ours", std::move(points), {}}; }

TEST(StudyCurves, MedianIsTheMiddleOne) {
  EXPECT_EQ(medianOf({}), 0);
  EXPECT_EQ(medianOf({3, 1, 2}), 2);
  EXPECT_EQ(medianOf({4, 1, 2, 3}), 2.5);
}

TEST(StudyCurves, SettlesWhereTwiceTheSamplesChangeNextToNothing) {
  const StudyCurve falling = curve({point(1, 1, 0.01), point(2, 2, 0.005), point(4, 4, 0.0025)});
  EXPECT_FALSE(hasSettled(falling));
  EXPECT_EQ(settledPoint(falling).samples, 4);
  const StudyCurve pausing = curve({point(1, 1, 0.01), point(2, 2, 0.005), point(4, 4, 0.0049)});
  EXPECT_FALSE(hasSettled(pausing)) << "once may be chance";
  const StudyCurve flat = curve({point(1, 1, 0.01), point(2, 2, 0.005), point(4, 4, 0.0049), point(8, 8, 0.0048)});
  EXPECT_TRUE(hasSettled(flat));
  EXPECT_EQ(settledPoint(flat).samples, 2);
  EXPECT_FALSE(hasSettled(curve({point(1, 1, 0.01)})));
}

TEST(StudyCurves, ErrorThatRisesAgainHasSettledBefore) {
  const StudyCurve c = curve({point(1, 1, 0.01), point(2, 2, 0.004), point(4, 4, 0.0042), point(8, 8, 0.0041)});
  EXPECT_TRUE(hasSettled(c));
  EXPECT_EQ(settledPoint(c).samples, 2);
}

TEST(StudyCurves, TimeToAnErrorLiesBetweenPoints) {
  const StudyCurve c = curve({point(1, 1, 0.01), point(2, 2, 0.005), point(4, 4, 0.0025)});
  EXPECT_DOUBLE_EQ(*secondsTo(c, 0.02), 1) << "the first is good enough";
  EXPECT_DOUBLE_EQ(*secondsTo(c, 0.005), 2);
  EXPECT_NEAR(*secondsTo(c, 0.005 / std::sqrt(2.0)), 2 * std::sqrt(2.0), 1e-9) << "straight in logarithms";
  EXPECT_FALSE(secondsTo(c, 0.002));
  EXPECT_FALSE(secondsTo(curve({}), 1));
}

TEST(StudyCurves, RatioIsOfTheLeastErrorThatBothReach) {
  const StudyCurve quick = curve({point(1, 1, 0.01), point(2, 2, 0.005), point(4, 4, 0.001)});
  const StudyCurve slow = curve({point(1, 10, 0.02), point(2, 20, 0.005)});
  EXPECT_NEAR(*timeRatioAtEqualError(quick, slow), 0.1, 1e-12);
  EXPECT_NEAR(*timeRatioAtEqualError(slow, quick), 10, 1e-12);
  EXPECT_FALSE(timeRatioAtEqualError(quick, curve({})));
}

TEST(StudyCurves, ErrorBelowTheReferencesNoiseCountsAsNone) { EXPECT_EQ(errorOf(point(1, 1, -0.001)), kLeastMse); }

}  // namespace
}  // namespace roomlight
