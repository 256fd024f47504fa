// What one thread of a test waits for and another gives: no more is taken than was given.
#pragma once

#include <condition_variable>
#include <mutex>

namespace roomlight::test {

class Signals {
 public:
  void give(int count = 1) {
    const std::lock_guard lock(mutex_);
    count_ += count;
    given_.notify_all();
  }
  void take() {
    std::unique_lock lock(mutex_);
    given_.wait(lock, [this] { return count_ > 0; });
    --count_;
  }
  // Without waiting. False: there is none.
  bool tryToTake() {
    const std::lock_guard lock(mutex_);
    if (count_ == 0) return false;
    --count_;
    return true;
  }

 private:
  std::mutex mutex_;
  std::condition_variable given_;
  int count_ = 0;
};

}  // namespace roomlight::test
