#include "base/platform/system_facts.h"

#include <charconv>
#include <fstream>

namespace roomlight {

std::string systemValue(const char* file, const std::string& key) {
  std::ifstream in(file);
  for (std::string line; std::getline(in, line);) {
    if (!line.starts_with(key)) continue;
    const size_t from = line.find_first_not_of(" \t:", key.size());
    return from == std::string::npos ? "" : line.substr(from);
  }
  return {};
}

std::optional<double> memoryBytes(const std::string& key) {
  const std::string text = systemValue("/proc/meminfo", key + ":");
  double kib = 0;
  if (std::from_chars(text.data(), text.data() + text.size(), kib).ec != std::errc()) return std::nullopt;
  return 1024 * kib;
}

}  // namespace roomlight
