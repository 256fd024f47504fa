// On to the reference: a picture that is put right by paths in the background.
#include <algorithm>
#include <utility>

#include "view/session.h"

namespace roomlight::view {
namespace {

constexpr uint32_t kFirstTurn = 60, kMostDoublings = 8;  // samples of a turn; each is twice as long as the one before,
                                                         // for only then errors go on falling

uint32_t turnAfter(uint32_t turns) { return kFirstTurn << std::min(turns, kMostDoublings); }

}  // namespace

// Of illuminance the averages are good enough.
bool Session::refines(const Window& window, const Side& side) const {
  return !window.display.white() && findTechnique(side.key.technique)->refinesToTruth;
}

bool Session::carryOut(const StopRefining&) {
  refiner_.giveUp();
  refining_.reset();
  return true;
}

bool Session::carryOut(const Refine& a) {
  Window* window = conversation_.windowNamed(a.window);
  if (!window || a.side >= window->sides.size()) return false;
  Side& s = window->sides[a.side];
  LitHome* home = litFor(s.key);
  if (!home || !home->solution) return false;
  if (!s.picture.refined()) s.turns = 0;
  s.samplesBefore = s.turns > 0 ? s.picture.samples() : 0;
  const uint32_t length = turnAfter(s.turns);
  PathSettings settings = settings_.path;
  settings.width = s.picture.image().width, settings.height = s.picture.image().height;
  settings.seed = settings_.seed + 1 + s.turns;  // other random numbers than those of the picture so far
  // The picture of an earlier turn is better than the first looks of this one could make it.
  const int firstLook = s.turns > 0 ? static_cast<int>(length) : Refiner::kFewestSamples;
  const Status begun = refiner_.begin(home->solution, cameraOf(window->camera), settings, settings_.threads,
                                      s.picture.image(), firstLook);
  if (!started("the picture cannot be refined now", begun)) return true;
  ++s.turns;
  refining_ = RefiningFacts{window->name, a.side, window->serial, length, 0};
  return true;
}

void Session::handle(const Event&, const Refined&) {
  std::optional<RefinedPicture> picture = refiner_.take();
  if (!refining_) return;
  Window* window = conversation_.windowNamed(refining_->window);
  if (!window || window->serial != refining_->serial || refining_->side >= window->sides.size())
    return;  // the schedule ends it
  Side& side = window->sides[refining_->side];
  if (picture) {
    side.picture.refine(std::move(picture->image), side.samplesBefore + picture->samples, picture->relativeError,
                        picture->last);
    side.again = true;
    refining_->samples = picture->samples;
  }
  if (refiner_.failed()) side.failedSerial = window->serial;
  if (refiner_.failed() || (picture && picture->last)) refining_.reset();
}

}  // namespace roomlight::view
