#include "view/start_thread.h"

#include <fmt/format.h>

namespace roomlight::view {

std::thread systemThread(std::function<void()> work) { return std::thread(std::move(work)); }

std::string noThreadWords(const std::system_error& e) {
  return fmt::format("no thread can be started: {}; end other programs, or allow more processes (ulimit -u)",
                     e.code().message());
}

Result<std::thread> tryToStart(const StartThread& start, std::function<void()> work) {
  try {
    return start(std::move(work));
  } catch (const std::system_error& e) {
    return Error{noThreadWords(e)};
  }
}

}  // namespace roomlight::view
