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
  std::shared_ptr<LightSolution> solution;    // null: there was nothing to follow
  std::optional<SceneChange> change;          // none: that failed, and the solution is somewhere between two states
  std::shared_ptr<const SlotSnapshot> light;  // of techniques that have light in slots
  std::string error;                          // of a failure: why
};

class LightFollower {
 public:
  explicit LightFollower(StartThread start = systemThread) : start_(std::move(start)) {}
  ~LightFollower() { cancel(); }
  // Takes a solution and brings it to a state that it can follow to, or goes on with bounces that it still owes; one at
  // a time. `ready` is called from the follower's thread. Error: there is no thread; the solution stays with who has
  // it, and it may be tried again.
  Status begin(const ViewHome& all, std::shared_ptr<LightSolution>& solution, HomeState wanted, int threads,
               std::function<void()> ready);
  bool busy() const { return thread_.joinable(); }  // until finish() or cancel()
  bool done() const { return done_; }
  // Waits for the end, and gives the solution back.
  FollowedLight finish();
  // Ends it, and waits for that; its solution is of no further use.
  void cancel();

 private:
  void follow(const ViewHome& all, const HomeState& wanted);

  const StartThread start_;
  std::shared_ptr<LightSolution> solution_;
  std::optional<SceneChange> change_;
  std::shared_ptr<const SlotSnapshot> light_;
  std::string error_;
  std::atomic<bool> done_{false}, cancelled_{false};
  std::thread thread_;
};

}  // namespace roomlight::view
