#include "engine/stages.h"

#include <sys/resource.h>

#include <fstream>
#include <sstream>

namespace roomlight {

double peakMemoryMiB() {
  // Not ru_maxrss where it can be helped: it starts from what the parent process held before exec.
  std::ifstream status("/proc/self/status");
  for (std::string line; std::getline(status, line);) {
    if (line.rfind("VmHWM:", 0) != 0) continue;
    double kibibytes = 0;
    std::istringstream(line.substr(6)) >> kibibytes;
    return kibibytes / 1024;
  }
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / 1024;
}

}  // namespace roomlight
