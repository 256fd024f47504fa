#include "exit_status.h"

#include <cstdlib>

#include "base/platform/terminal.h"
#include "commands.h"

namespace roomlight::cli {
namespace {

std::atomic<bool> gInterrupted{false};
std::atomic<int> gSignal{0};  // the first
static_assert(std::atomic<bool>::is_always_lock_free && std::atomic<int>::is_always_lock_free,
              "set from a signal handler");

void onInterrupt(int number) {
  int none = 0;
  gSignal.compare_exchange_strong(none, number);
  if (gInterrupted.exchange(true)) std::_Exit(kInterrupted);
}

}  // namespace

const std::atomic<bool>& interrupted() {
  static const bool installed = [] {
    onInterruption(onInterrupt);
    return true;
  }();
  static_cast<void>(installed);
  return gInterrupted;
}

int interruptStatus() {
  constexpr int kSignals = 128;
  return gSignal == 0 ? kInterrupted : kSignals + gSignal;
}

}  // namespace roomlight::cli
