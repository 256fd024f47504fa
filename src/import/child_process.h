// Work that a hostile file could make crash, loop or fill the memory, in a process of its own.
#pragma once

#include <functional>

#include "import/file_access.h"

namespace roomlight::importers {

// What `work` returns, called in a child process with limits of time (60 s) and memory (8 GiB more). Throws Failure:
// what `work` threw, or that the child crashed or met a limit. `work` sees the memory as it is at the call and can
// change nothing of it.
Bytes inChildProcess(const std::function<Bytes()>& work);

}  // namespace roomlight::importers
