// Picking and metering.
#include <cmath>
#include <utility>

#include "measure/measurements.h"
#include "view/point.h"
#include "view/session.h"

namespace roomlight::view {
namespace {

Json orNothing(int number, std::string (*id)(size_t)) {
  return number < 0 ? Json(nullptr) : Json(id(static_cast<size_t>(number)));
}

Json ev(double value) { return std::isfinite(value) ? Json(std::round(value * 100) / 100) : Json(nullptr); }

Json pickedJson(const PickedPoint& p) {
  return {{"point", vectorJson(p.point)},      {"normal", vectorJson(p.normal)},
          {"distanceM", p.distanceM},          {"object", orNothing(p.object, objectId)},
          {"lamp", orNothing(p.lamp, lampId)}, {"material", p.material}};
}

Json meteredJson(const PickedPoint& p, const Metered& m) {
  return {{"point", vectorJson(p.point)},
          {"normal", vectorJson(p.normal)},
          {"object", orNothing(p.object, objectId)},
          {"illuminanceLux", m.illuminanceLux},
          {"standardErrorLux", m.standardErrorLux},
          {"luminanceCdM2", m.luminanceCdM2},
          {"incidentEv100", ev(incidentEv100(m.illuminanceLux))},
          {"reflectedEv100", ev(reflectedEv100(m.luminanceCdM2))}};
}

}  // namespace

bool Session::carryOut(const AnswerPoints& a) {
  Window* window = conversation_.windowNamed(a.window);
  if (!window) return false;
  try {
    return answerPoints(*window, a.meter);
  } catch (const std::exception&) {  // others come before it is tried again
    conversation_.serveLast(*window);
    throw;
  }
}

// Answers what waits. What fails is not asked again.
bool Session::answerPoints(Window& window, bool meter) {
  LitHome* home = litFor(window.sides.front().key);
  if (!home || (!home->live && !home->solution)) return false;
  const Camera camera = cameraOf(window.camera);
  if (home->live) {
    followLive(*home);
  } else {
    lookFrom(*home, camera);
  }
  const auto find = [&](const Point& p) {
    return pickAt(home_.editable, home->shownState(), home->rays(),
                  {camera, frameSize(window.viewport, 1), p.x, p.y, static_cast<float>(window.viewport.height)});
  };
  if (window.pick) {
    const Point asked = *std::exchange(window.pick, std::nullopt);
    const std::optional<PickedPoint> picked = find(asked);
    conversation_.tell(window, pointText(asked, picked ? pickedJson(*picked) : Json(nullptr)));
  }
  if (meter && window.meter && home->solution) {
    const Point asked = *std::exchange(window.meter, std::nullopt);
    const std::optional<PickedPoint> picked = find(asked);
    const std::optional<Metered> metered =
        picked ? meterAt(*home->solution->lit, *picked, camera.worldFromCamera.w, stop_) : std::nullopt;
    conversation_.tell(window, pointText(asked, metered ? meteredJson(*picked, *metered) : Json(nullptr)));
  }
  conversation_.serveLast(window);
  return true;
}

}  // namespace roomlight::view
