#include "output_files.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <iterator>

namespace roomlight::cli {
namespace {

constexpr uintmax_t kLargestTextBytes = 64u << 20;

// The name under which the picture writers, too, keep an unfinished file.
std::filesystem::path unfinished(std::filesystem::path file) {
  file += fmt::format(".part-{}", getpid());
  return file;
}

Error systemError(const std::filesystem::path& file, int code) {
  return {fmt::format("{}: cannot be written: {}", file.string(), std::strerror(code))};
}

}  // namespace

Status checkWritable(const std::filesystem::path& file) {
  std::error_code ignored;
  if (std::filesystem::is_directory(file, ignored)) return Error{fmt::format("{}: is a folder; name a file", file.string())};
  // Trying is the only test that knows of read-only disks, rights and names that are too long.
  const std::filesystem::path probe = unfinished(file);
  const int handle = open(probe.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
  if (handle < 0) return systemError(file, errno);
  close(handle);
  unlink(probe.c_str());
  return Ok{};
}

Status writeTextFile(const std::filesystem::path& file, const std::string& text) {
  const std::filesystem::path part = unfinished(file);
  std::ofstream out(part, std::ios::binary);
  out << text << std::flush;
  out.close();
  std::error_code code;
  if (out) std::filesystem::rename(part, file, code);
  if (out && !code) return Ok{};
  const int reason = code ? code.value() : errno;
  std::filesystem::remove(part, code);
  return systemError(file, reason);
}

Result<std::string> readTextFile(const std::filesystem::path& file) {
  std::error_code code;
  if (!std::filesystem::is_regular_file(file, code)) return Error{fmt::format("{}: no such file", file.string())};
  if (std::filesystem::file_size(file, code) > kLargestTextBytes) return Error{fmt::format("{}: larger than 64 MiB", file.string())};
  std::ifstream in(file, std::ios::binary);
  if (!in) return Error{fmt::format("{}: cannot be read: {}", file.string(), std::strerror(errno))};
  return std::string{std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

}  // namespace roomlight::cli
