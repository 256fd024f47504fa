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
  float stepFactor = 1;
  float lambda = 0;
};

// Where a cone begins: on the surface with unit normal `normal`, a little in front of it.
struct ConeStart {
  Vec3 origin, normal;
};

// Marches along unit `d`. `levelShift` (0..1) blends between levels over many cones. While the cone is no wider than base
// voxels it meets the slots' own planes (near_march.h); further out it samples the pyramid, whose opacity is corrected for
// the length of a step.
ConeLight marchCone(const Voxels& voxels, const RadianceField& field, const ConeStart& from, Vec3 d, const ConeShape& shape, float levelShift);

}  // namespace roomlight
