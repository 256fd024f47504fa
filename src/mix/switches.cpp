#include "mix/switches.h"

namespace roomlight {

std::vector<Vec3> gainsOfState(const Switches& switches, uint64_t mask) {
  std::vector<Vec3> gains = switches.gains;
  for (size_t i = 0; i < switches.lamps.size(); ++i) {
    if (!((mask >> i) & 1)) gains[switches.lamps[i]] = Vec3(0);
  }
  return gains;
}

std::vector<uint32_t> allStates(size_t lampCount) {
  std::vector<uint32_t> states(size_t{1} << lampCount);
  for (uint32_t i = 0; i < states.size(); ++i) states[i] = i ^ (i >> 1);  // Gray 1953
  return states;
}

std::string stateName(uint32_t mask, size_t lampCount) {
  std::string name;
  for (size_t i = 0; i < lampCount; ++i) name += (mask >> i) & 1 ? '1' : '0';
  return name;
}

}  // namespace roomlight
