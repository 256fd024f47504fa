// How the things of a home lie to each other while edits move them: what stands on them goes along, and what they run
// into is known.
#pragma once

#include <optional>
#include <vector>

#include "view/apply_edit.h"
#include "view/overlaps.h"
#include "view/standing.h"

namespace roomlight::view {

// Refers to the home and to the scene at rest, which must stay. Not for several threads at once.
class Arrangement {
 public:
  Arrangement(const EditableHome& home, const Scene& atRest, const HomeState& atStart);
  Arrangement(const Arrangement&) = delete;
  Arrangement& operator=(const Arrangement&) = delete;

  // If the edit moved a thing, takes along what lay on it in `from`, the state in which its gesture began: so nothing
  // is picked up on the way.
  void takeAlong(const Edit& edit, const HomeState& from, Edited& edited);

  // The home went from one state to another.
  void follow(const HomeState& from, const HomeState& to) { overlaps_.follow(from, to); }
  const std::vector<Overlap>& overlaps() const { return overlaps_.list(); }

 private:
  struct Found {  // for the next edit of the gesture
    size_t thing;
    HomeState state;
    Load load;
  };

  ThingShapes shapes_;
  Overlaps overlaps_;
  std::optional<Found> found_;
};

}  // namespace roomlight::view
