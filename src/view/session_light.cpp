// Lit homes: which there are, made by the builder in the background, and how each comes to the state that windows want,
// by the follower.
#include <fmt/format.h>

#include <algorithm>
#include <exception>
#include <set>

#include "view/session.h"

namespace roomlight::view {
namespace {

constexpr size_t kMostLit = 3;  // kept, so that going back to a technique or plan is quick

}  // namespace

HomeState Session::stateOf(const LightKey& key) const {
  const auto plan = plans_.find(key.plan);
  if (key.plan.empty() || plan == plans_.end()) return state_;
  HomeState state = state_;
  state.lamps = plan->second.lamps, state.sun = plan->second.sun;
  return state;
}

LitHome* Session::litFor(const LightKey& key) {
  const auto lit = std::find_if(lit_.begin(), lit_.end(), [&](const auto& l) { return l->key == key; });
  if (lit == lit_.end()) return nullptr;
  lit_.splice(lit_.begin(), lit_, lit);
  return lit_.front().get();
}

bool Session::needs(const LightKey& key) const {
  return std::any_of(windows_.begin(), windows_.end(), [&](const Window& w) {
    return w.connection && std::any_of(w.sides.begin(), w.sides.end(), [&](const Side& s) { return s.key == key; });
  });
}

// The same of windows that were lost but may come back.
bool Session::isShown(const LightKey& key) const {
  return std::any_of(windows_.begin(), windows_.end(), [&](const Window& w) {
    return std::any_of(w.sides.begin(), w.sides.end(), [&](const Side& s) { return s.key == key; });
  });
}

size_t Session::lightsNeeded() const {
  std::set<std::pair<std::string, std::string>> keys;
  for (const Window& w : windows_) {
    for (const Side& s : w.sides) {
      if (w.connection) keys.emplace(s.key.technique, s.key.plan);
    }
  }
  return keys.size();
}

// Of all that windows look at, the first that has no light, or light that cannot follow the sun.
void Session::beginBuilding() {
  if (builder_.busy()) {
    if (!isShown(builder_.work().key)) builder_.giveUp();
    return;
  }
  if (!mayStart()) return;
  for (const Window& w : windows_) {
    for (size_t k = 0; k < w.sides.size() && w.connection; ++k) {
      const Side& s = w.sides[k];
      const auto lit = std::find_if(lit_.begin(), lit_.end(), [&](const auto& l) { return l->key == s.key; });
      if (failedBuilds_.contains(s.key.technique) || (lit != lit_.end() && (*lit)->canFollow(stateOf(s.key).sun)))
        continue;
      RenderSettings settings = frames_;
      settings.technique = s.key.technique;
      RenderProgress progress;
      progress.report = [this](const std::string& stage, float fraction) { tellProgress(stage, fraction); };
      const auto ready = [this] {
        {
          const std::lock_guard lock(mutex_);
          built_ = true;
        }
        wake_.notify_all();
      };
      started("the home cannot be lit now",
              builder_.begin(home_, {s.key, stateOf(s.key), settings, cameraOf(w.camera), revision_},
                             std::move(progress), ready));
      return;
    }
  }
}

void Session::adoptBuilt() {
  {
    const std::lock_guard lock(mutex_);
    if (!built_) return;
    built_ = false;
    progress_.reset();  // told after the end it would stay
  }
  tellAll(textOf({{"type", "progress"}, {"stage", "done"}, {"fraction", 1}}));
  const LightKey key = builder_.work().key;
  const uint32_t revision = builder_.work().revision;
  auto result = builder_.take();
  if (!result) return;
  if (!*result) {
    failedBuilds_.insert(key.technique);
    return tellFailure(result->error());
  }
  if (!result->value()) return;  // given up
  if (const LitHome* before = litFor(key)) dropLight(*before);
  lit_.push_front(std::move(*result).value());
  lit_.front()->revision = revision;
  for (Window& w : windows_) {
    for (Side& s : w.sides) {
      if (s.key == key) s.restart();
    }
  }
}

// Whether the refiner has nothing to do with a home; where it has, it is asked to leave, and nobody waits.
bool Session::refinerLeaves(const LitHome& home) {
  if (refiner_.home() != &home) return true;
  refining_.reset();
  return refiner_.tryLetGo();
}

// The ones that nobody looks at and were not used for longest, beyond a few; those that a thread still works on another
// time.
void Session::dropLights() {
  for (auto l = lit_.end(); l != lit_.begin() && lit_.size() > kMostLit;) {
    --l;
    if (needs((*l)->key) || follower_.home() == l->get() || !refinerLeaves(**l)) continue;
    l = lit_.erase(l);
  }
}

// Waits for the threads that work on it.
void Session::dropLight(const LitHome& home) {
  if (refiner_.home() == &home) refiner_.letGo(), refining_.reset();
  if (follower_.home() == &home) follower_.cancel();
  lit_.remove_if([&](const auto& l) { return l.get() == &home; });
}

// Where a home's light is to come; the sun stays where its light cannot follow it.
HomeState Session::wantedOf(const LitHome& home) const {
  HomeState wanted = stateOf(home.key);
  if (!home.canFollow(wanted.sun)) wanted.sun = home.sunAtFirst;
  return wanted;
}

// Whether light has come to where the home is; else nobody but the follower may use it.
bool Session::isUpToDate(const LitHome& home) const {
  if (follower_.home() == &home) return false;
  return wantedOf(home) == home.state && home.lit->settled();
}

// Whether there is something to make pictures of. Without a front a home is looked at as its light is, and not while
// that follows.
bool Session::canBeShown(const LitHome& home) const { return home.front || follower_.home() != &home; }

// Whether a window is to see light that came before it goes on, or, where only bounces are missing, what its eye has
// come to.
bool Session::isOwedAFrame(const LitHome& home) const {
  const bool bounces = wantedOf(home) == home.state;
  return std::any_of(windows_.begin(), windows_.end(), [&](const Window& w) {
    return w.connection && w.viewport.width > 0 && w.underWay.size() < kMostUnderWay &&
           std::any_of(w.sides.begin(), w.sides.end(), [&](const Side& s) {
             return s.key == home.key && (s.lightCame || (bounces && s.shownSerial != w.serial));
           });
  });
}

// The scene of quick frames at once, its light later.
void Session::followFront(LitHome& home) {
  HomeState wanted = wantedOf(home);
  if (wanted == home.front->state()) return;
  SceneChange change;
  try {
    change = home.front->follow(home_, std::move(wanted));
  } catch (const std::exception&) {  // it is between two states
    dropLight(home);
    throw;
  }
  for (Window& w : windows_) {
    for (Side& s : w.sides) {
      if (s.key == home.key) s.quick.sceneChanged(change, home.front->scene());
    }
  }
}

// Begins to find the light of a home that windows look at and that has changed, or goes on with bounces that it still
// owes: of several in turn.
void Session::followLight() {
  if (follower_.home() || !mayStart()) return;
  LitHome* next = nullptr;
  for (const auto& home : lit_) {
    if (!needs(home->key) || isUpToDate(*home) || meterIsDue(*home)) continue;
    if (!home->front && isOwedAFrame(*home)) continue;
    if (!next || home->followedAt < next->followedAt) next = home.get();
  }
  if (!next) return;
  if (!refinerLeaves(*next)) {
    soon_ = true;
    return;
  }
  const auto ready = [this] {
    {
      const std::lock_guard lock(mutex_);
      lightReady_ = true;
    }
    wake_.notify_all();
  };
  next->followedAt = ++followings_, followed_ = revision_;
  started("light cannot follow the change now",
          follower_.begin(home_, *next, wantedOf(*next), settings_.threads, ready));
}

// Whether there was light to take.
bool Session::takeLight() {
  {
    const std::lock_guard lock(mutex_);
    if (!lightReady_) return false;
    lightReady_ = false;
  }
  if (!follower_.done()) return false;  // of one that is no longer there
  FollowedLight followed = follower_.finish();
  if (!followed.home) return false;
  LitHome& home = *followed.home;
  if (!followed.change) {  // found afresh, then
    dropLight(home);
    tellFailure(fmt::format("light could not follow the change: {}", followed.error));
    return true;
  }
  home.revision = followed_;
  if (home.front) home.front->take(std::move(followed.light), home.scene);
  for (Window& w : windows_) {
    for (Side& s : w.sides) {
      if (!(s.key == home.key)) continue;
      s.lightCame = true;
      if (home.front) s.quick.lightChanged();
      if (s.history) s.history->sceneChanged(*followed.change, home.scene);
    }
  }
  return true;
}

}  // namespace roomlight::view
