// One cone through the light in voxels.
#pragma once

#include "radiance/radiance_field.h"

namespace roomlight {

struct ConeLight {
  Vec3 radiance;        // cd/m², mean over the cone, of surfaces met
  float left = 1;       // fraction of the cone that met nothing
  float occlusion = 0;  // as `1 - left`, each part multiplied with f(r) = 1 / (1 + lambda r)
};

struct ConeShape {
  float tanHalf;
  float lambda = 0;
  float pdf = 0;  // per steradian, of all cones that share a task with the points of LampGlow; 0: cones alone see glow
};

// Where a cone begins: on the surface with unit normal `normal`, a little in front of it.
struct ConeStart {
  Vec3 origin, normal;
};

// Follows unit `d` from voxel to voxel, on the level of the pyramid whose voxels are as wide as the cone. `levelShift`
// (0..1) blends between levels over many cones. Opacity counts once for each plane that is crossed, so it does not
// depend on the size of the steps.
ConeLight marchCone(const RadianceField& field, const ConeStart& from, Vec3 d, const ConeShape& shape,
                    float levelShift);

}  // namespace roomlight
