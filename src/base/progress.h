// How long work reports progress and hears that it should stop. Both members may be empty.
#pragma once

#include <atomic>
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

}  // namespace roomlight
