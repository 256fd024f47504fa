// What the system tells of this machine, in files such as /proc/meminfo.
#pragma once

#include <optional>
#include <string>

namespace roomlight {

// Of the first line of the file that starts so: what stands behind that and a colon. An empty key: the first line.
// Empty where there is none.
std::string systemValue(const char* file, const std::string& key);

// Bytes of the machine's memory by a key of /proc/meminfo, "MemTotal" or "MemAvailable".
std::optional<double> memoryBytes(const std::string& key);

}  // namespace roomlight
