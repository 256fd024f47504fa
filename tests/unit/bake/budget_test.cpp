// What becomes coarser where a home must be smaller.
#include "bake/budget.h"

#include <gtest/gtest.h>

namespace roomlight::bake {
namespace {

class Budget : public ::testing::Test {
 protected:
  const BakeSettings good_ = bakeSettings("good").value();
};

TEST_F(Budget, whatFitsStaysAsItIs) {
  const BakeSettings s = withinBudget(good_, {1e6, 2e6, 3e6}, 6'000'000);
  EXPECT_EQ(s.charts.texelM, good_.charts.texelM);
  EXPECT_EQ(s.glb.mostTexturePixels, good_.glb.mostTexturePixels);
  EXPECT_EQ(s.simplifyM, good_.simplifyM);
}

TEST_F(Budget, whatGainsMostIsFirst) {
  const BakeSettings light = withinBudget(good_, {1e6, 1e6, 9e6}, 9'000'000);
  EXPECT_GT(light.charts.texelM, good_.charts.texelM);
  EXPECT_EQ(light.charts.texelM, light.atlas.texelM);
  EXPECT_EQ(light.glb.mostTexturePixels, good_.glb.mostTexturePixels);
  const BakeSettings textures = withinBudget(good_, {1e6, 9e6, 1e6}, 9'000'000);
  EXPECT_EQ(textures.charts.texelM, good_.charts.texelM);
  EXPECT_EQ(textures.glb.mostTexturePixels, good_.glb.mostTexturePixels / 2);
  const BakeSettings geometry = withinBudget(good_, {9e6, 1e6, 1e6}, 9'000'000);
  EXPECT_GT(geometry.simplifyM, good_.simplifyM);
}

TEST_F(Budget, endsAtTheCoarsest) {
  const BakeSettings s = withinBudget(good_, {1e9, 1e9, 1e9}, 1);
  EXPECT_EQ(s.glb.mostTexturePixels, kSmallestTexture);
  EXPECT_NEAR(s.charts.texelM, 4 * good_.charts.texelM, 1e-3);
  EXPECT_LE(s.simplifyM, 0.0161f);
}

}  // namespace
}  // namespace roomlight::bake
