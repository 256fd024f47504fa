// Places on the simplified home, put back on the home as it is.
#pragma once

#include "bake/lit_places.h"

namespace roomlight::bake {

// The home is lit as it is, and only drawn simplified. Each place of a mesh that has lost triangles moves along its
// normal onto the side of the same instance that is nearest, if there is one within `mostM`: a place left inside a
// thing would be dark. Places of texels take its normal too, which simplified triangles interpolate wrongly. `home` and
// `simplified` have the same instances.
void putOnHome(LitPlaces& lit, const RayScene& home, const Scene& simplified, float mostM);

}  // namespace roomlight::bake
