// Picking and metering.
#include <algorithm>
#include <cmath>
#include <utility>

#include "measure/exposure.h"
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

constexpr std::chrono::milliseconds kPatience{1000};

std::string answer(const char* type, uint32_t id, Json hit) {
  return textOf({{"type", type}, {"id", id}, {"hit", std::move(hit)}});
}

}  // namespace

void Session::on(Window& window, const Event&, const Point& m) {
  std::optional<Point>& waiting = m.meter ? window.meter : window.pick;
  if (waiting) tell(window, answer(m.meter ? "metered" : "picked", waiting->id, nullptr));
  waiting = m;
  if (m.meter) window.meterAt = std::chrono::steady_clock::now(), window.meterRevision = revision_;
}

// A meter waits for the light of the state that it was asked in; where changes go on after that, for no more than this,
// between two of them, and bounces may be missing.
bool Session::canBeMetered(const Window& window, const LitHome& home) const {
  if (follower_.home() == &home) return false;
  return isUpToDate(home) ||
         (home.revision >= window.meterRevision && std::chrono::steady_clock::now() - window.meterAt > kPatience);
}

bool Session::meterIsDue(const LitHome& home) const {
  return std::any_of(windows_.begin(), windows_.end(), [&](const Window& w) {
    return w.connection && w.meter && w.viewport.width > 0 && w.sides.front().key == home.key && canBeShown(home) &&
           canBeMetered(w, home);
  });
}

// Answers what waits, where there is light to answer by. False: nothing does, or nothing can yet.
bool Session::answerPoints(Window& window) {
  if ((!window.pick && !window.meter) || window.viewport.width == 0) return false;
  LitHome* home = litFor(window.sides.front().key);
  if (!home || !canBeShown(*home)) return false;
  const Camera camera = cameraOf(window.camera);
  if (home->front) {
    followFront(*home);
  } else {
    lookFrom(*home, camera);
  }
  const RayScene& rays = home->front ? home->front->rays() : home->lit->rays();
  const auto find = [&](const Point& p) {
    return pickAt(home_.editable, home->front ? home->front->state() : home->state, rays,
                  {camera, frameSize(window.viewport, 1), p.x, p.y, static_cast<float>(window.viewport.height)});
  };
  bool answered = false;
  // What fails is not asked again.
  if (window.pick) {
    const Point asked = *std::exchange(window.pick, std::nullopt);
    const std::optional<PickedPoint> picked = find(asked);
    tell(window, answer("picked", asked.id, picked ? pickedJson(*picked) : Json(nullptr)));
    answered = true;
  }
  if (!window.meter || !canBeMetered(window, *home)) return answered;
  const Point asked = *std::exchange(window.meter, std::nullopt);
  const std::optional<PickedPoint> picked = find(asked);
  const std::optional<Metered> metered =
      picked ? meterAt(*home, *picked, camera.worldFromCamera.w, stop_) : std::nullopt;
  tell(window, answer("metered", asked.id, metered ? meteredJson(*picked, *metered) : Json(nullptr)));
  return true;
}

}  // namespace roomlight::view
