#include "measure/room_targets.h"

namespace roomlight {
namespace {

RoomTarget wantedIn(const RoomReading& r) {
  const RoomUse* use = findRoomUse(r.room.use);
  RoomTarget t;
  t.room = r.room.name, t.origin = "stated";
  if (!use) use = useByName(r.room.name), t.origin = "name";
  if (!use) use = findRoomUse(kAssumedUse), t.origin = "assumed";
  t.use = use->name;
  const Target target = r.targets.lux.value_or(*use->targets.lux);
  if (r.targets.lux && r.room.use.empty()) t.origin = "target", t.use.clear();
  t.wantedLux = target.value, t.source = target.source;
  return t;
}

}  // namespace

std::vector<RoomTarget> roomTargets(const Measurements& m) {
  std::vector<RoomTarget> list;
  for (const RoomReading& r : m.rooms) {
    RoomTarget t = wantedIn(r);
    bool outdoors = false;
    for (const GridReading& g : m.grids) {
      if (g.room != r.room.name || g.kind != SurfaceKind::WorkPlane) continue;
      const Statistics s = g.lux();
      outdoors = outdoors || g.outdoors;
      if (s.points > 0) t.foundLux = s.mean * m.maintenanceFactor;
    }
    if (!outdoors) list.push_back(std::move(t));
  }
  return list;
}

}  // namespace roomlight
