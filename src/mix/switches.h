// Lamps that are switched on and off, over what shines in every state.
#pragma once

#include <cstdint>
#include <string>

#include "mix/layer_stack.h"

namespace roomlight {

struct Switches {
  std::vector<Vec3> gains;    // of every layer, as it shines when it shines
  std::vector<size_t> lamps;  // layers that are switched; bit i of a mask says whether lamps[i] is on
};

constexpr size_t kMostSwitchedLamps = 16;  // 65536 states

// Gains of a state: those of switched lamps that are off are 0.
std::vector<Vec3> gainsOfState(const Switches& switches, uint64_t mask);

// The masks of all states in the order of the reflected Gray code, beginning with all off: each differs from the one
// before in one lamp.
std::vector<uint32_t> allStates(size_t lampCount);

// '1' or '0' a lamp, the first lamp first: a name that does not change when pictures are made anew.
std::string stateName(uint32_t mask, size_t lampCount);

}  // namespace roomlight
