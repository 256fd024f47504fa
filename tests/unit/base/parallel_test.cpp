#include "base/parallel.h"

#include <gtest/gtest.h>

#include <atomic>
#include <stdexcept>
#include <vector>

namespace roomlight {
namespace {

TEST(Parallel, everyIndexRunsExactlyOnce) {
  std::vector<std::atomic<int>> seen(10'007);
  parallelFor(seen.size(), 64, [&](size_t i) { seen[i]++; });
  for (const auto& n : seen) ASSERT_EQ(n.load(), 1);
}

TEST(Parallel, emptyRangesAndZeroGrainAreFine) {
  int runs = 0;
  parallelRanges(0, 8, [&](size_t, size_t) { ++runs; });
  EXPECT_EQ(runs, 0);
  std::atomic<size_t> sum = 0;
  parallelRanges(10, 0, [&](size_t begin, size_t end) { sum += end - begin; });
  EXPECT_EQ(sum.load(), 10u);
}

TEST(Parallel, threadCapIsSeenInside) {
  for (int n : {1, 2, 3}) {
    int inside = 0;
    withThreads(n, [&] { inside = threadCount(); });
    EXPECT_EQ(inside, n);
  }
}

TEST(Parallel, exceptionsReachTheCaller) {
  EXPECT_THROW(parallelFor(100, 1,
                           [](size_t i) {
                             if (i == 50) throw std::runtime_error("fifty");
                           }),
               std::runtime_error);
}

}  // namespace
}  // namespace roomlight
