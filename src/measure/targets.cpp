#include "measure/targets.h"

namespace roomlight {
namespace {

constexpr const char* kHomes = "GB 50034";
constexpr const char* kOffices = "EN 12464-1";

RoomUse home(const char* name, double lux) { return {name, {.lux = Target{lux, kHomes}, .uniformity = {}, .ugr = {}, .wattsPerM2 = Target{6, kHomes}}, 0.75}; }
RoomUse office() { return {"office", {Target{500, kOffices}, Target{0.6, kOffices}, Target{19, kOffices}, {}}, 0.75}; }

}  // namespace

const std::vector<RoomUse>& roomUses() {
  static const std::vector<RoomUse> uses = {home("living", 100), home("bedroom", 75), home("dining", 150), home("kitchen", 100), home("bathroom", 100), office()};
  return uses;
}

const RoomUse* findRoomUse(const std::string& name) {
  for (const RoomUse& use : roomUses()) {
    if (use.name == name) return &use;
  }
  return nullptr;
}

}  // namespace roomlight
