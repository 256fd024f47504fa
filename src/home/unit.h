// How long a unit of a scene is. Files say metres, or nothing, and mean millimetres or feet: the heights of rooms,
 // doors and tables tell.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "import/import.h"
#include "trace/ray_scene.h"

namespace roomlight::home {

// What a scene measures, in its own unit.
struct Proportions {
  float extent = 0;          // of the longest side
  float roomHeight = 0;      // between floors and ceilings of enclosed space; 0: none is enclosed
  float enclosedShare = 0;   // of the space over and under the scene's surfaces, 0 to 1
  std::vector<float>
      steps;  // heights above their floor of what stands on enclosed floors, one for each place looked at
  struct Thing {
    std::string name;
    Bounds3 bounds;
  };
  std::vector<Thing> things;  // objects that have a name
};

// Some ten thousand rays.
Proportions proportionsOf(const RayScene& rays);

struct UnitGuess {
  double metres = 1;    // of one unit
  const char* name = "metres";
  std::string because;  // "rooms would be 265 m high"; empty where it is metres
};

// The most likely among metres, centimetres, millimetres, inches and feet. Against a stated unit speak only sizes that
// cannot be.
UnitGuess guessUnit(const Proportions& proportions, StatedUnit stated);

}  // namespace roomlight::home
