#include "commands.h"

#include <fmt/format.h>
#include <sys/resource.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstring>

namespace roomlight::cli {
namespace {

constexpr double kLeastBytes = 64 << 20;  // less than the program itself needs

std::string gLimit;  // as it was given

// "2GB", "1.5 GiB", "800MB"; below 0: not a size.
double bytesOf(const std::string& text) {
  size_t end = 0;
  double value = -1;
  try {
    value = std::stod(text, &end);
  } catch (const std::exception&) {
    return -1;
  }
  const size_t unit = text.find_first_not_of(' ', end);
  const std::string name = unit == std::string::npos ? "" : text.substr(unit);
  const struct {
    const char* name;
    double bytes;
  } units[] = {{"MB", 1e6}, {"MiB", 1 << 20}, {"GB", 1e9}, {"GiB", 1 << 30}};
  for (const auto& u : units) {
    if (name == u.name && std::isfinite(value) && value > 0) return value * u.bytes;
  }
  return -1;
}

std::string limited(const std::string& text) {
  const double bytes = bytesOf(text);
  if (bytes < 0) return fmt::format("--memory {}: write a size such as 2GB or 800MB", text);
  if (bytes < kLeastBytes) return fmt::format("--memory {}: give at least 64MiB", text);
  rlimit limit{};
  getrlimit(RLIMIT_DATA, &limit);
  limit.rlim_cur = static_cast<rlim_t>(std::min(bytes, 9e18));
  if (limit.rlim_max != RLIM_INFINITY) limit.rlim_cur = std::min(limit.rlim_cur, limit.rlim_max);
  if (setrlimit(RLIMIT_DATA, &limit) != 0) return fmt::format("--memory {}: {}", text, std::strerror(errno));
  gLimit = text;
  return "";
}

}  // namespace

void addMemoryLimit(CLI::App& command) {
  command.add_option_function<std::string>(
      "--memory",
      [](const std::string& text) {
        if (const std::string wrong = limited(text); !wrong.empty()) throw CLI::ValidationError(wrong);
      },
      "Most memory to take, such as 2GB; the command ends with one line rather than take more");
}

std::string outOfMemoryWords() {
  return fmt::format(
      "not enough memory{}; a smaller --size, larger voxels (voxel.voxelSizeM) or fewer triangles take "
      "less",
      gLimit.empty() ? "" : fmt::format(" within --memory {}", gLimit));
}

}  // namespace roomlight::cli
