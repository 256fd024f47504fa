#include "search/front.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "base/random.h"

namespace roomlight::search {
namespace {

TEST(Hypervolume, ofBoxesByHand) {
  EXPECT_NEAR(hypervolume(std::vector<double>{1, 3, 2, 2, 3, 1}, std::vector<double>{4, 4}), 6, 1e-12);
  EXPECT_NEAR(hypervolume(std::vector<double>{1, 1, 1}, std::vector<double>{2, 3, 4}), 6, 1e-12);
  EXPECT_NEAR(hypervolume(std::vector<double>{0, 0, 0, 0, 1, 1, 1, 1}, std::vector<double>{2, 2, 2, 2}), 16, 1e-12);
}

TEST(Hypervolume, pointsBeyondTheReferenceAddNothing) {
  EXPECT_EQ(hypervolume({}, std::vector<double>{1, 1}), 0);
  EXPECT_EQ(hypervolume(std::vector<double>{0, 1, 1, 0, 2, -5}, std::vector<double>{1, 1}), 0);
  EXPECT_NEAR(hypervolume(std::vector<double>{0.5, 0.5, -9, 1.5}, std::vector<double>{1, 1}), 0.25, 1e-12);
}

// Share of random points in the unit box that some point dominates.
TEST(Hypervolume, agreesWithCountingRandomPoints) {
  for (size_t m : {2, 3, 4}) {
    Rng rng(0, 0, m);
    std::vector<double> points(30 * m);
    for (double& p : points) p = static_cast<double>(rng.uniform());
    const int count = 40'000;
    int inside = 0;
    for (int i = 0; i < count; ++i) {
      std::vector<double> x(m);
      for (double& v : x) v = static_cast<double>(rng.uniform());
      bool found = false;
      for (size_t p = 0; p < 30 && !found; ++p) {
        found = true;
        for (size_t k = 0; k < m; ++k) found &= points[p * m + k] <= x[k];
      }
      inside += found;
    }
    // Three standard deviations of the count are at most .0075.
    EXPECT_NEAR(hypervolume(points, std::vector<double>(m, 1.0)), static_cast<double>(inside) / count, 0.0075) << m;
  }
}

TEST(Hypervolume, shareDoesNotDependOnUnits) {
  const std::vector<double> points{10, 300, 20, 200}, scaled{0.01, 3, 0.02, 2};
  const double share = hypervolumeShare(points, std::vector<double>{0, 100}, std::vector<double>{40, 400});
  EXPECT_NEAR(share, (30 * 100 + 20 * 100) / (40.0 * 300), 1e-12);
  EXPECT_NEAR(hypervolumeShare(scaled, std::vector<double>{0, 1}, std::vector<double>{0.04, 4}), share, 1e-12);
}

}  // namespace
}  // namespace roomlight::search
