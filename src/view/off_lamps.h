// Lamps that are off when a home is opened, made ready to be switched on.
#pragma once

#include <cstdint>
#include <vector>

#include "home/open_home.h"
#include "view/home.h"

namespace roomlight::view {

struct OffLamps {
  KindsOff kinds;  // of the document, whose light is back in the scene
  std::vector<uint8_t> lamps, instances;  // of the scene: 1 for what those kinds keep off
  std::vector<uint8_t> assumed;           // of the scene's lamps: 1 where nobody says how much light it gives
};

// Gives every lamp of the home and of the lighting file the light that it would have: in the scene all of them shine
// then, and markOff() and stateOfFile() tell which are off. Lamps that the home itself has off are added to the
// document, as its last ones. A kind stays off where it is only a part of a lamp that shines otherwise.
OffLamps bringBackLamps(home::OpenedHome& opened, LightingSource& source);

// Tells the home, which was made of that scene, which of its lamps these are.
void markOff(const OffLamps& off, ViewHome& home);

}  // namespace roomlight::view
