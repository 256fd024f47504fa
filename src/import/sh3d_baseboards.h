// Baseboards along walls.
#pragma once

#include <cmath>
#include <span>
#include <vector>

#include "import/sh3d_paints.h"
#include "import/sh3d_surfaces.h"
#include "import/sh3d_wall_cut.h"
#include "import/sh3d_wall_outline.h"

namespace roomlight::importers::sh3d {

struct WallHeights {
  double baseCm = 0, floorCm = 0;             // of the wall's body and of its level
  std::vector<double> leftTopCm, rightTopCm;  // at every corner of its sides
  bool levelTop() const { return std::abs(leftTopCm.front() - leftTopCm.back()) < 1e-3; }
};

// The outlines' distances from the walls' axes with the baseboards on them.
std::vector<WallOffsets> baseboardOffsets(const Home& home);

// A wall as it stands in the home.
struct StandingWall {
  const Wall& wall;
  const WallOutline& outline;  // of its body on the plan, cm
  const WallHeights& heights;
  std::span<const WallCut> cuts;  // what openings take from it
};

// Adds the baseboards of both sides, which stand between the wall's outline and `boards`, that of the wall with them,
// without what openings cut away. They have their own paint, or that of their side.
void addBaseboards(const StandingWall& standing, const WallOutline& boards, Paints& paints, Surfaces& out);

}  // namespace roomlight::importers::sh3d
