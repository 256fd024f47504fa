#include "compare/perceived_error.h"

#include <gtest/gtest.h>

#include <numeric>

#include "base/random.h"

namespace roomlight {
namespace {

Image constant(Vec3 v, int size = 40) {
  Image image(size, size);
  for (Vec3& p : image.pixels) p = v;
  return image;
}
double mean(const Plane& plane) {
  return std::accumulate(plane.values.begin(), plane.values.end(), 0.0) / static_cast<double>(plane.values.size());
}

TEST(Flip, extremesOfTheScale) {
  EXPECT_EQ(mean(flipDifference(constant(Vec3(0.3f)), constant(Vec3(0.3f)))), 0);
  // Green against blue is the largest difference there is, by definition of the scale.
  EXPECT_NEAR(mean(flipDifference(constant({0, 1, 0}), constant({0, 0, 1}))), 1, 1e-3);
}

TEST(Flip, isSymmetric) {
  Image a = constant(Vec3(0.5f)), b = constant(Vec3(0.5f));
  for (size_t i = 0; i < a.pixels.size(); ++i) {
    Rng rng(i, 0, 0);
    a.pixels[i] = Vec3(rng.uniform());
    b.pixels[i] = {rng.uniform(), rng.uniform(), rng.uniform()};
  }
  EXPECT_NEAR(mean(flipDifference(a, b)), mean(flipDifference(b, a)), 1e-6);
}

TEST(Flip, fineNoiseCountsLessThanABlotchOfTheSameSize) {
  Image grey = constant(Vec3(0.2f), 64), fine = grey, blotch = grey;
  for (int y = 0; y < 64; ++y) {
    for (int x = 0; x < 64; ++x) {
      fine.at(x, y) *= (x + y) % 2 ? 1.1f : 0.9f;
      blotch.at(x, y) *= x < 32 ? 1.1f : 0.9f;
    }
  }
  EXPECT_LT(mean(flipDifference(grey, fine)), mean(flipDifference(grey, blotch)));
}

}  // namespace
}  // namespace roomlight
