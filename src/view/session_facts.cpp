// What stands where, as the schedule wants to know it.
#include <algorithm>

#include "view/session.h"

namespace roomlight::view {

Situation Session::situation() const {
  Situation s;
  for (const Window& w : conversation_.windows()) {
    WindowFacts& facts = s.windows.emplace_back();
    facts.name = w.name, facts.isConnected = w.connection.has_value();
    facts.hasSize = w.hasSize(), facts.takesFrames = w.takesFrames();
    facts.leftAt = w.leftAt, facts.inputAt = w.inputAt, facts.serial = w.serial;
    facts.picks = w.pick.has_value(), facts.meters = w.meter.has_value();
    facts.metersSince = w.meterAt, facts.metersRevision = w.meterRevision;
    for (const Side& side : w.sides) facts.sides.push_back(factsOf(w, side));
  }
  for (const auto& home : lit_) s.homes.push_back(factsOf(*home));
  if (builder_.busy()) s.building = builder_.work().key;
  if (failedAt_ == conversation_.wishes()) s.failed = failedBuilds_;
  s.refining = refining_, s.refinerWorks = refiner_.working();
  s.rendersFinal = jobs_.busy();
  s.mayStartAt = startAgainAt_;
  return s;
}

SideFacts Session::factsOf(const Window& window, const Side& side) const {
  SideFacts facts;
  facts.key = side.key;
  facts.isCurrent = side.shownSerial == window.serial && side.picture.begun();
  facts.lightCame = side.lightCame, facts.isToBeShownAgain = side.again;
  facts.isAveraged = side.picture.averaged(), facts.isSettled = side.picture.settled();
  facts.quickSettled = side.quick.settled();
  facts.failedToRefine = side.failedSerial == window.serial;
  facts.samples = side.picture.samples();
  return facts;
}

HomeFacts Session::factsOf(const LitHome& home) const {
  HomeFacts facts;
  facts.key = home.key;
  facts.isLive = home.live != nullptr, facts.isAway = !home.solution;
  facts.canFollow = home.canFollow(conversation_.stateOf(home.key.plan).sun);
  facts.revision = home.revision, facts.followedAt = home.followedAt;
  if (!home.solution) return facts;
  facts.isRefined = refiner_.solution() == home.solution.get();
  facts.hasState = isWanted(home.solution->state, home), facts.isSettled = home.solution->lit->settled();
  return facts;
}

// Whether the home's light is to come to that state; the sun stays where its light cannot follow it.
bool Session::isWanted(const HomeState& state, const LitHome& home) const {
  const HomeState& wanted = conversation_.stateOf(home.key.plan);
  return state.sun == (home.canFollow(wanted.sun) ? wanted.sun : home.sunAtFirst) && state.lamps == wanted.lamps &&
         state.objects == wanted.objects;
}

bool Session::isUpToDate(const LitHome& home) const {
  const HomeFacts facts = factsOf(home);
  return !facts.isAway && facts.hasState && facts.isSettled;
}

}  // namespace roomlight::view
