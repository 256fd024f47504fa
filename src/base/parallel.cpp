#include "base/parallel.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/partitioner.h>
#include <tbb/task_arena.h>

#include "base/platform/flush_to_zero.h"
#include "base/platform/machine.h"

namespace roomlight {

// Halved down to the grain whoever is free to help. By another partitioner the ranges would depend on threads and on
// what else the machine does, and with them the packets of rays that are traced together and the last bits of results.
void parallelRanges(size_t count, size_t grain, const std::function<void(size_t, size_t)>& body) {
  if (count == 0) return;
  const auto one = [&](const tbb::blocked_range<size_t>& r) {
    const FlushToZero flushing;
    body(r.begin(), r.end());
  };
  tbb::parallel_for(tbb::blocked_range<size_t>(0, count, grain ? grain : 1), one, tbb::simple_partitioner());
}

void withThreads(int threads, const std::function<void()>& work) {
  tbb::task_arena arena(threads > 0 ? threads : tbb::task_arena::automatic);
  arena.execute(work);
}

void inBackground(int threads, const std::function<void()>& work) {
  giveWay();
  tbb::task_arena arena(threads > 0 ? threads : tbb::task_arena::automatic, 1, tbb::task_arena::priority::low);
  arena.execute(work);
}

int threadCount() { return tbb::this_task_arena::max_concurrency(); }

}  // namespace roomlight
