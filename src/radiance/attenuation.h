// How much of a lamp's light a voxel's surface of mean normal n takes up from unit direction l towards the lamp.
#pragma once

#include "radiance/radiance_field.h"

namespace roomlight {

// Normal-weighted: per axis the face that the normal picks, weighted with the squared normal; section 1 of the
// published study. Plain: Lambert's cosine.
inline float attenuation(Attenuation kind, Vec3 n, Vec3 l) {
  if (kind == Attenuation::Plain) return std::max(0.0f, dot(n, l));
  float sum = 0;
  for (int axis = 0; axis < 3; ++axis) sum += n[axis] * n[axis] * std::max(0.0f, n[axis] > 0 ? l[axis] : -l[axis]);
  return sum;
}

}  // namespace roomlight
