// Lists grouped by keys, the same by any number of threads.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace roomlight {

// Indices of a list of keys, sorted by key and then by place in the list.
std::vector<uint32_t> sortedBy(std::span<const uint64_t> keys);

// Calls body(begin, end) for every run of equal keys in `order`, a list of indices that sortedBy() made.
template <class Body>
void forRuns(std::span<const uint64_t> keys, std::span<const uint32_t> order, Body&& body) {
  for (size_t begin = 0, end = 0; begin < order.size(); begin = end) {
    while (end < order.size() && keys[order[end]] == keys[order[begin]]) ++end;
    body(begin, end);
  }
}

}  // namespace roomlight
