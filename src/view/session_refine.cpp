// On to the reference: one picture at a time is refined by paths while nothing else is to be done. Where several could
 // be, they take turns.
#include <algorithm>

#include "view/session.h"

namespace roomlight::view {
namespace {

constexpr uint32_t kFirstTurn = 60, kMostDoublings = 8;  // samples of a turn; each is twice as long as the one before,
                                                         // for only then errors go on falling

uint32_t turnAfter(uint32_t turns) { return kFirstTurn << std::min(turns, kMostDoublings); }

// As good as averages make it, and to be seen: the window takes frames.
bool couldBeRefined(const Window& w, const Side& s) {
  return w.connection && w.underWay.size() < kMostUnderWay && s.shownSerial == w.serial && s.failedSerial != w.serial &&
         s.picture.averaged() && !s.picture.settled();
}

}  // namespace

// Of illuminance the averages are good enough.
bool Session::refines(const Window& window, const Side& side) const {
  return !window.display.white() && findTechnique(side.key.technique)->refinesToTruth;
}

void Session::tellRefined() {
  {
    const std::lock_guard lock(mutex_);
    refinedReady_ = true;
  }
  wake_.notify_all();
}

// The picture with the fewest samples of those that wait; no window if there is none.
std::pair<Window*, size_t> Session::nextToRefine() {
  std::pair<Window*, size_t> next{nullptr, 0};
  for (Window& w : windows_) {
    for (size_t k = 0; k < w.sides.size(); ++k) {
      const bool isUnderWay = refining_ && refining_->window == w.name && refining_->side == k;
      if (isUnderWay || !couldBeRefined(w, w.sides[k])) continue;
      const LitHome* home = litFor(w.sides[k].key);
      if (!home || follower_.home() == home) continue;
      if (!next.first || w.sides[k].picture.samples() < next.first->sides[next.second].picture.samples())
        next = {&w, k};
    }
  }
  return next;
}

bool Session::isTurnOver(const Side& next) {
  const Window* window = windowNamed(refining_->window);
  if (!window || refining_->side >= window->sides.size()) return true;
  return refining_->samples >= refining_->turn &&
         next.picture.samples() < window->sides[refining_->side].picture.samples();
}

void Session::beginRefining() {
  if (jobs_.busy()) {  // somebody waits for that
    if (refining_) refiner_.giveUp(), refining_.reset();
    return;
  }
  if (!mayStart()) return;
  const auto [window, k] = nextToRefine();
  if (!window || (refining_ && !isTurnOver(window->sides[k]))) return;
  if (refining_) refiner_.giveUp(), refining_.reset();
  if (refiner_.working()) return;  // on a last blend, which takes about a second
  Side& s = window->sides[k];
  if (!s.picture.refined()) s.turns = 0;
  s.samplesBefore = s.turns > 0 ? s.picture.samples() : 0;
  const uint32_t length = turnAfter(s.turns);
  PathSettings settings = settings_.path;
  settings.width = s.picture.image().width, settings.height = s.picture.image().height;
  settings.seed = settings_.seed + 1 + s.turns;  // other random numbers than those of the picture so far
  // The picture of an earlier turn is better than the first looks of this one could make it.
  const int firstLook = s.turns > 0 ? static_cast<int>(length) : Refiner::kFewestSamples;
  if (!started("the picture cannot be refined now", refiner_.begin(*litFor(s.key), cameraOf(window->camera), settings,
                                                                   settings_.threads, s.picture.image(), firstLook)))
    return;
  ++s.turns;
  refining_ = Refining{window->name, k, window->serial, length, 0};
}

// Whether there was a picture to take.
bool Session::takeRefined() {
  {
    const std::lock_guard lock(mutex_);
    if (!refinedReady_) return false;
    refinedReady_ = false;
  }
  std::optional<RefinedPicture> picture = refiner_.take();
  if (!refining_) return false;
  Window* window = windowNamed(refining_->window);
  const size_t k = refining_->side;
  if (!window || window->serial != refining_->serial || k >= window->sides.size()) {
    refiner_.giveUp();
    refining_.reset();
    return false;
  }
  Side& side = window->sides[k];
  if (picture) {
    side.picture.refine(std::move(picture->image), side.samplesBefore + picture->samples, picture->relativeError,
                        picture->last);
    side.again = true;
    refining_->samples = picture->samples;
  }
  if (refiner_.failed()) side.failedSerial = window->serial;
  if (refiner_.failed() || (picture && picture->last)) refining_.reset();
  return picture.has_value();
}

}  // namespace roomlight::view
