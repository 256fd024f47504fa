#include "interrupt.h"

#include <csignal>
#include <unistd.h>

#include "commands.h"

namespace roomlight::cli {
namespace {

std::atomic<bool> gInterrupted{false};
static_assert(std::atomic<bool>::is_always_lock_free, "set from a signal handler");

void onInterrupt(int) {
  if (gInterrupted.exchange(true)) _exit(kInterrupted);
}

}  // namespace

const std::atomic<bool>& interrupted() {
  static const bool installed = [] {
    struct sigaction action = {};
    action.sa_handler = onInterrupt;
    action.sa_flags = SA_RESTART;  // a file that is being read or written is not cut short
    sigaction(SIGINT, &action, nullptr);
    return true;
  }();
  static_cast<void>(installed);
  return gInterrupted;
}

}  // namespace roomlight::cli
