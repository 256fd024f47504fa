#include "arguments.h"
#include "commands.h"

#include <fmt/format.h>

#include <cstring>

#include "base/platform/machine.h"

namespace roomlight::cli {
namespace {

constexpr double kLeastBytes = 64 << 20;  // less than the program itself needs

std::string gLimit;  // as it was given

std::string limited(const std::string& text) {
  const double bytes = parseBytes(text).value_or(-1);
  if (bytes < 0) return fmt::format("--memory {}: write a size such as 2GB or 800MB", text);
  if (bytes < kLeastBytes) return fmt::format("--memory {}: give at least 64MiB", text);
  if (const int reason = limitData(bytes); reason != 0)
    return fmt::format("--memory {}: {}", text, std::strerror(reason));
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
