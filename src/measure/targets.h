// What rooms should be lit to.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace roomlight {

struct Target {
  double value = 0;
  std::string source;  // the standard, or the file that says so
};

struct Targets {
  std::optional<Target> lux;         // at least, on average on the work plane
  std::optional<Target> uniformity;  // U0 at least
  std::optional<Target> ugr;         // at most
  std::optional<Target> wattsPerM2;  // at most
};

struct RoomUse {
  std::string name;  // "living"
  Targets targets;
  double workPlaneM;  // above the floor, where the standard measures
};

// Homes after GB 50034 (general lighting, on 0.75 m, of halls and stairs on the floor; power density of homes), offices
// after EN 12464-1.
const std::vector<RoomUse>& roomUses();
const RoomUse* findRoomUse(const std::string& name);
// What a room's name says of its use, in English, German, French, Italian and Spanish: "Kitchen 2", "Küche", "Salle de
// bain". Null: nothing.
const RoomUse* useByName(const std::string& name);

}  // namespace roomlight
