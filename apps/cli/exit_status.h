// How the program ends.
#pragma once

namespace roomlight::cli {

constexpr int kOk = 0;
constexpr int kFailed = 1;       // the work itself went wrong: a full disk
constexpr int kBadInput = 2;     // a file or an option; nothing was written
constexpr int kNoRoom = 3;       // memory, or what else of this machine, does not do for it
constexpr int kInterrupted = 130;

}  // namespace roomlight::cli
