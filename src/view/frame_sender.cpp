#include "view/frame_sender.h"

#include <fmt/format.h>

#include <exception>
#include <utility>

#include "base/parallel.h"

namespace roomlight::view {
namespace {

// One that fails does not end the others.
Result<std::string> made(const FrameSender::Make& make) {
  try {
    return make();
  } catch (const std::exception& e) {
    return Error{fmt::format("a frame could not be made: {}", e.what())};
  }
}

}  // namespace

FrameSender::FrameSender(const StartThread& start) {
  thread_ = start([this] { withThreads(1, [this] { run(); }); });
}

FrameSender::~FrameSender() {
  {
    const std::lock_guard lock(mutex_);
    stop_ = true;
  }
  wake_.notify_all();
  thread_.join();
}

void FrameSender::push(Make make, Send send) {
  {
    const std::lock_guard lock(mutex_);
    waiting_.emplace_back(std::move(make), std::move(send));
  }
  wake_.notify_all();
}

void FrameSender::run() {
  for (;;) {
    std::pair<Make, Send> next;
    {
      std::unique_lock lock(mutex_);
      wake_.wait(lock, [this] { return stop_ || !waiting_.empty(); });
      if (stop_) return;
      next = std::move(waiting_.front());
      waiting_.pop_front();
    }
    next.second(made(next.first));
  }
}

}  // namespace roomlight::view
