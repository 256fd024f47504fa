#include "output_files.h"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <iterator>

#include "base/platform/files.h"
#include "base/write_file.h"

namespace roomlight::cli {
namespace {

constexpr uintmax_t kLargestTextBytes = 64u << 20;

}  // namespace

Status checkWritable(const std::filesystem::path& file) {
  std::error_code ignored;
  if (std::filesystem::is_directory(file, ignored))
    return Error{fmt::format("{}: is a folder; name a file", file.string())};
  // Trying is the only test that knows of read-only disks, rights and names that are too long.
  const std::filesystem::path probe = unfinishedName(file);
  if (const int reason = makeNew(probe); reason != 0) return cannotWrite(file, reason);
  std::filesystem::remove(probe, ignored);
  return Ok{};
}

std::vector<std::string> filesNamedAfter(const std::string& file, const std::vector<std::string>& things) {
  if (things.size() == 1) return {file};
  const std::filesystem::path path(file);
  std::vector<std::string> names, files;
  for (const std::string& thing : things) {
    std::string plain;
    for (const char c : thing) {
      const bool odd = static_cast<unsigned char>(c) <= ' ' || c == '\x7f' || std::strchr("/\\:*?\"<>|", c);
      plain += odd ? '_' : c;
    }
    std::string name = plain;
    for (int number = 2; std::find(names.begin(), names.end(), name) != names.end(); ++number)
      name = fmt::format("{}_{}", plain, number);
    names.push_back(name);
    files.push_back(
        (path.parent_path() / fmt::format("{}_{}{}", path.stem().string(), name, path.extension().string())).string());
  }
  return files;
}

Result<std::string> readTextFile(const std::filesystem::path& file) {
  std::error_code code;
  if (!std::filesystem::is_regular_file(file, code)) return Error{fmt::format("{}: no such file", file.string())};
  if (std::filesystem::file_size(file, code) > kLargestTextBytes)
    return Error{fmt::format("{}: larger than 64 MiB", file.string())};
  std::ifstream in(file, std::ios::binary);
  if (!in) return Error{fmt::format("{}: cannot be read: {}", file.string(), std::strerror(errno))};
  return std::string{std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

Json stagesJson(std::span<const StageStats> stages) {
  Json list = Json::array();
  for (const StageStats& s : stages)
    list.push_back({{"name", s.name}, {"timeMs", s.timeMs}, {"cpuMs", s.cpuMs}, {"peakMemoryMiB", s.peakMemoryMiB}});
  return list;
}

}  // namespace roomlight::cli
