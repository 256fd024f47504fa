#include "measure/exposure.h"

#include <gtest/gtest.h>

namespace roomlight {
namespace {

TEST(Exposure, isThatOfALightMeter) {
  EXPECT_NEAR(incidentEv100(300), 6.91, 0.005);
  EXPECT_NEAR(reflectedEv100(17.19), 7.10, 0.005);
}

}  // namespace
}  // namespace roomlight
