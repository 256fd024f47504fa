// Questions about where the meshes of a home's things are in a state: whether two touch, what is under a point.
#pragma once

#include <memory>
#include <vector>

#include "scene/triangle_tree.h"
#include "view/editable.h"

namespace roomlight::view {

// Refers to home and scene, which must stay. What is asked is kept: not for several threads at once.
class ThingShapes {
 public:
  // `atRest`: the scene as the home was found in it.
  ThingShapes(const EditableHome& home, const Scene& atRest);

  const EditableHome& home() const { return home_; }
  Bounds3 boundsIn(size_t thing, const HomeState& state) const;
  // Around all things at rest.
  const Bounds3& bounds() const { return bounds_; }

  // Whether the surfaces of two things, the first moved by `offset`, pass through each other or, with reachM above 0,
  // come as near as that. Without reach the first is taken half a millimetre smaller on each side: faces in one plane
  // do not pass through each other then, those of bodies that are in each other do.
  bool surfacesMeet(size_t a, size_t b, const HomeState& state, float reachM = 0, Vec3 offset = {});
  // Whether the first, moved by `offset` and as much smaller, is inside the second, where that is a closed body whose
  // fronts look out.
  bool isWithin(size_t a, size_t b, const HomeState& state, Vec3 offset = {});
  // Where the line meets the thing's surfaces, in no order; nothing is taken out of `out`.
  void addLineCrossings(size_t thing, const HomeState& state, Vec3 from, Vec3 to, std::vector<LineCrossing>& out);

  // Whether its surfaces are within reachM of the point.
  bool isNear(Vec3 p, size_t thing, const HomeState& state, float reachM);

  // Points at its lowest, at most 64 of them, evenly over what would touch a floor.
  std::vector<Vec3> footing(size_t thing, const HomeState& state);

 private:
  TriangleTree& treeOf(size_t thing, size_t part);
  std::vector<Vec3> findFooting(size_t thing);
  bool isInside(Vec3 p, size_t thing, const HomeState& state);

  const EditableHome& home_;
  const Scene& scene_;
  Bounds3 bounds_;
  std::vector<std::vector<std::unique_ptr<TriangleTree>>> trees_;  // by thing and part, at rest
  std::vector<std::vector<Vec3>> footings_;  // at rest; empty: not asked for
};

}  // namespace roomlight::view
