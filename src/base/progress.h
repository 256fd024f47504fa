// Long work: how it reports progress and hears that it should stop, and how long it takes.
#pragma once

#include <atomic>
#include <chrono>
#include <functional>

namespace roomlight {

struct Progress {
  std::function<void(float fraction)> report;     // 0..1 within the current stage; called from one thread at a time
  const std::atomic<bool>* cancelled = nullptr;   // when true, finish what is in hand and return the best so far

  bool stop() const { return cancelled && cancelled->load(std::memory_order_relaxed); }
  void at(float fraction) const {
    if (report) report(fraction);
  }
};

// Wall time since construction.
class Stopwatch {
 public:
  double seconds() const { return std::chrono::duration<double>(Clock::now() - start_).count(); }

 private:
  using Clock = std::chrono::steady_clock;
  Clock::time_point start_ = Clock::now();
};

}  // namespace roomlight
