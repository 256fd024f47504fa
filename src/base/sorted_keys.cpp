#include "base/sorted_keys.h"

#include <algorithm>
#include <bit>
#include <numeric>
#include <utility>

#include "base/parallel.h"

namespace roomlight {
namespace {

constexpr size_t kFewest = 4096;  // keys that are worth more than one thread
constexpr size_t kInBucket = 16, kMostBuckets = 1 << 15;  // keys, where they are spread evenly
constexpr size_t kBucketsAtOnce = 256;

using Keyed = std::pair<uint64_t, uint32_t>;

}  // namespace

// Into buckets by their leading bits, then each bucket.
std::vector<uint32_t> sortedBy(std::span<const uint64_t> keys) {
  const size_t n = keys.size();
  uint64_t all = 1;
  for (const uint64_t key : keys) all |= key;
  const size_t buckets = std::bit_ceil(std::clamp<size_t>(n / kInBucket, 2, kMostBuckets));
  const int shift = std::max(0, static_cast<int>(std::bit_width(all)) - std::countr_zero(buckets));
  std::vector<uint32_t> begin(std::max<size_t>(buckets, (all >> shift) + 1) + 1, 0);
  for (const uint64_t key : keys) ++begin[(key >> shift) + 1];
  std::partial_sum(begin.begin(), begin.end(), begin.begin());
  std::vector<Keyed> keyed(n);
  std::vector<uint32_t> at(begin.begin(), begin.end() - 1);
  for (size_t i = 0; i < n; ++i) keyed[at[keys[i] >> shift]++] = {keys[i], static_cast<uint32_t>(i)};
  parallelFor(at.size(), kBucketsAtOnce,
              [&](size_t b) { std::sort(keyed.begin() + begin[b], keyed.begin() + begin[b + 1]); });
  std::vector<uint32_t> order(n);
  parallelFor(n, kFewest, [&](size_t i) { order[i] = keyed[i].second; });
  return order;
}

}  // namespace roomlight
