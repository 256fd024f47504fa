// One cone through the directional pyramid.
#pragma once

#include "radiance/half.h"
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

// Marches from `origin` along unit `d`. `shift` (each component in -0.5..0.5) moves the lattice for the whole cone, which turns
// nearest-voxel reads into filtered ones over many cones without ever stepping across a wall; `levelShift` (0..1) does the
// same between levels.
ConeLight marchCone(const RadianceField& field, Vec3 origin, Vec3 d, const ConeShape& shape, Vec3 shift, float levelShift);

}  // namespace roomlight
