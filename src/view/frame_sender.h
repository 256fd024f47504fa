// Shows, packs and sends frames in the background, in their order, while the next are made.
#pragma once

#include <condition_variable>
#include <deque>
#include <functional>
#include <mutex>
#include <string>
#include <thread>

#include "base/result.h"
#include "view/start_thread.h"

namespace roomlight::view {

class FrameSender {
 public:
  using Make = std::function<Result<std::string>()>;
  using Send = std::function<void(Result<std::string> bytes)>;
  // Throws std::system_error where there is no thread.
  explicit FrameSender(const StartThread& start = systemThread);
  ~FrameSender();  // what has not been begun is not sent
  // Both are called from the sender's thread.
  void push(Make make, Send send);

 private:
  void run();

  std::mutex mutex_;
  std::condition_variable wake_;
  std::deque<std::pair<Make, Send>> waiting_;
  bool stop_ = false;
  std::thread thread_;  // last: it uses all of the above
};

}  // namespace roomlight::view
