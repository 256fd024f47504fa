// Where doors and windows cut walls.
#pragma once

#include <vector>

#include "import/sh3d_effort.h"
#include "import/sh3d_home.h"
#include "import/warnings.h"

namespace roomlight::importers::sh3d {

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

}  // namespace roomlight::importers::sh3d
