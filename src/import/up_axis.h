// Which axis of a scene points up, where the file does not say it.
#pragma once

#include <optional>
#include <string>

#include "import/warnings.h"
#include "scene/scene.h"

namespace roomlight::importers {

enum class UpAxis : char {
  X = 'x',
  Y = 'y',
  Z = 'z',
};

// From the geometry as its file has it: `usual` unless the other one of y and z is clearly right. One look at every
// triangle.
UpAxis guessUpAxis(const Scene& scene, float metresPerUnit, UpAxis usual);

// Turns a scene so that what was up in its file is +y: instances, lamps, suns and cameras.
void turnUpright(Scene& scene, UpAxis up);

// Both, for formats that do not say it: `wanted` decides where it is given ('x', 'y' or 'z'). A guess other than y is
// told.
void standUpright(Scene& scene, std::optional<char> wanted, float metresPerUnit, UpAxis usual, Warnings& warnings);

}  // namespace roomlight::importers
