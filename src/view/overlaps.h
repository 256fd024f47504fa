// Moved things that run into others.
#pragma once

#include <map>
#include <utility>
#include <vector>

#include "view/thing_shapes.h"

namespace roomlight::view {

struct Overlap {
  size_t thing, into;  // `thing` was moved
  bool operator==(const Overlap&) const = default;
};

// Follows the states of a home. Things run into each other if it takes more than a centimetre sideways or 2 cm upwards
// to part them; what stands on a rug does not run into it. What did at first counts once it is deeper by a centimetre,
// or after the two were parted; as long as they lie to each other as at first, it never does. Hidden things run into
// nothing, leaves that open neither. `shapes` must stay.
class Overlaps {
 public:
  Overlaps(ThingShapes& shapes, HomeState atStart) : shapes_(shapes), start_(std::move(atStart)) {}

  // The home went from one state to another.
  void follow(const HomeState& from, const HomeState& to);
  // In the state that it went to last.
  const std::vector<Overlap>& list() const { return list_; }

 private:
  using Pair = std::pair<size_t, size_t>;  // in ascending order

  bool lieAlike(size_t a, size_t b, const HomeState& s, const HomeState& t) const;
  bool runsInto(size_t a, size_t b, const HomeState& state);
  bool isIn(size_t a, size_t b, const HomeState& state, Vec3 way);
  bool isDeeper(size_t a, size_t b, const HomeState& state, float depthM);
  float depthM(size_t a, size_t b, const HomeState& state);
  float allowedM(size_t a, size_t b);

  ThingShapes& shapes_;
  const HomeState start_;
  std::vector<Overlap> list_;
  std::map<Pair, float> allowed_;  // how deep they are in each other without being told of, where that is known
};

}  // namespace roomlight::view
