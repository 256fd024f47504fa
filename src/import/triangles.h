// What importers do with triangles of any format.
#pragma once

#include "scene/scene.h"

namespace roomlight::importers {

// Removes triangles without area: nobody sees them, and no later stage can shade them. Indices must be in range.
// Returns how many.
size_t dropDegenerate(Mesh& mesh);

// Removes triangles with a vertex that is not finite or beyond 1e12, and puts such vertices at the origin. Returns how
// many.
size_t dropInfinite(Mesh& mesh);

}  // namespace roomlight::importers
