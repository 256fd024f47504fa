// Which sides of a home's triangles people can see from inside its rooms: what no eye meets needs no light.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "trace/ray_scene.h"

namespace roomlight::bake {

// By instance and triangle of its mesh.
class SeenSides {
 public:
  explicit SeenSides(const Scene& scene);
  bool seen(uint32_t instance, uint32_t triangle, bool back) const {
    return (sides_[first_[instance] + triangle] & (back ? 2 : 1)) != 0;
  }
  void mark(uint32_t instance, uint32_t triangle, bool back);  // from many threads

 private:
  std::vector<size_t> first_;   // of each instance
  std::vector<uint8_t> sides_;  // bit 0: the side from which it is counter-clockwise in the world, bit 1: the other
};

// Whether a ray of that direction meets the side from which the triangle is clockwise in the world.
bool meetsBack(const Scene& scene, const Hit& hit, Vec3 direction);

// Cameras that look as eyes do: from inside a room, of a scene without rooms all; and the one in use, which may look
// into a box from where its front is open, but not one that cuts the home open.
std::vector<Camera> camerasInside(const Scene& scene);
// The number of the scene's own camera among those; else the first.
size_t cameraInUse(const Scene& scene, const std::vector<Camera>& cameras);

// The cameras inside, and places at the height of eyes and hips in every room of the scene, where people can stand.
std::vector<Vec3> eyesIn(const RayScene& rays);

// By `count` rays from the eyes in all directions, which go on through panes and whatever lets light pass; then by rays
// to each side that was not met, from eyes that saw something near: a leaf in the garden is too small to be met by
// chance. Does not depend on the number of threads.
SeenSides seenFrom(const RayScene& rays, std::span<const Vec3> eyes, size_t count);

}  // namespace roomlight::bake
