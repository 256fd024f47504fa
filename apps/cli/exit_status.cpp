#include "exit_status.h"

#include <unistd.h>

#include <csignal>
#include <initializer_list>

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
  if (gInterrupted.exchange(true)) _exit(kInterrupted);
}

bool isIgnored(int number) {
  struct sigaction now = {};
  return sigaction(number, nullptr, &now) == 0 && now.sa_handler == SIG_IGN;
}

}  // namespace

const std::atomic<bool>& interrupted() {
  static const bool installed = [] {
    struct sigaction action = {};
    action.sa_handler = onInterrupt;
    action.sa_flags = SA_RESTART;  // a file that is being read or written is not cut short
    for (const int number : {SIGINT, SIGTERM}) sigaction(number, &action, nullptr);
    if (!isIgnored(SIGHUP)) sigaction(SIGHUP, &action, nullptr);  // nohup: it is to go on
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
