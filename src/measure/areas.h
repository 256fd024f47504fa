// Where no rooms are known: finds the places indoors where a person could stand, and parts them at walls.
#pragma once

#include <string>
#include <vector>

#include "measure/lattice.h"
#include "trace/ray_scene.h"

namespace roomlight {

// In a wardrobe, in a pillar? Five of six rays along the axes meet the backs of things smaller than a room; the sixth
// may meet the floor that the thing stands on.
bool insideThing(const RayScene& rays, Vec3 p);

// Cells whose middle is in a wardrobe say nothing of the room: they are no longer used. Returns how many.
size_t leaveOutThings(const RayScene& rays, Lattice& lattice);

struct Area {
  std::string name;      // "Area 1", the largest first
  float elevationM = 0;  // of the floor
  double areaM2 = 0;
  Lattice points;        // workPlaneM above the floor, spaced and kept from the walls as `settings` say
  Lattice map;           // the same up to the walls and finer, for a picture of the light
};

// A floor is a level that many rays from above end on with 1.9 m of room and a ceiling over it. Areas are parted by
// what stands 2.2 m above the floor, where doors have ended. Costs some hundred thousand rays.
std::vector<Area> findAreas(const RayScene& rays, double workPlaneM, const GridSettings& settings);

}  // namespace roomlight
