// Collects a home's surfaces as meshes, one for each material of a thing.
#pragma once

#include <map>
#include <string>

#include "import/sh3d_home.h"
#include "scene/scene.h"

namespace roomlight::importers::sh3d {

// Plan and height in cm to the world in metres: x right, y up, z along the plan's y, towards the viewer.
inline Vec3 toWorld(PlanPoint p, double heightCm) {
  return {static_cast<float>(p.x / 100), static_cast<float>(heightCm / 100), static_cast<float>(p.y / 100)};
}

struct SurfaceCorner {
  Vec3 position;
  Vec2 uv;  // in metres
};

// The surfaces of one thing: a wall, a room's floor. Corners are turned so that the front looks along `front`.
class Surfaces {
 public:
  void triangle(int material, SurfaceCorner a, SurfaceCorner b, SurfaceCorner c, Vec3 front);
  void quad(int material, const SurfaceCorner (&corners)[4], Vec3 front);  // cut from corner 0 to 2

  // Moves everything into the scene as one new object.
  void finish(Scene& scene, const std::string& name, int object);

 private:
  std::map<int, Mesh> meshes_;
};

}  // namespace roomlight::importers::sh3d
