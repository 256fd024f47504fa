// What an edit of a scene concerns, so that what was worked out for it can follow; and a scene scaled or
// moved as a whole.
#pragma once

#include <cstdint>
#include <map>
#include <vector>

#include "base/vec.h"
#include "scene/scene.h"

namespace roomlight {

// What is other than before in a scene that was edited where it stands. Meshes, materials and instances are as many as
// before.
struct SceneChange {
  std::vector<uint32_t> moved;  // instances in other places, or of another mesh: one without triangles hides them
  std::vector<uint32_t> glow;   // instances whose material emits another light
  bool lamps = false;           // scene.lamps: dimmed, switched, coloured, moved, more or fewer
  bool daylight = false;        // scene.suns, scene.sky
  std::map<uint32_t, Bounds3>
      before{};  // boxes around where instances of `moved` were, m; those that are not here are not known
  bool any() const { return lamps || daylight || !moved.empty() || !glow.empty(); }
};

// A scene in another unit, or elsewhere. All lengths times s: placements, media, lamps, rooms and cameras. Meshes keep
// their own coordinates, lights their candela and lux.
void scaleScene(Scene& scene, float s);

// Everything that has a place, by this much.
void moveScene(Scene& scene, Vec3 by);

}  // namespace roomlight
