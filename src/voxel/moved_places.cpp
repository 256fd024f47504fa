#include "voxel/voxelise.h"

#include <map>

namespace roomlight {
namespace {

float areaM2(const Bounds3& b) {
  const Vec3 s = b.size();
  return s.x * s.y + s.y * s.z + s.z * s.x;
}

std::map<int, Bounds3> placesOf(const Voxelisation& voxels, const Scene& scene, std::span<const uint32_t> instances) {
  std::map<int, Bounds3> places;
  for (const uint32_t i : instances) {
    const Bounds3& b = voxels.instanceBounds[i];
    if (!b.empty()) places[scene.instances[i].object].add(b);
  }
  return places;
}

}  // namespace

std::vector<Bounds3> followMoves(Voxelisation& voxels, const Scene& scene, const SceneChange& change) {
  std::map<int, Bounds3> places = placesOf(voxels, scene, change.moved);
  std::vector<uint32_t> changed = change.moved;
  changed.insert(changed.end(), change.glow.begin(), change.glow.end());
  update(voxels, scene, changed);
  std::vector<Bounds3> out;
  for (const auto& [object, now] : placesOf(voxels, scene, change.moved)) {
    const auto before = places.find(object);
    Bounds3 both = now;
    if (before != places.end()) both.add(before->second);
    // Rays are tested against every box: two that lie over each other are one.
    if (before != places.end() && areaM2(both) > areaM2(now) + areaM2(before->second)) {
      out.push_back(now);
    } else {
      out.push_back(both);
      places.erase(object);
    }
  }
  for (const auto& [object, left] : places) out.push_back(left);
  return out;
}

}  // namespace roomlight
