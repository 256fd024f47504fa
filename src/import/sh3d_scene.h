// A home that was read, as a scene.
#pragma once

#include "import/import.h"
#include "import/sh3d_archive.h"
#include "import/sh3d_content.h"
#include "import/sh3d_home.h"
#include "import/warnings.h"

namespace roomlight::importers::sh3d {

struct HomeScene {
  Scene scene;
  std::string daylight;        // see Imported
  std::vector<Lamp> offLamps;  // likewise
};

// Walls, rooms, furniture, lights, lines, cameras, daylight and ground. Models and pictures are entries of `archive`.
// Throws Failure.
HomeScene sceneOfHome(const Home& home, const Archive& archive, const ContentDigests& digests,
                      const ImportOptions& options, Warnings& warnings);

}  // namespace roomlight::importers::sh3d
