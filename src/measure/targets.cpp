#include "measure/targets.h"

namespace roomlight {
namespace {

RoomUse home(const char* name, double lux) { return {name, {lux, std::nullopt, std::nullopt, 6, "GB 50034"}, 0.75}; }

}  // namespace

const std::vector<RoomUse>& roomUses() {
  static const std::vector<RoomUse> uses = {home("living", 100), home("bedroom", 75), home("dining", 150), home("kitchen", 100), home("bathroom", 100), {"office", {500, 0.6, 19, std::nullopt, "EN 12464-1"}, 0.75}};
  return uses;
}

const RoomUse* findRoomUse(const std::string& name) {
  for (const RoomUse& use : roomUses()) {
    if (use.name == name) return &use;
  }
  return nullptr;
}

}  // namespace roomlight
