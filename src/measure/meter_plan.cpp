#include "measure/meter_plan.h"

namespace roomlight {

RoomPlan planRoom(const Room& room) {
  RoomPlan plan;
  plan.room = room;
  if (const RoomUse* use = findRoomUse(room.use)) plan.targets = use->targets, plan.workPlaneM = use->workPlaneM;
  return plan;
}

}  // namespace roomlight
