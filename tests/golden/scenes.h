// The rooms of the golden tests, drawn in code.
#pragma once

#include <string>
#include <vector>

#include "scene/scene.h"

namespace roomlight::test {

struct GoldenScene {
  std::string name;  // of its file in tests/golden/data
  Scene scene;
  Camera camera;
};

// "boxes": a closed room of coloured walls, two boxes, a lamp at the ceiling.
// "window": a room by day: a pane, sky and sun behind it.
// "lamps": a point lamp, a spot and a panel over a brushed metal ball, a glass box and a glossy, tiled floor.
std::vector<GoldenScene> goldenScenes();

// For each light its name and the scene with that light alone brighter by `factor`.
std::vector<std::pair<std::string, Scene>> withOneLightBrighter(const Scene& scene, float factor);

}  // namespace roomlight::test
