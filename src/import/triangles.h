// What importers do with triangles of any format.
#pragma once

#include "scene/scene.h"

namespace roomlight::importers {

// Removes triangles without area: nobody sees them, and no later stage can shade them. Indices must be in range.
void dropDegenerate(Mesh& mesh);

}  // namespace roomlight::importers
