// Ctrl-C: the first asks the work to finish with what it has, the second ends the program at once.
#pragma once

#include <atomic>

namespace roomlight::cli {

// Becomes true at the first SIGINT. Installs the handler on the first call.
const std::atomic<bool>& interrupted();

}  // namespace roomlight::cli
