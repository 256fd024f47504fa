// Threads of tests: on a machine that has them or none, and how they wait for one another.
#pragma once

#include <atomic>
#include <condition_variable>
#include <mutex>
#include <system_error>
#include <thread>

#include "view/executor.h"

namespace roomlight::test {

// A machine on which there are threads, or none.
class Threads {
 public:
  std::atomic<bool> none{false};

  // Refers to this.
  view::StartThread starter() {
    return [this](std::function<void()> work) {
      if (none) throw std::system_error(std::make_error_code(std::errc::resource_unavailable_try_again));
      return std::thread(std::move(work));
    };
  }
};

// What one thread of a test waits for and another gives: no more is taken than was given.
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
