// Light that follows a change of its home in the background, while frames are made of what there is.
#pragma once

#include <atomic>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <thread>
#include <utility>

#include "view/lit_home.h"
#include "view/start_thread.h"

namespace roomlight::view {

struct FollowedLight {
  LitHome* home = nullptr;                    // null: there was nothing to follow
  std::optional<SceneChange> change;          // none: that failed, and the home is somewhere between two states
  std::shared_ptr<const SlotSnapshot> light;  // of techniques that have light in slots
  std::string error;                          // of a failure: why
};

class LightFollower {
 public:
  explicit LightFollower(StartThread start = systemThread) : start_(std::move(start)) {}
  ~LightFollower() { cancel(); }
  // Brings the home to a state that it can follow to, or goes on with bounces that it still owes; one at a time. Nobody
  // else may touch `home`, but for its front, until finish() has returned. `ready` is called from the follower's
  // thread. Error: there is no thread; the home is as it was, and it may be tried again.
  Status begin(const ViewHome& all, LitHome& home, HomeState wanted, int threads, std::function<void()> ready);
  const LitHome* home() const { return home_; }  // null: none
  bool done() const { return done_; }
  // Waits for the end.
  FollowedLight finish();
  // Ends it, and waits for that; its home is of no further use.
  void cancel();

 private:
  void follow(const ViewHome& all, LitHome& home, const HomeState& wanted);

  const StartThread start_;
  LitHome* home_ = nullptr;
  std::optional<SceneChange> change_;
  std::shared_ptr<const SlotSnapshot> light_;
  std::string error_;
  std::atomic<bool> done_{false}, cancelled_{false};
  std::thread thread_;
};

}  // namespace roomlight::view
