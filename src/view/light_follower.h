// Light that follows a change of its home in the background, while frames are made of what there is.
#pragma once

#include <atomic>
#include <functional>
#include <thread>

#include "view/lit_home.h"

namespace roomlight::view {

class LightFollower {
 public:
  ~LightFollower() { finish(); }
  // Brings the home to a state, but for the sun, or goes on with bounces that it still owes; one at a time. Nobody else may touch `home`, but for its front, until
  // finish() has returned. `ready` is called from the follower's thread.
  void begin(const EditableHome& editable, LitHome& home, HomeState wanted, int threads, std::function<void()> ready);
  const LitHome* home() const { return home_; }  // null: none
  bool done() const { return done_; }
  // Waits for the end. Returns the home and its new light; null if there was none.
  std::pair<LitHome*, std::shared_ptr<const SlotSnapshot>> finish();

 private:
  LitHome* home_ = nullptr;
  std::shared_ptr<const SlotSnapshot> light_;
  std::atomic<bool> done_{false};
  std::thread thread_;
};

}  // namespace roomlight::view
