// The plan of walls: both sides as polylines, cut or prolonged where walls are joined.
#pragma once

#include <vector>

#include "import/sh3d_home.h"

namespace roomlight::importers::sh3d {

// From start to end, as many corners on both sides: 2, or more on a round wall. In cm.
struct WallOutline {
  PlanRing left, right;
  PlanRing ring() const;  // around the wall, from the start of its left side
};

// How far the sides lie from the walls' axes, for outlines that are thicker than the wall (baseboards).
struct WallOffsets {
  double leftCm = 0, rightCm = 0;
};

// How many chords a wall's sides have: 1 where it is straight, 0 where it has no length.
size_t chordsOf(const Wall& wall, WallOffsets offsets);

// One outline a wall; those without length, or on a level that is not shown, have none (empty sides). Round walls are
// cut into chords that leave the arc by at most 1 mm, with their corners on it. Where two walls name each other, each
// side ends at its intersection with the neighbour's, unless that lies farther away than twice the wall's own
// thickness: so are sharp corners kept from growing spikes.
std::vector<WallOutline> wallOutlines(const Home& home, const std::vector<WallOffsets>& offsets);
std::vector<WallOutline> wallOutlines(const Home& home);  // of the bare walls

// Height of the wall's top above its level there: a plane that rises along the line from start to end, of a round wall
// along its chord.
double wallHeightCm(const Home& home, const Wall& wall, PlanPoint at);

}  // namespace roomlight::importers::sh3d
