// Well-distributed sample points: Owen-scrambled Sobol' pairs, padded by hashing (Burley 2020, "Practical hash-based
// Owen scrambling"), for the first dimensions of a path; independent PCG numbers after that. Keyed by pixel, sample
// index and seed, so the points do not depend on threads.
#pragma once

#include <cstdint>

#include "base/random.h"

namespace roomlight {

namespace detail {
inline uint32_t reverseBits(uint32_t v) {
  v = (v << 16) | (v >> 16);
  v = ((v & 0x00ff00ffu) << 8) | ((v & 0xff00ff00u) >> 8);
  v = ((v & 0x0f0f0f0fu) << 4) | ((v & 0xf0f0f0f0u) >> 4);
  v = ((v & 0x33333333u) << 2) | ((v & 0xccccccccu) >> 2);
  return ((v & 0x55555555u) << 1) | ((v & 0xaaaaaaaau) >> 1);
}
inline uint32_t owenScramble(uint32_t v, uint32_t seed) {  // Laine-Karras permutation between bit reversals
  v = reverseBits(v);
  v += seed;
  v ^= v * 0x6c50b47cu;
  v ^= v * 0xb82f1e52u;
  v ^= v * 0xc7afe638u;
  v ^= v * 0x8d22f6e6u;
  return reverseBits(v);
}
inline uint32_t sobolSecond(uint32_t index) {  // second dimension of Sobol's sequence
  uint32_t result = 0;
  for (uint32_t v = 1u << 31; index; index >>= 1, v ^= v >> 1) {
    if (index & 1) result ^= v;
  }
  return result;
}
}  // namespace detail

class Sampler {
 public:
  Sampler(uint64_t pixel, uint32_t sample, uint64_t seed) : rng_(pixel, sample, seed), sample_(sample) {
    key_ = static_cast<uint32_t>(mix64(pixel * 0x9e3779b97f4a7c15ull + seed));
  }
  Vec2 next2() {
    if (dimension_ >= kStratifiedPairs) return rng_.uniform2();
    const uint32_t key = mix32(key_ + 0x9e3779b9u * ++dimension_);
    const uint32_t index = detail::owenScramble(sample_, key);
    const uint32_t x = detail::owenScramble(detail::reverseBits(index), mix32(key ^ 0xa511e9b3u));
    const uint32_t y = detail::owenScramble(detail::sobolSecond(index), mix32(key ^ 0x63d83595u));
    return {toUnit(x), toUnit(y)};
  }
  float next1() { return dimension_ >= kStratifiedPairs ? rng_.uniform() : next2().x; }

 private:
  static constexpr uint32_t kStratifiedPairs = 24;
  static float toUnit(uint32_t v) { return static_cast<float>(v >> 8) * 0x1p-24f; }
  Rng rng_;
  uint32_t key_, sample_, dimension_ = 0;
};

}  // namespace roomlight
