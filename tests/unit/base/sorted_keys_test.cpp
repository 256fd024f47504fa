#include "base/sorted_keys.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <vector>

#include "base/random.h"

namespace roomlight {
namespace {

TEST(SortedKeys, keepTheOrderOfEqualOnes) {
  for (const size_t count : {0, 1, 2, 4096, 4097, 100001}) {
    std::vector<uint64_t> keys(count);
    for (size_t i = 0; i < count; ++i) keys[i] = mix64(i) % 1000;
    std::vector<uint32_t> expected(count);
    std::iota(expected.begin(), expected.end(), 0u);
    std::stable_sort(expected.begin(), expected.end(), [&](uint32_t a, uint32_t b) { return keys[a] < keys[b]; });
    ASSERT_EQ(sortedBy(keys), expected) << count;
  }
}

// Spread over all 64 bits, and all but one within a few.
TEST(SortedKeys, takeKeysOfAnySize) {
  for (const int bits : {64, 8}) {
    std::vector<uint64_t> keys(20000);
    for (size_t i = 0; i < keys.size(); ++i) keys[i] = mix64(i) >> (64 - bits);
    keys[777] = ~uint64_t{0}, keys[778] = 0;
    const std::vector<uint32_t> order = sortedBy(keys);
    for (size_t i = 1; i < order.size(); ++i) {
      const uint64_t a = keys[order[i - 1]], b = keys[order[i]];
      ASSERT_TRUE(a < b || (a == b && order[i - 1] < order[i])) << bits << ' ' << i;
    }
  }
}

TEST(SortedKeys, runsHoldEqualKeys) {
  const std::vector<uint64_t> keys{7, 3, 7, 7, 3, 9};
  std::vector<size_t> lengths;
  forRuns(keys, sortedBy(keys), [&](size_t begin, size_t end) { lengths.push_back(end - begin); });
  EXPECT_EQ(lengths, (std::vector<size_t>{2, 3, 1}));
}

}  // namespace
}  // namespace roomlight
