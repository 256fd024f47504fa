// Directional pyramid from the light on slots, and cones through it.
#pragma once

#include <span>

#include "radiance/radiance_field.h"

namespace roomlight {

// Fills field.levels and field.unitCdM2 from the radiance that each slot sends out (cd/m² per channel). `slotGlow`,
// empty or per slot, comes on top of it and is kept by LampGlow too: only the base level shows it.
void buildPyramid(const Voxels& voxels, std::span<const Vec3> slotRadiance, std::span<const Vec3> slotGlow,
                  RadianceField& field);

// One cone through the light in voxels.
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
