// Whether a meter stands where one belongs.
#pragma once

#include <cstdint>
#include <vector>

#include "measure/lattice.h"
#include "trace/ray_scene.h"

namespace roomlight {

enum class MeterPlace : uint8_t {
  Free,
  Furniture,
  Wall,       // or a floor or ceiling
  Outdoors
};  // beyond the building's shell

const char* placeName(MeterPlace place);  // "free", "furniture", "wall", "outdoors"

// In furniture: as insideThing() has it, or all around within 1.2 m is one thing, such as a fridge. In a wall: between
// the backs of two parallel faces at most 0.65 m apart, with hardly a front to be seen; what is small and solid is a
// wall if it is 2.2 m high and 2 m long. Outdoors: no roof above and at least 7 of 16 level rays meet nothing, or 9 of
// them under a roof. Costs at most 24 rays.
MeterPlace placeOf(const RayScene& rays, Vec3 p);

// A cell whose reading would say nothing of the room.
struct LeftOutCell {
  size_t cell = 0;  // of the lattice
  MeterPlace place = MeterPlace::Furniture;
};

// Takes cells in furniture and in walls out of use, and those outdoors where some others are not. `outdoors`: all that
// are free are; they stay in use. Without `roofs` nothing is outdoors: the model has no ceilings.
struct LatticePlaces {
  std::vector<LeftOutCell> leftOut;
  bool outdoors = false;
};
LatticePlaces leaveOutMisplaced(const RayScene& rays, MeterGrid& lattice, bool roofs);

// Over how many of the used cells something of the scene stands.
size_t cellsUnderRoof(const RayScene& rays, const MeterGrid& lattice);

}  // namespace roomlight
