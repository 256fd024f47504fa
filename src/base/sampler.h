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
inline uint32_t laineKarras(uint32_t v, uint32_t seed) {  // Owen's scrambling of reversed bits
  v += seed;
  v ^= v * 0x6c50b47cu;
  v ^= v * 0xb82f1e52u;
  v ^= v * 0xc7afe638u;
  return v ^ v * 0x8d22f6e6u;
}
inline uint32_t owenScramble(uint32_t v, uint32_t seed) { return reverseBits(laineKarras(reverseBits(v), seed)); }
// Second dimension of Sobol's sequence from the first, which is the reversed index: Pascal's triangle modulo 2, applied
// in five steps (Ahmed 2024).
inline uint32_t sobolSecond(uint32_t first) {
  first ^= first << 16;
  first ^= (first & 0x00ff00ffu) << 8;
  first ^= (first & 0x0f0f0f0fu) << 4;
  first ^= (first & 0x33333333u) << 2;
  return first ^ (first & 0x55555555u) << 1;
}
}  // namespace detail

class Sampler {
 public:
  Sampler(uint64_t pixel, uint32_t sample, uint64_t seed)
      : rng_(pixel, sample, seed), reversedSample_(detail::reverseBits(sample)) {
    key_ = static_cast<uint32_t>(mix64(pixel * 0x9e3779b97f4a7c15ull + seed));
  }
  Vec2 next2() {
    if (dimension_ >= kStratifiedPairs) return rng_.uniform2();
    const uint32_t key = nextKey(), first = firstOf(key);
    return {toUnit(scrambleFirst(first, key)),
            toUnit(detail::owenScramble(detail::sobolSecond(first), mix32(key ^ 0x63d83595u)))};
  }
  float next1() {
    if (dimension_ >= kStratifiedPairs) return rng_.uniform();
    const uint32_t key = nextKey();
    return toUnit(scrambleFirst(firstOf(key), key));
  }
  // The i-th of n in place of this one, n a power of two: together they are as well distributed as what they replace.
  Sampler split(uint32_t i, uint32_t n) const {
    Sampler part = *this;
    part.reversedSample_ = detail::reverseBits(detail::reverseBits(reversedSample_) * n + i);
    part.rng_ = Rng(key_, part.reversedSample_, dimension_);
    return part;
  }
  // Other numbers, as well distributed.
  Sampler forked(uint64_t key) const {
    Sampler other = *this;
    other.key_ = static_cast<uint32_t>(mix64(key_ + key));
    other.rng_ = Rng(other.key_, reversedSample_, key);
    return other;
  }
  // Without stratification, for what would use up the good dimensions.
  float fast1() { return rng_.uniform(); }

 private:
  static constexpr uint32_t kStratifiedPairs = 24;
  uint32_t nextKey() { return mix32(key_ + 0x9e3779b9u * ++dimension_); }
  uint32_t firstOf(uint32_t key) const { return detail::laineKarras(reversedSample_, key); }
  static uint32_t scrambleFirst(uint32_t first, uint32_t key) {
    return detail::owenScramble(first, mix32(key ^ 0xa511e9b3u));
  }
  static float toUnit(uint32_t v) { return static_cast<float>(v >> 8) * 0x1p-24f; }
  Rng rng_;
  uint32_t key_, reversedSample_, dimension_ = 0;
};

}  // namespace roomlight
