// How much of a plane lies inside a voxel.
#pragma once

#include "base/vec.h"

namespace roomlight {

// Area that the plane n . x = offset cuts out of the unit cube 0..1; n unit.
double planeAreaInUnitCube(Vec3 n, double offset);

}  // namespace roomlight
