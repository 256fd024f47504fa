// A hash of all that a scene holds.
#pragma once

#include <string>

#include "scene/scene.h"

namespace roomlight::optimise {

// 64 bits in hexadecimal. Every member of every struct counts, those of lamps' photometric webs too.
std::string hashOfScene(const Scene& scene);

}  // namespace roomlight::optimise
