// What the plan of a home draws: walls, rooms and lines.
#pragma once

#include <optional>

#include "import/sh3d_draft.h"
#include "import/sh3d_home.h"
#include "import/sh3d_paints.h"

namespace roomlight::importers::sh3d {

// Every wall on a shown level becomes an object: both sides, top, bottom and ends, with the reveals of its openings and
// its baseboards. Walls of upper levels reach down through the slab of their floor. Throws Failure.
void addWalls(const Home& home, Paints& paints, Draft& draft);

// Floors and ceilings of the rooms on shown levels as objects, and Scene::rooms. Where rooms at one height overlap, the
// later one of the file lies on top: the earlier one is cut. Stairs with a cut-out shape cut the floor that they come
// up through and the ceiling that they leave by. On the highest level ceilings follow the tops of the walls, unless
// they are flat; below it they lie at the level's height. Rooms whose outline is a tangle are left out with a warning.
// Throws Failure.
void addRooms(const Home& home, Paints& paints, Draft& draft);

// The room on the plan, without crossings; none where it is a tangle (Effort::untangles).
std::optional<PlanArea> outlineOf(const Room& room, Effort& effort);

// Flat bands of the line's thickness on its elevation, at least 0.5 mm above its level's; square at ends and corners.
// Throws Failure.
void addPolylines(const Home& home, Paints& paints, Draft& draft);

}  // namespace roomlight::importers::sh3d
