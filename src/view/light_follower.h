// Light that follows a change of its home in the background, while frames are made of what there is.
#pragma once

#include <atomic>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "view/executor.h"
#include "view/lit_home.h"

namespace roomlight::view {

struct FollowedLight {
  std::shared_ptr<LightSolution> solution;    // null: there was nothing to follow
  std::optional<SceneChange> change;          // none: that failed, and the solution is somewhere between two states
  std::shared_ptr<const SlotSnapshot> light;  // of techniques that have light in slots
  std::string error;                          // of a failure: why
};

class LightFollower {
 public:
  explicit LightFollower(Executor& executor) : executor_(executor) {}
  ~LightFollower() { cancel(); }
  // Takes a solution and brings it to a state that it can follow to, or goes on with bounces that it still owes; one at
  // a time. `ready` is called from the follower's thread. Error: there is no thread; the solution stays with who has
  // it, and it may be tried again.
  Status begin(const ViewHome& all, std::shared_ptr<LightSolution>& solution, HomeState wanted, int threads,
               std::function<void()> ready);
  bool busy() const { return static_cast<bool>(job_); }  // until finish() or cancel()
  bool done() const { return job_.done(); }
  // Waits for the end, and gives the solution back.
  FollowedLight finish();
  // Ends it, and waits for that; its solution is of no further use.
  void cancel();

 private:
  void follow(const ViewHome& all, const HomeState& wanted, const std::atomic<bool>& cancelled);

  Executor& executor_;
  FollowedLight followed_;
  Job job_;
};

}  // namespace roomlight::view
