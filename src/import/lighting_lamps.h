// The lamps of a lighting file.
#pragma once

#include "import/json_reader.h"
#include "scene/scene.h"

namespace roomlight::importers {

// `number`: its place in the list, from 0; a lamp without a name is called by it.
Lamp readLamp(const JsonPlace& j, size_t number);

}  // namespace roomlight::importers
