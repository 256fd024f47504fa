// Tells whether a scene is the same as before.
#pragma once

#include <string>

#include "scene/scene.h"

namespace roomlight {

// A hash of all that a scene holds, as Hash::text(). Every member of every struct counts, those of lamps' photometric
// webs too.
std::string hashOfScene(const Scene& scene);

}  // namespace roomlight
