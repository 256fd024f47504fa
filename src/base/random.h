// Deterministic random numbers: a stream is keyed by (pixel, sample, seed), so results do not depend on the order in
// which threads reach a pixel. PCG32 (O'Neill 2014) seeded through a 64-bit mix (splitmix64 finaliser, Steele 2014).
#pragma once

#include <cstdint>

#include "base/vec.h"

namespace roomlight {

inline uint64_t mix64(uint64_t v) {
  v ^= v >> 30, v *= 0xbf58476d1ce4e5b9ull;
  v ^= v >> 27, v *= 0x94d049bb133111ebull;
  return v ^ (v >> 31);
}

inline uint32_t mix32(uint32_t v) {  // lowbias32, Wellons 2018
  v ^= v >> 16, v *= 0x7feb352du;
  v ^= v >> 15, v *= 0x846ca68bu;
  return v ^ (v >> 16);
}

class Rng {
 public:
  Rng() : Rng(0, 0, 0) {}
  Rng(uint64_t pixel, uint64_t sample, uint64_t seed) {
    const uint64_t key = mix64(pixel + 0x9e3779b97f4a7c15ull * (seed + 1));
    state_ = mix64(key ^ mix64(sample + 0x632be59bd9b4e019ull));
    increment_ = mix64(key + sample * 0x9e3779b97f4a7c15ull) | 1u;
  }
  uint32_t bits() {
    const uint64_t old = state_;
    state_ = old * 6364136223846793005ull + increment_;
    const auto xorshifted = static_cast<uint32_t>(((old >> 18) ^ old) >> 27);
    const auto rot = static_cast<uint32_t>(old >> 59);
    return (xorshifted >> rot) | (xorshifted << ((32 - rot) & 31));
  }
  float uniform() { return static_cast<float>(bits() >> 8) * 0x1p-24f; }  // in [0, 1)
  Vec2 uniform2() {
    const float a = uniform();
    return {a, uniform()};
  }

 private:
  uint64_t state_, increment_;
};

}  // namespace roomlight
