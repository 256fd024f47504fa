// What the parts of a home are added to, and how their surfaces become meshes.
#pragma once

#include <map>
#include <string>

#include "import/sh3d_effort.h"
#include "import/sh3d_home.h"
#include "import/warnings.h"
#include "scene/scene.h"

namespace roomlight::importers::sh3d {

struct Draft {
  Scene& scene;
  Warnings& warnings;
  Effort effort = Effort();
  int object = 0;  // the first free number
  std::vector<Lamp> offLamps = {};  // see Imported
};

// Plan and height in cm to the world in metres: x right, y up, z along the plan's y, towards the viewer.
inline Vec3 toWorld(PlanPoint p, double heightCm) {
  return {static_cast<float>(p.x / 100), static_cast<float>(heightCm / 100), static_cast<float>(p.y / 100)};
}

struct SurfaceCorner {
  Vec3 position;
  Vec2 uv;  // in metres
};

// The surfaces of one thing: a wall, a room's floor. Corners are turned so that the front looks along `front`. Throws
// Failure that names `place` where the home would become too fine.
class Surfaces {
 public:
  Surfaces(Effort& effort, std::string place) : effort_(effort), place_(std::move(place)) {}

  void triangle(int material, SurfaceCorner a, SurfaceCorner b, SurfaceCorner c, Vec3 front);
  void quad(int material, const SurfaceCorner (&corners)[4], Vec3 front);  // cut from corner 0 to 2

  // Before so many triangles are made, for a message that says how many; they count as they are added.
  void ask(size_t triangles) const { effort_.ask(triangles, place_); }
  // The area in triangles, asked for.
  std::vector<PlanTriangle> cut(const PlanArea& area) const;

  // Operations that count as effort. Neither area crosses itself.
  void unite(PlanArea& area, const PlanArea& more);
  PlanArea without(const PlanArea& area, const PlanArea& holes);
  void spend(size_t units) { effort_.spend(units, place_); }

  // Moves everything into the scene as the draft's next object. `label`: what people call it; empty: its name.
  void finish(const Draft& draft, const std::string& name, const std::string& label = {});

 private:
  Effort& effort_;
  std::string place_;
  std::map<int, Mesh> meshes_;
};

}  // namespace roomlight::importers::sh3d
