// Random numbers keyed by seed, generation and place: no generator's state to keep, and no order of threads to keep to.
#pragma once

#include <cstddef>
#include <cstdint>

#include "base/random.h"

namespace roomlight::search {

enum class Purpose : uint64_t { first, parents, vary, again, polish, mates };

class Draws {
 public:
  Draws(uint64_t seed, size_t generation, Purpose purpose, size_t place)
      : rng_(place, generation * 8 + static_cast<uint64_t>(purpose), seed) {}
  double uniform() {  // in [0, 1), 53 bits
    const uint64_t high = rng_.bits();
    return static_cast<double>((high << 21) ^ (rng_.bits() >> 11)) * 0x1p-53;
  }
  bool chance(double p) { return uniform() < p; }
  size_t index(size_t count) {
    return static_cast<size_t>((static_cast<uint64_t>(rng_.bits()) * count) >> 32);
  }  // 0 .. count - 1

 private:
  Rng rng_;
};

}  // namespace roomlight::search
