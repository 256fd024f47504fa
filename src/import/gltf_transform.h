// Transforms of glTF nodes and instances.
#pragma once

#include "base/vec.h"
#include "import/gltf_json.h"

namespace roomlight::importers {

struct Quaternion {
  double x = 0, y = 0, z = 0, w = 1;
};

// translation * rotation * scale; the quaternion need not be of unit length; one of length 0 turns nothing.
Affine composed(Vec3 translation, Quaternion rotation, Vec3 scale);

// A node's matrix, or translation, rotation and scale. Throws Failure.
Affine transformOf(const Json& node);

}  // namespace roomlight::importers
