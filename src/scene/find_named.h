// The camera or the room that somebody means: by name; else by its number from 0; else by its name in capital or small
// letters, or its beginning, where only one fits. The error names the nearest and those there are.
#pragma once

#include <span>
#include <string>

#include "base/result.h"
#include "scene/scene.h"

namespace roomlight {

// Empty: the default one.
Result<Camera> findCamera(const Scene& scene, const std::string& wanted);

// Its number among `rooms`.
Result<size_t> findRoom(std::span<const Room> rooms, const std::string& wanted);

}  // namespace roomlight
