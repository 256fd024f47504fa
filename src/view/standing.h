// What stands on what, or is fastened to it, and goes along when that is moved. Told by the meshes of a state alone, so
// that it follows every edit and every step back.
#pragma once

#include <vector>

#include "view/thing_shapes.h"

namespace roomlight::view {

// What goes along with a thing: other things, and lamps with a place of their own. In ascending order.
struct Load {
  std::vector<size_t> things, lamps;
};

// A thing stands on another if its lowest points are within 2 cm of surfaces of that, under half of them or on all
// sides of their middle. What stands on nothing belongs to the standing thing that it, or what it is joined to, touches
// or reaches into; what touches a wall or another thing that is not movable stays, and so does what only touches
// others and is within 10 cm of one. Hidden things count as if seen.
// A lamp belongs to the smallest thing around it.
Load findLoad(ThingShapes& shapes, size_t thing, const HomeState& state);

// Takes a load along that lay so on the thing in `from`, to where the thing is in `next`. `alone`: puts it back instead
// to where it was in `from`.
void carry(const EditableHome& home, const Load& load, size_t thing, bool alone, const HomeState& from,
           HomeState& next);

}  // namespace roomlight::view
