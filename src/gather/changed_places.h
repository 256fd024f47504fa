// What has changed in a scene since the frame before, as far as frames that reuse light must know: what moved, and
 // where light is another.
#pragma once

#include <algorithm>
#include <functional>
#include <span>
#include <vector>

#include "scene/scene.h"
#include "scene/scene_change.h"
#include "trace/lights.h"

namespace roomlight {

// Whether a camera that went so far between two frames, and sees things at such a distance (the median), has jumped,
// and not just moved on: then nothing of the frame before counts.
inline bool hasJumped(float movedM, float distanceM) {
  constexpr float kLeastM = 0.5f, kOfDistance = 0.5f;
  return movedM > std::max(kLeastM, kOfDistance * distanceM);
}

class ChangedPlaces {
 public:
  // `addSeen` adds to the box of each instance what was seen of it: where things were that move for the first time,
  // unless the change tells. After many changes without a frame light counts as changed everywhere.
  void add(const SceneChange& change, const Scene& scene, const std::function<void(std::vector<Bounds3>&)>& addSeen);
  // Light of the scene as it is now: where things that moved throw shadows, or did, light has changed.
  // `emissive`: instances of emissive meshes that throw sharp ones too.
  void lightBy(const Lights& lights, std::span<const uint32_t> emissive = {});

  bool lightsChanged() const { return lightsChanged_; }  // everywhere
  bool anyMoved() const { return anyMoved_; }
  bool hasMoved(uint32_t instance) const { return anyMoved_ && moved_[instance]; }
  bool any() const { return lightsChanged_ || anyMoved_ || !near_.empty(); }
  // Whether light may be another there: beside what moved, or where a line to a lamp or a sun meets its box.
  bool concern(Vec3 p, float nearM) const;

  void forget();  // the frame has been made

 private:
  struct Caster {
    Vec3 place;
    bool far;  // a direction
  };
  std::vector<Bounds3> places_, near_;  // of instances that moved, when they last did; where light has changed
  std::vector<uint8_t> moved_;          // a flag an instance
  std::vector<Caster> casters_;
  bool lightsChanged_ = false, anyMoved_ = false;
};

}  // namespace roomlight
