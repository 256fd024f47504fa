#include "base/parallel.h"

#include <gtest/gtest.h>

#include <atomic>
#include <mutex>
#include <set>
#include <stdexcept>
#include <utility>
#include <vector>
#ifdef __x86_64__
#include <pmmintrin.h>
#endif

#include "base/platform/flush_to_zero.h"

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

// What is done for several indices at once, such as rays traced in packets, may differ by the range in its last bits.
TEST(Parallel, rangesAreTheSameWithAnyNumberOfThreads) {
  const auto ranges = [](int threads) {
    std::set<std::pair<size_t, size_t>> out;
    std::mutex mutex;
    withThreads(threads, [&] {
      parallelRanges(10'007, 16, [&](size_t begin, size_t end) {
        const std::lock_guard lock(mutex);
        out.emplace(begin, end);
      });
    });
    return out;
  };
  const auto expected = ranges(1);
  EXPECT_GT(expected.size(), 10'007u / 16);
  for (const int threads : {2, 7, 32}) EXPECT_EQ(ranges(threads), expected) << threads;
}

TEST(Parallel, threadCapIsSeenInside) {
  for (int n : {1, 2, 3}) {
    int inside = 0;
    withThreads(n, [&] { inside = threadCount(); });
    EXPECT_EQ(inside, n);
  }
}

// Callers may reckon with tiny numbers.
bool keepsTinyNumbers() {
  const volatile float tiny = 1e-40f, small = 1e-30f, less = 1e-9f;
  return tiny * 1e10f > 0 && small * less > 0;
}
bool flushesTinyNumbers() {
  const volatile float tiny = 1e-40f, small = 1e-30f, less = 1e-9f;
  return tiny * 1e10f == 0 && small * less == 0;
}
TEST(Parallel, flushesToZeroInsideAlone) {
  const auto flushedInside = [] {
    std::atomic<int> flushing = 0;
    parallelFor(64, 1, [&](size_t) { flushing += flushesTinyNumbers(); });
    return flushing.load();
  };
  ASSERT_TRUE(keepsTinyNumbers());
  EXPECT_EQ(flushedInside(), 64);
  EXPECT_TRUE(keepsTinyNumbers());
  {
    const FlushToZero before;
    EXPECT_EQ(flushedInside(), 64);
    EXPECT_TRUE(flushesTinyNumbers());
  }
  EXPECT_TRUE(keepsTinyNumbers());
}

#ifdef __x86_64__
TEST(Parallel, leavesHowResultsAndOperandsAreFlushedAsItWas) {
  const unsigned before = _mm_getcsr();
  for (const unsigned flags : {0u, static_cast<unsigned>(_MM_FLUSH_ZERO_ON)}) {
    _mm_setcsr((before & ~(_MM_FLUSH_ZERO_MASK | _MM_DENORMALS_ZERO_MASK)) | flags);
    std::atomic<int> flushing = 0;
    parallelFor(64, 1, [&](size_t) {
      flushing += _MM_GET_FLUSH_ZERO_MODE() == _MM_FLUSH_ZERO_ON && _MM_GET_DENORMALS_ZERO_MODE() != 0;
    });
    EXPECT_EQ(flushing.load(), 64);
    EXPECT_EQ(_MM_GET_FLUSH_ZERO_MODE(), flags);
    EXPECT_EQ(_MM_GET_DENORMALS_ZERO_MODE(), 0u);
  }
  _mm_setcsr(before);
}
#endif

TEST(Parallel, exceptionsReachTheCaller) {
  EXPECT_THROW(parallelFor(100, 1,
                           [](size_t i) {
                             if (i == 50) throw std::runtime_error("fifty");
                           }),
               std::runtime_error);
}

}  // namespace
}  // namespace roomlight
