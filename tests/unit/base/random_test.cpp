#include <gtest/gtest.h>

#include <set>
#include <vector>

#include "base/random.h"
#include "base/sampler.h"
#include "unit/base/chi_square.h"

namespace roomlight {
namespace {

TEST(Rng, isAFunctionOfItsKeys) {
  Rng a(5, 6, 7), b(5, 6, 7), otherPixel(4, 6, 7), otherSample(5, 5, 7), otherSeed(5, 6, 8);
  const uint32_t first = a.bits();
  EXPECT_EQ(first, b.bits());
  EXPECT_NE(first, otherPixel.bits());
  EXPECT_NE(first, otherSample.bits());
  EXPECT_NE(first, otherSeed.bits());
}

TEST(Rng, isUniformInPairsAlongAStream) {
  std::vector<double> counts(256);
  Rng rng(0, 0, 0);
  for (int i = 0; i < 200'000; ++i) {
    const Vec2 u = rng.uniform2();
    counts[static_cast<size_t>(u.x * 16) * 16 + static_cast<size_t>(u.y * 16)]++;
  }
  EXPECT_TRUE(testing::fitsUniform(counts));
}

TEST(Rng, firstNumbersOfNeighbouringPixelsAndSamplesAreIndependent) {
  std::vector<double> counts(256);
  for (uint64_t pixel = 0; pixel < 500; ++pixel) {
    for (uint64_t sample = 0; sample < 400; ++sample) {
      const float a = Rng(pixel, sample, 0).uniform(), b = Rng(pixel, sample + 1, 0).uniform();
      counts[static_cast<size_t>(a * 16) * 16 + static_cast<size_t>(b * 16)]++;
    }
  }
  EXPECT_TRUE(testing::fitsUniform(counts));
}

TEST(Rng, staysBelowOne) {
  Rng rng(1, 1, 1);
  for (int i = 0; i < 100'000; ++i) {
    const float u = rng.uniform();
    ASSERT_GE(u, 0);
    ASSERT_LT(u, 1);
  }
}

// (0, m, 2)-net in base 2: 2^m points put exactly one into every elementary interval of area 2^-m.
TEST(Sampler, firstPairsFormANetInEveryDimensionPair) {
  constexpr int m = 6;
  for (int pair = 0; pair < 24; ++pair) {
    for (int a = 0; a <= m; ++a) {
      std::set<int> cells;
      for (uint32_t sample = 0; sample < (1u << m); ++sample) {
        Sampler sampler(77, sample, 3);
        Vec2 u;
        for (int i = 0; i <= pair; ++i) u = sampler.next2();
        ASSERT_GE(u.x, 0);
        ASSERT_LT(u.x, 1);
        const int x = static_cast<int>(u.x * static_cast<float>(1 << a));
        const int y = static_cast<int>(u.y * static_cast<float>(1 << (m - a)));
        cells.insert(x * 1024 + y);
      }
      EXPECT_EQ(cells.size(), size_t{1} << m) << "pair " << pair << ", split " << a;
    }
  }
}

TEST(Sampler, differentPairsAreNotCorrelated) {
  std::vector<double> counts(64);
  for (uint64_t pixel = 0; pixel < 200; ++pixel) {
    for (uint32_t sample = 0; sample < 256; ++sample) {
      Sampler sampler(pixel, sample, 0);
      const Vec2 a = sampler.next2(), b = sampler.next2();
      counts[static_cast<size_t>(a.x * 8) * 8 + static_cast<size_t>(b.x * 8)]++;
    }
  }
  EXPECT_TRUE(testing::fitsUniform(counts));
}

// Two halves of each of 128 samples are as evenly spread as 256 samples: one in every cell of 16 x 16, and of 256 x 1.
TEST(Sampler, splitSamplesAreWellDistributedTogether) {
  std::set<int> squares, columns;
  for (uint32_t i = 0; i < 128; ++i) {
    for (uint32_t k = 0; k < 2; ++k) {
      Sampler part = Sampler(7, i, 3).split(k, 2);
      const Vec2 u = part.next2();
      squares.insert(static_cast<int>(u.x * 16) * 16 + static_cast<int>(u.y * 16));
      columns.insert(static_cast<int>(u.x * 256));
    }
  }
  EXPECT_EQ(squares.size(), 256u);
  EXPECT_EQ(columns.size(), 256u);
}

}  // namespace
}  // namespace roomlight
