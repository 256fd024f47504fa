// Parallel loops over oneTBB, and the cap on threads. Loops are written so that results do not depend on the number
// of threads: each index writes its own output, reductions happen in index order.
#pragma once

#include <cstddef>
#include <functional>

namespace roomlight {

// Runs body(begin, end) over sub-ranges of [0, count) of about `grain` indices, on the threads allowed.
void parallelRanges(size_t count, size_t grain, const std::function<void(size_t, size_t)>& body);

// Runs body(i) for every i in [0, count).
template <class Body>
void parallelFor(size_t count, size_t grain, Body&& body) {
  parallelRanges(count, grain, [&](size_t begin, size_t end) {
    for (size_t i = begin; i < end; ++i) body(i);
  });
}

// Runs work() with at most `threads` threads in every parallel loop inside; 0 means all cores.
void withThreads(int threads, const std::function<void()>& work);

// The same for work that nobody waits for: loops started elsewhere go first, and the calling thread gives way to others
// from then on.
void inBackground(int threads, const std::function<void()>& work);

// How many threads a loop started here would use.
int threadCount();

}  // namespace roomlight
