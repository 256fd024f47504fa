// parallel.h over plain threads, in place of parallel.cpp under the thread sanitizer: it cannot see how oneTBB, a
// package built without it, hands work over, and would take every loop for a race. Here it sees all, and only threads'
// start and end order it.

#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <thread>
#include <utility>
#include <vector>

#include "base/parallel.h"
#include "base/platform/flush_to_zero.h"
#include "base/platform/machine.h"

namespace roomlight {
namespace {

thread_local int gMostThreads = 0;  // of withThreads; 0: all cores
thread_local bool gInLoop = false;  // loops inside loops run where they are

}  // namespace

void parallelRanges(size_t count, size_t grain, const std::function<void(size_t, size_t)>& body) {
  const size_t step = grain ? grain : 1, ranges = (count + step - 1) / step;
  std::atomic<size_t> next = 0;
  std::mutex failing;
  std::exception_ptr failure;  // the first one; goes on in the caller, as oneTBB has it
  const auto work = [&] {
    const FlushToZero flushing;
    const bool outer = std::exchange(gInLoop, true);
    try {
      for (size_t i; (i = next.fetch_add(1, std::memory_order_relaxed)) < ranges;)
        body(i * step, std::min(count, (i + 1) * step));
    } catch (...) {
      const std::lock_guard lock(failing);
      if (!failure) failure = std::current_exception();
      next = ranges;
    }
    gInLoop = outer;
  };
  const size_t threads = gInLoop ? 1 : std::min(ranges, static_cast<size_t>(threadCount()));
  {
    std::vector<std::jthread> others;
    for (size_t t = 1; t < threads; ++t) others.emplace_back(work);
    work();
  }
  if (failure) std::rethrow_exception(failure);
}

void withThreads(int threads, const std::function<void()>& work) {
  const int outer = std::exchange(gMostThreads, threads);
  work();
  gMostThreads = outer;
}

void inBackground(int threads, const std::function<void()>& work) {
  giveWay();
  withThreads(threads, work);
}

int threadCount() {
  return gMostThreads > 0 ? gMostThreads : std::max(2, static_cast<int>(std::thread::hardware_concurrency()));
}

}  // namespace roomlight
