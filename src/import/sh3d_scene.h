// A home that was read, as a scene.
#pragma once

#include "import/import.h"
#include "import/sh3d_archive.h"
#include "import/sh3d_content.h"
#include "import/sh3d_home.h"
#include "import/warnings.h"

namespace roomlight::importers::sh3d {

// Walls, rooms, furniture, lights, lines, cameras, daylight and ground. Models and pictures are entries of `archive`.
// Throws Failure. `daylight`: see Imported.
Scene sceneOfHome(const Home& home, const Archive& archive, const ContentDigests& digests, const ImportOptions& options,
                  Warnings& warnings, std::string& daylight);

}  // namespace roomlight::importers::sh3d
