// Every room beside what rooms of its use should be lit to.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "measure/measurements.h"

namespace roomlight {

constexpr const char* kAssumedUse = "living";  // of rooms of which nothing is known

struct RoomTarget {
  std::string room, use;
  std::string
      origin;  // of the use: "stated", "name" (of the room), or "assumed"; "target": the illuminance itself was stated
  std::string source;  // of the illuminance: a standard, or the file that says so
  double wantedLux = 0;
  std::optional<double> foundLux;  // mean on the work plane, times the maintenance factor; none: not measured
  bool met() const { return foundLux && *foundLux >= wantedLux; }
};

// One for each room indoors, in their order.
std::vector<RoomTarget> roomTargets(const Measurements& m);

}  // namespace roomlight
