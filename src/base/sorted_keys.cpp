#include "base/sorted_keys.h"

#include <algorithm>
#include <utility>

#include "base/parallel.h"

namespace roomlight {
namespace {

constexpr size_t kFewest = 4096;  // keys that are worth more than one thread
constexpr size_t kParts = 16;

using Keyed = std::pair<uint64_t, uint32_t>;

}  // namespace

std::vector<uint32_t> sortedBy(std::span<const uint64_t> keys) {
  std::vector<Keyed> keyed(keys.size());
  parallelFor(keys.size(), kFewest, [&](size_t i) { keyed[i] = {keys[i], static_cast<uint32_t>(i)}; });
  // Parts sorted each, then merged by twos.
  const size_t part = std::max(kFewest, (keyed.size() + kParts - 1) / kParts);
  const auto at = [&](size_t i) { return keyed.begin() + static_cast<std::ptrdiff_t>(std::min(i, keyed.size())); };
  parallelFor((keyed.size() + part - 1) / part, 1, [&](size_t k) { std::sort(at(k * part), at((k + 1) * part)); });
  for (size_t width = part; width < keyed.size(); width *= 2) {
    parallelFor((keyed.size() + 2 * width - 1) / (2 * width), 1, [&](size_t k) { std::inplace_merge(at(2 * k * width), at((2 * k + 1) * width), at(2 * (k + 1) * width)); });
  }
  std::vector<uint32_t> order(keys.size());
  parallelFor(keys.size(), kFewest, [&](size_t i) { order[i] = keyed[i].second; });
  return order;
}

}  // namespace roomlight
