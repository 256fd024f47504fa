// The program roomlight-model-reader: the one place where assimp is called. The library follows cycles and sizes that a
// hostile file claims; here that ends this program alone, which sees no file but the one it is given.
#pragma once

#include "import/foreign_import.h"

struct aiScene;

namespace roomlight::importers {

// Its main function. Arguments: an extension of kAssimpExtensions; "stated" for the axes that the file says, "own" for
// those it counts in; how many triangles all instances may have. stdin: the file. stdout: the model (toBytes), or with
// exit status 3 what is wrong. Does not return.
[[noreturn]] void modelReaderMain(int argc, char** argv);

// In that program, where the library is called: what is taken from its scene, which nobody believes later. Throws
// Failure.
ForeignModel collectForeign(const aiScene& scene, AssimpFormat format, size_t maxTriangles);

}  // namespace roomlight::importers
