// The lamps of a lighting file.
#pragma once

#include "import/json_reader.h"
#include "import/photometric_file.h"
#include "scene/scene.h"

namespace roomlight::importers {

// `number`: its place in the list, from 0; a lamp without a name is called by it.
// Photometric files go by absolute path or relative to `folder`.
Lamp readLamp(const JsonPlace& j, size_t number, const std::filesystem::path& folder, PhotometricFiles& files);

}  // namespace roomlight::importers
