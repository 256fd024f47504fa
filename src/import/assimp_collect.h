// What is taken from a scene of the library assimp.
#pragma once

#include "import/assimp_model.h"

struct aiScene;

namespace roomlight::importers {

// In the child process, where the library is called: nothing of the scene is believed later. Throws Failure.
ForeignModel collectForeign(const aiScene& scene, AssimpFormat format, size_t maxTriangles);

}  // namespace roomlight::importers
