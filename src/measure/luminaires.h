// The luminaires of a scene as a planner lists them.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "scene/scene.h"

namespace roomlight {

// A lamp or a thing that shines, with all its bulbs.
struct Luminaire {
  std::string name, kind;        // kind: "point", "spot", "area", "photometric", "shining mesh"
  Vec3 position;                 // of its first lamp, else the middle of what shines
  double fluxLm = 0;             // as it is here: dimmed, with its light loss
  double wattsW = 0;             // 0: not stated
  std::optional<double> kelvin;  // of light that is near to that of black bodies and not just white
  std::string room;              // empty: of none, or not yet known
  size_t count = 1;              // how many alike, in a schedule
};

// In the order of the scene, each by itself.
std::vector<Luminaire> luminairesOf(const Scene& scene);

// Those alike in name, kind, flux, watts, colour and room as one row, in the order in which they came first.
struct Schedule {
  std::vector<Luminaire> rows;
  std::vector<size_t> rowOf;  // of each luminaire
};
Schedule scheduleOf(const std::vector<Luminaire>& luminaires);

}  // namespace roomlight
