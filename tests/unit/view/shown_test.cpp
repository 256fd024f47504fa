#include "view/shown.h"

#include <gtest/gtest.h>

namespace roomlight::view {
namespace {

// From a sunny room into a dark one, by frames of 40 ms.
TEST(Adaptation, settlesWithinASecondAndNeverTurnsBack) {
  Adaptation eye;
  eye.follow(11, {Vec3(1), 6500}, 0);
  EXPECT_EQ(*eye.ev100, 11);
  double settledS = 0;
  float last = *eye.ev100;
  for (int frame = 1; frame <= 50; ++frame) {
    eye.follow(4, {{0.5f, 1.1f, 3}, 2700}, 0.04);
    EXPECT_LE(*eye.ev100, last);
    EXPECT_GE(*eye.ev100, 4);
    last = *eye.ev100;
    if (settledS == 0 && *eye.ev100 < 4 + 0.05f * 7) settledS = 0.04 * frame;
  }
  EXPECT_GT(settledS, 0.3);
  EXPECT_LT(settledS, 1.5);
  EXPECT_NEAR(eye.white.gains.z, 3, 0.01);
  EXPECT_NEAR(eye.white.kelvin, 2700, 10);
}

TEST(Adaptation, whatIsSetByHandHoldsAtOnce) {
  Adaptation eye;
  eye.follow(11, {}, 0);
  eye.follow(4, {}, static_cast<double>(kInfinity));
  EXPECT_EQ(*eye.ev100, 4);
}

}  // namespace
}  // namespace roomlight::view
