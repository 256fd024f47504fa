// Ctrl-C, SIGTERM or a closed terminal: the first asks the work to finish with what it has, the second ends the program
// at once.
#pragma once

#include <atomic>

namespace roomlight::cli {

// Becomes true at the first SIGINT, SIGTERM or SIGHUP (unless that is ignored, as by nohup). Installs the handler on
// the first call.
const std::atomic<bool>& interrupted();

}  // namespace roomlight::cli
