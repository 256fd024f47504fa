// A small file can ask for much work: every window against every wall, every room against every other, walls rounder
// than anybody sees. What a home asks for is counted before it is done, and a file that asks for more than any home
// does is refused.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <string>

#include "import/failure.h"
#include "import/plan_area.h"
#include "scene/scene.h"

namespace roomlight::importers::sh3d {

class Effort {
 public:
  // What the plan draws: walls, rooms, lines, boxes, lights. Large homes have some ten thousand.
  static constexpr size_t kMostTriangles = 4'000'000;
  // Of one room's outline, or one cut-out shape, with itself.
  static constexpr size_t kMostOwnCrossings = 1000;

  explicit Effort(size_t mostTriangles = kMostTriangles) : mostTriangles_(std::min(mostTriangles, kMostTriangles)) {}

  // Points that are compared or cut; throws Failure beyond what some seconds can do.
  void spend(size_t units, const std::string& place) {
    used_ += units;
    if (used_ > kMost)
      fail(place, "the walls, rooms and openings up to here cut each other more often than those of any home");
  }
  // Before two areas that do not cross themselves are united, cut or intersected.
  void spendOn(const PlanArea& a, const PlanArea& b, const std::string& place) {
    spend(combiningSteps(a, b, kMost - used_), place);
  }
  // Before one is united with nothing, to end its crossings; false where it has so many that it is no drawing.
  bool untangles(const PlanArea& area, const std::string& place) {
    const Tangle tangle = tangleOf(area, kMostOwnCrossings);
    spend(tangle.steps, place);
    return tangle.crossings <= kMostOwnCrossings;
  }
  size_t used() const { return used_; }

  // Throws Failure where so many triangles more, behind `before` that are not made yet either, are too many.
  void ask(size_t triangles, const std::string& place, size_t before = 0) const {
    const size_t most = mostTriangles_ - triangles_;
    if (before <= most && triangles <= most - before) return;
    fail(place, fmt::format("would make {} triangles, {} with all before it; a home of more than {} is too fine",
                            triangles, triangles_ + before + triangles, mostTriangles_));
  }
  void make(size_t triangles, const std::string& place) {
    ask(triangles, place);
    triangles_ += triangles;
  }

  // Before a model's mesh is copied for a look of its own: what does not share is counted by its corners.
  void copy(const Mesh& mesh, const std::string& place) { copy(mesh.positions.size() + mesh.indices.size(), place); }
  void copy(size_t corners, const std::string& place) {
    copied_ += corners;
    if (copied_ > kMostCopied)
      fail(place, "the models up to here, in all their colours and textures, take more memory than those of any home");
  }

 private:
  static constexpr size_t kMost = 20'000'000, kMostCopied = 150'000'000;
  size_t mostTriangles_, triangles_ = 0, used_ = 0, copied_ = 0;
};

}  // namespace roomlight::importers::sh3d
