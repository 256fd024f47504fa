// Is a scene safe to work on? Importers call this last, so that no later stage has to check again.
#pragma once

#include "base/result.h"
#include "scene/scene.h"

namespace roomlight {

// Errors: index out of range, array lengths that disagree, non-finite positions, normals, tangents, texture
// coordinates, transforms or light values, colours of vertices outside 0 to 1, negative light, cones of spots and discs
// of suns that are none, texture size that disagrees with its texels, transforms without inverse, instances whose
// bounds in the world are not finite, no triangle at all. The message names the place as "mesh 3 'chair': ...".
Status validate(const Scene& scene);

}  // namespace roomlight
