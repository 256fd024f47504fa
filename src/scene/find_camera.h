// The camera that somebody means.
#pragma once

#include <string>

#include "base/result.h"
#include "scene/scene.h"

namespace roomlight {

// By name; else by its number in the file from 0; else by its name in capital or small letters, or its beginning, where
// only one fits. Empty: the default one. The error names the nearest and those there are.
Result<Camera> findCamera(const Scene& scene, const std::string& wanted);

}  // namespace roomlight
