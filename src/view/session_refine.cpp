// On to the reference: one picture at a time is refined by paths while nothing else is to be done.
#include "view/session.h"

namespace roomlight::view {

// Other techniques show what they find, not what is true.
bool Session::refines(const Side& side) const { return side.key.technique == "hybrid" || side.key.technique == "path"; }

void Session::tellRefined() {
  {
    const std::lock_guard lock(mutex_);
    refinedReady_ = true;
  }
  wake_.notify_all();
}

void Session::beginRefining() {
  if (refining_) return;
  for (Window& w : windows_) {
    for (size_t k = 0; k < w.sides.size() && w.connection; ++k) {
      const Side& s = w.sides[k];
      const bool waits = s.shownSerial == w.serial && s.picture.averaged() && !s.picture.settled() && !s.picture.refined();
      LitHome* home = waits ? litFor(s.key) : nullptr;
      if (!home || follower_.home() == home) continue;
      PathSettings settings = settings_.path;
      settings.width = s.picture.image().width, settings.height = s.picture.image().height;
      settings.seed = settings_.seed + 1;  // other random numbers than those of the picture
      refining_ = Refining{w.name, k, w.serial};
      return refiner_.begin(*home, cameraOf(w.camera), settings, settings_.threads, s.picture.image());
    }
  }
}

// Whether there was a picture to take.
bool Session::takeRefined() {
  {
    const std::lock_guard lock(mutex_);
    if (!refinedReady_) return false;
    refinedReady_ = false;
  }
  std::optional<RefinedPicture> picture = refiner_.take();
  if (!picture || !refining_) return false;
  const auto window = std::find_if(windows_.begin(), windows_.end(), [&](const Window& w) { return w.name == refining_->window; });
  const size_t k = refining_->side;
  if (window == windows_.end() || window->serial != refining_->serial || k >= window->sides.size()) {
    refiner_.giveUp();
    refining_.reset();
    return false;
  }
  Side& side = window->sides[k];
  side.picture.refine(std::move(picture->image), picture->samples, picture->relativeError, picture->last);
  side.again = true;
  if (picture->last) refining_.reset();
  return true;
}

}  // namespace roomlight::view
