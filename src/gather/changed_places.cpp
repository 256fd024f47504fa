#include "gather/changed_places.h"

#include <algorithm>
#include <array>
#include <map>

namespace roomlight {
namespace {

// Boxes that light may have changed beside: looking through more of them for every pixel costs more than new light
// does, and while no frame is made there is no end to them.
constexpr size_t kMostNear = 32;

Bounds3 boundsOf(const Scene& scene, uint32_t instance) {
  const Instance& i = scene.instances[instance];
  Bounds3 out;
  for (const Vec3 p : scene.meshes[static_cast<size_t>(i.mesh)].positions) out.add(i.worldFromObject.point(p));
  return out;
}

bool isWithin(const Bounds3& b, Vec3 p, float m) { return minComponent(min(p - b.lo, b.hi - p)) >= -m; }

// Whether the way from p along d, as far as `most` times its length, goes through a box.
bool isMet(const Bounds3& b, Vec3 p, Vec3 d, float most) {
  float first = 0, last = most;
  for (int c = 0; c < 3; ++c) {
    const float inverse = 1 / (std::abs(d[c]) > 1e-12f ? d[c] : 1e-12f), t0 = (b.lo[c] - p[c]) * inverse,
                t1 = (b.hi[c] - p[c]) * inverse;
    first = std::max(first, std::min(t0, t1)), last = std::min(last, std::max(t0, t1));
  }
  return first <= last;
}

}  // namespace

void ChangedPlaces::add(const SceneChange& change, const Scene& scene,
                        const std::function<void(std::vector<Bounds3>&)>& addSeen) {
  const auto shines = [&](uint32_t i) {
    return !isBlack(
        scene.materials[static_cast<size_t>(scene.meshes[static_cast<size_t>(scene.instances[i].mesh)].material)]
            .emission);
  };
  lightsChanged_ |= change.lamps || change.daylight || !change.glow.empty() ||
                    std::any_of(change.moved.begin(), change.moved.end(), shines);
  moved_.resize(scene.instances.size());
  places_.resize(scene.instances.size());
  for (const uint32_t i : change.moved) moved_[i] = 1, anyMoved_ = true;
  std::vector<Bounds3> seen(moved_.size());
  for (const auto& [i, place] : change.before) seen[i] = place;
  if (std::any_of(change.moved.begin(), change.moved.end(),
                  [&](uint32_t i) { return places_[i].empty() && seen[i].empty(); }))
    addSeen(seen);
  std::map<int, std::array<Bounds3, 2>> things;  // before and now
  for (const uint32_t i : change.moved) {
    auto& thing = things[scene.instances[i].object];
    thing[0].add(places_[i].empty() ? seen[i] : places_[i]);
    places_[i] = boundsOf(scene, i);
    thing[1].add(places_[i]);
  }
  for (const auto& [object, both] : things) {
    for (const Bounds3& b : both) {
      if (!b.empty()) near_.push_back(b);
    }
  }
  if (near_.size() > kMostNear) near_.clear(), lightsChanged_ = true;
}

void ChangedPlaces::lightBy(const Lights& lights, std::span<const uint32_t> emissive) {
  casters_.clear();
  for (size_t i = 0; i < lights.lampCount(); ++i) casters_.push_back({lights.lamp(i).position, false});
  for (size_t i = 0; i < lights.sunCount(); ++i) casters_.push_back({lights.sampleSun(i, {0.5f, 0.5f}).wi, true});
  for (const uint32_t i : emissive) {
    if (const int32_t e = lights.emitterOf(i); e >= 0)
      casters_.push_back({lights.emitterBounds(static_cast<size_t>(e)).centre(), false});
  }
}

bool ChangedPlaces::concern(Vec3 p, float nearM) const {
  if (lightsChanged_) return true;
  return std::any_of(near_.begin(), near_.end(), [&](const Bounds3& b) {
    if (isWithin(b, p, nearM)) return true;
    return std::any_of(casters_.begin(), casters_.end(), [&](const Caster& c) {
      return isMet(b, p, c.far ? c.place : c.place - p, c.far ? kInfinity : 1);
    });
  });
}

void ChangedPlaces::forget() {
  near_.clear();
  std::fill(moved_.begin(), moved_.end(), uint8_t{0});
  lightsChanged_ = anyMoved_ = false;
}

}  // namespace roomlight
