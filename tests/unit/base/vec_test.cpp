#include "base/vec.h"

#include <gtest/gtest.h>

#include "base/random.h"
#include "base/sampling.h"

namespace roomlight {
namespace {

Vec3 randomVector(Rng& rng) { return {rng.uniform() * 2 - 1, rng.uniform() * 2 - 1, rng.uniform() * 2 - 1}; }
void expectNear(Vec3 a, Vec3 b, float tolerance) { EXPECT_LT(length(a - b), tolerance); }

TEST(Vec, frameIsOrthonormalAndRightHandedForEveryNormal) {
  Rng rng(1, 2, 3);
  for (int i = 0; i < 1000; ++i) {
    Vec3 n = sampleSphere(rng.uniform2());
    if (i == 0) n = {0, 0, -1};
    if (i == 1) n = {0, 0, 1};
    const Frame f(n);
    expectNear(cross(f.t, f.b), f.n, 1e-5f);
    EXPECT_NEAR(length(f.t), 1, 1e-5f);
    EXPECT_NEAR(dot(f.t, f.n), 0, 1e-5f);
    const Vec3 v = randomVector(rng);
    expectNear(f.toLocal(f.toWorld(v)), v, 1e-5f);
  }
}

TEST(Vec, affineInverseUndoesTheMap) {
  Rng rng(4, 5, 6);
  int tried = 0;
  while (tried < 500) {
    const Affine a{randomVector(rng), randomVector(rng), randomVector(rng), randomVector(rng) * 10.0f};
    if (std::abs(a.determinant()) < 0.05f) continue;
    ++tried;
    const Vec3 p = randomVector(rng);
    expectNear(inverse(a).point(a.point(p)), p, 2e-3f);
    expectNear((a * inverse(a)).point(p), p, 2e-3f);
  }
}

TEST(Vec, transformedNormalStaysPerpendicularToTransformedTangents) {
  Rng rng(7, 8, 9);
  for (int i = 0; i < 500; ++i) {
    const Affine a{randomVector(rng), randomVector(rng), randomVector(rng), {}};
    const Vec3 t = randomVector(rng), b = randomVector(rng);
    const Vec3 n = a.normal(cross(t, b));
    EXPECT_NEAR(dot(n, a.vector(t)), 0, 1e-4f);
    EXPECT_NEAR(dot(n, a.vector(b)), 0, 1e-4f);
    // It is the cross product of the transformed edges: front stays front, for mirrors too.
    expectNear(n, cross(a.vector(t), a.vector(b)), 1e-4f);
  }
}

TEST(Vec, boundsGrowAndKnowWhenTheyAreEmpty) {
  Bounds3 b;
  EXPECT_TRUE(b.empty());
  b.add({1, 2, 3});
  EXPECT_FALSE(b.empty());
  b.add({-1, 0, 5});
  EXPECT_TRUE(b.size() == Vec3(2, 2, 2));
  EXPECT_TRUE(b.centre() == Vec3(0, 1, 4));
}

TEST(Vec, luminanceOfWhiteIsOne) { EXPECT_FLOAT_EQ(luminance(Vec3(1)), 1); }

}  // namespace
}  // namespace roomlight
