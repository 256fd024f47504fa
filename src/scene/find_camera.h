// The camera that somebody means.
#pragma once

#include <string>

#include "base/result.h"
#include "scene/scene.h"

namespace roomlight {

// By name, else by its number in the file from 0; empty: the default one. The error names those there are.
Result<Camera> findCamera(const Scene& scene, const std::string& wanted);

}  // namespace roomlight
