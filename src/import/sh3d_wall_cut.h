// Holes in one wall.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "import/sh3d_openings.h"

namespace roomlight::importers::sh3d {

// A flat piece of a wall's side between two corners of its outline, seen from outside the wall.
struct Panel {
  PlanPoint a, b;
  double baseCm = 0, topACm = 0, topBCm = 0;
  bool isEnd = false;        // the wall's face at its start or end instead: openings cut it whatever its direction
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

}  // namespace roomlight::importers::sh3d
