// How the program ends: its exit status, and what interrupts it.
#pragma once

#include <atomic>

namespace roomlight::cli {

constexpr int kOk = 0;
constexpr int kFailed = 1;       // the work itself went wrong: a full disk
constexpr int kBadInput = 2;     // a file or an option; nothing was written
constexpr int kNoRoom = 3;       // memory, or what else of this machine, does not do for it
constexpr int kInterrupted = 130;

// Ctrl-C, SIGTERM or a closed terminal: the first asks the work to finish with what it has, the second ends the program
// at once. Becomes true at the first SIGINT, SIGTERM or SIGHUP (unless that is ignored, as by nohup). Installs the
// handler on the first call.
const std::atomic<bool>& interrupted();
// 128 and the number of the signal that came first, as shells have it: 130 for Ctrl-C, 143 for SIGTERM; kInterrupted
// where none has come.
int interruptStatus();

}  // namespace roomlight::cli
