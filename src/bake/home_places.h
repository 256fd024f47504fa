// Places on the simplified home, put back on the home as it is.
#pragma once

#include <span>

#include "bake/lit_places.h"

namespace roomlight::bake {

// The home is lit as it is, and only drawn simplified. Each place of a mesh that was simplified moves along its normal
// onto the nearest side of the same instance that faces the same way, if there is one as near as twice what the mesh
// may have moved: a place left inside a thing would be dark. Places of texels take its normal too, which simplified
// triangles interpolate wrongly, unless it is more than 30° off: that of a groove is not that of a texel. `movedM`: of
// each mesh of the home.
void putOnHome(LitPlaces& lit, const RayScene& home, std::span<const float> movedM);

}  // namespace roomlight::bake
