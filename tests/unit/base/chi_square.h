// Pearson's chi-square test of counts against expectations, through the Wilson-Hilferty approximation of its
// distribution. Rejects a right sampler once in a million runs; the seeds are fixed, so never at random.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>
#include <vector>

namespace roomlight::testing {

inline ::testing::AssertionResult fits(const std::vector<double>& counts, const std::vector<double>& expected) {
  double chi = 0, freedom = -1, restCount = 0, restExpected = 0;
  for (size_t i = 0; i < counts.size(); ++i) {
    if (expected[i] < 5) {  // cells too thin for the approximation are pooled
      restCount += counts[i], restExpected += expected[i];
      continue;
    }
    const double d = counts[i] - expected[i];
    chi += d * d / expected[i];
    freedom += 1;
  }
  if (restExpected >= 5) {
    chi += (restCount - restExpected) * (restCount - restExpected) / restExpected;
    freedom += 1;
  } else if (restCount > restExpected + 30) {
    return ::testing::AssertionFailure() << restCount << " samples where about " << restExpected << " belong";
  }
  const double k = 2 / (9 * freedom);
  const double z = (std::cbrt(chi / freedom) - (1 - k)) / std::sqrt(k);
  if (z < 4.75) return ::testing::AssertionSuccess();
  return ::testing::AssertionFailure() << "chi-square " << chi << " for " << freedom
                                       << " degrees of freedom, z = " << z;
}

inline ::testing::AssertionResult fitsUniform(const std::vector<double>& counts) {
  const double mean = std::accumulate(counts.begin(), counts.end(), 0.0) / static_cast<double>(counts.size());
  return fits(counts, std::vector<double>(counts.size(), mean));
}

}  // namespace roomlight::testing
