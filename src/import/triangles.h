// What importers do with triangles of any format.
#pragma once

#include "scene/scene.h"

namespace roomlight::importers {

// Removes triangles without area, which no later stage can shade. Returns how many. Indices must be in range.
size_t dropDegenerate(Mesh& mesh);

}  // namespace roomlight::importers
