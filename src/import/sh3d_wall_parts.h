// What walls are made of: outlines on the plan, holes of doors and windows, baseboards.
#pragma once

#include <cmath>
#include <span>
#include <string>
#include <vector>

#include "import/sh3d_draft.h"
#include "import/sh3d_effort.h"
#include "import/sh3d_home.h"
#include "import/sh3d_paints.h"
#include "import/warnings.h"

namespace roomlight::importers::sh3d {

// The plan of walls: both sides as polylines, cut or prolonged where walls are joined.

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

// What people call each wall: by the room on either side of it and, where it is one room's alone, by the side of the
// room that it stands on, if the home says where north is. No two are the same. Of home plans that are too large to
// look for rooms, by numbers alone.
std::vector<std::string> wallLabels(const Home& home, const std::vector<WallOutline>& outlines);

// Where doors and windows cut walls.

// A hole that is pushed through walls at a right angle to the piece's width. Coordinates of its frame: u along the
// width, v along the depth, both measured from the plan's origin, h above the ground; in cm.
struct Opening {
  PlanPoint along{1, 0};           // unit: the axis u; v is a quarter turn clockwise on the plan
  double vLow = 0, vHigh = 0;      // how deep the piece reaches
  bool bothSides = false;  // cuts both sides of a straight wall within a degree of its own direction, of any round one
  double reachCm = 1;  // what ends this close to a wall's side cuts it
  PlanArea shape;  // of (u, h)
  size_t points = 0;  // of the shape; more where cutting it is more work than that of as many points
  PlanPoint centre;  // on the plan, with all of the piece within
  double radiusCm = 0;

  double u(PlanPoint p) const { return p.x * along.x + p.y * along.y; }
  double v(PlanPoint p) const { return p.y * along.x - p.x * along.y; }
};

// Of all doors and windows, whether they are bound to a wall or not, with their whole width and height: as Sweet Home
// 3D 7 draws them. What the file says about the part in the wall is for its plan. Throws Failure.
std::vector<Opening> openingsOf(const Home& home, Effort& effort, Warnings& warnings);

// Rings of an SVG path in the unit square, x to the right and y down, curves as chords; empty where it cannot be read.
PlanArea svgPath(const std::string& path);

// Holes in one wall.

// A flat piece of a wall's side between two corners of its outline, seen from outside the wall.
struct Panel {
  PlanPoint a, b;
  double baseCm = 0, topACm = 0, topBCm = 0;
  bool isEnd = false;  // the wall's face at its start or end instead: openings cut it whatever its direction
  double lengthCm() const;
  PlanRing outline() const;  // of (distance from a, height)
  PlanPoint at(double distanceCm) const {
    const double t = distanceCm / lengthCm();
    return {a.x + (b.x - a.x) * t, a.y + (b.y - a.y) * t};
  }
};

struct WallSides {
  std::vector<Panel> left, right;
  bool straight = true;
};

// Openings of one wall that run in the same direction and overlap in depth, as one.
struct WallCut {
  Opening opening;  // of (u, h): what is cut out of both sides, or of the one that a niche is in
  WallSides
      sides;  // where one side ends earlier than the other along the opening, the wall's slanted end goes on with it
  bool throughLeft = true, throughRight = true;  // which sides it cuts; one only: a niche, whose back lies at `backV`
  double backV = 0;

  size_t panels() const { return sides.left.size() + sides.right.size(); }

  // What this cut takes from a panel, of (distance from a, height).
  PlanArea holeIn(const Panel& panel) const;
  // The same of the wall's face at its start or end, which may stand at a right angle to the opening.
  PlanArea holeInEnd(const Panel& panel) const;
  // Where the opening ends at u: on the side's surface, or at the niche's back.
  PlanPoint onLeft(double u) const { return throughLeft ? on(sides.left, u) : back(u); }
  PlanPoint onRight(double u) const { return throughRight ? on(sides.right, u) : back(u); }
  PlanPoint back(double u) const {
    return {u * opening.along.x - backV * opening.along.y, u * opening.along.y + backV * opening.along.x};
  }

 private:
  PlanPoint on(const std::vector<Panel>& side, double u) const;
};

// Cuts with something in them. Openings that end less than 1 cm inside a wall go through. Straight walls across
// them (more than 60 degrees) lose what stands in the piece, if the opening is a rectangle; parts of round walls do
// not. Throws Failure that names `place` where that is more work than any home's.
std::vector<WallCut> cutsOf(const WallSides& sides, std::span<const Opening> openings, Effort& effort,
                            const std::string& place);

// Baseboards along walls.

struct WallHeights {
  double baseCm = 0, floorCm = 0;  // of the wall's body and of its level
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
