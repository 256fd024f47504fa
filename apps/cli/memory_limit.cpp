#include "arguments.h"
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

std::string limited(const std::string& text) {
  const double bytes = parseBytes(text).value_or(-1);
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
