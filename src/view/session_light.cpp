// Lit homes: made by the builder, and brought to the state that windows want by the follower.
#include <fmt/format.h>

#include <algorithm>
#include <exception>
#include <utility>

#include "view/session.h"

namespace roomlight::view {

// It counts as used.
LitHome* Session::litFor(const LightKey& key) {
  const auto lit = std::find_if(lit_.begin(), lit_.end(), [&](const auto& l) { return l->key == key; });
  if (lit == lit_.end()) return nullptr;
  lit_.splice(lit_.begin(), lit_, lit);
  return lit_.front().get();
}

bool Session::carryOut(const LightHome& a) {
  const Window* window = conversation_.windowNamed(a.window);
  if (!window) return false;
  const LightKey key = window->sides[a.side].key;
  RenderSettings settings = frames_;
  settings.technique = key.technique;
  RenderProgress progress;
  progress.report = [this](const std::string& stage, float fraction) { tellProgress(stage, fraction); };
  started("the home cannot be lit now", builder_.begin(home_,
                                                       {key, conversation_.stateOf(key.plan), settings,
                                                        cameraOf(window->camera), conversation_.revision()},
                                                       std::move(progress), [this] { push(Built{}); }));
  return true;
}

bool Session::carryOut(const GiveUpLighting&) {
  builder_.giveUp();
  return false;
}

void Session::handle(const Event&, const Built&) {
  conversation_.tellAll(textOf({{"type", "progress"}, {"stage", "done"}, {"fraction", 1}}));
  const LightKey key = builder_.work().key;
  const uint32_t revision = builder_.work().revision;
  auto result = builder_.take();
  if (!result) return;
  if (!*result) {
    if (failedAt_ != conversation_.wishes()) failedBuilds_.clear();
    failedAt_ = conversation_.wishes();
    failedBuilds_.push_back(key.technique);
    return tellFailure(result->error());
  }
  if (!result->value()) return;  // given up
  if (const LitHome* before = litFor(key)) dropLight(*before);
  lit_.push_front(std::move(*result).value());
  lit_.front()->revision = revision;
  for (Window& w : conversation_.windows()) {
    for (Side& s : w.sides) {
      if (s.key == key) s.restart();
    }
  }
}

// Whether the refiner has nothing to do with a home; where it has, it is asked to leave, and nobody waits.
bool Session::refinerLeaves(const LitHome& home) {
  if (!home.solution || refiner_.solution() != home.solution.get()) return true;
  refining_.reset();
  return refiner_.tryLetGo();
}

bool Session::carryOut(const DropHome& a) {
  const LitHome* home = litFor(a.key);
  if (!home || !refinerLeaves(*home)) return false;
  lit_.pop_front();
  return true;
}

// Waits for the threads that work on it.
void Session::dropLight(const LitHome& home) {
  if (!home.solution) follower_.cancel();
  if (home.solution && refiner_.solution() == home.solution.get()) refiner_.letGo(), refining_.reset();
  lit_.remove_if([&](const auto& l) { return l.get() == &home; });
}

HomeState Session::wantedOf(const LitHome& home) const {
  HomeState wanted = conversation_.stateOf(home.key.plan);
  if (!home.canFollow(wanted.sun)) wanted.sun = home.sunAtFirst;
  return wanted;
}

// The scene of quick frames at once, its light later.
void Session::followLive(LitHome& home) {
  if (isWanted(home.live->state(), home)) return;
  SceneChange change;
  try {
    change = home.live->follow(home_, wantedOf(home));
  } catch (const std::exception&) {  // it is between two states
    dropLight(home);
    throw;
  }
  for (Window& w : conversation_.windows()) {
    for (Side& s : w.sides) {
      if (s.key == home.key) s.quick.sceneChanged(change, home.live->scene());
    }
  }
}

bool Session::carryOut(const FollowLight& a) {
  LitHome* home = litFor(a.key);
  if (!home || !home->solution || !refinerLeaves(*home)) return false;
  home->followedAt = ++followings_, followed_ = conversation_.revision(), followedKey_ = a.key;
  started("light cannot follow the change now", follower_.begin(home_, home->solution, wantedOf(*home),
                                                                settings_.threads, [this] { push(LightFollowed{}); }));
  return true;
}

void Session::handle(const Event&, const LightFollowed&) {
  if (!follower_.busy() || !follower_.done()) return;  // of one that is no longer there
  FollowedLight followed = follower_.finish();
  LitHome* home = litFor(followedKey_);
  if (!home || !followed.solution) return;
  home->solution = std::move(followed.solution);
  if (!followed.change) {  // found afresh, then
    dropLight(*home);
    return tellFailure(fmt::format("light could not follow the change: {}", followed.error));
  }
  home->revision = followed_;
  const Scene& scene = home->solution->scene;
  if (home->live) home->live->take(std::move(followed.light), scene);
  for (Window& w : conversation_.windows()) {
    for (Side& s : w.sides) {
      if (!(s.key == home->key)) continue;
      s.lightCame = true;
      if (home->live) s.quick.lightChanged();
      if (s.history) s.history->sceneChanged(*followed.change, scene);
    }
  }
}

}  // namespace roomlight::view
