// A machine on which there are threads, or none.
#pragma once

#include <atomic>
#include <system_error>
#include <thread>

#include "view/start_thread.h"

namespace roomlight::test {

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

}  // namespace roomlight::test
