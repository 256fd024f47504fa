#include "base/write_file.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <fstream>

namespace roomlight {

std::filesystem::path unfinishedName(std::filesystem::path file) {
  file += fmt::format(".part-{}", getpid());
  return file;
}

Error cannotWrite(const std::filesystem::path& file, int errorNumber) {
  return {fmt::format("{}: cannot be written: {}", file.string(), std::strerror(errorNumber))};
}

Status writeWhole(const std::filesystem::path& file, std::string_view bytes) {
  const std::filesystem::path part = unfinishedName(file);
  errno = 0;
  std::ofstream out(part, std::ios::binary);
  out.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  out.close();
  std::error_code code;
  if (out) std::filesystem::rename(part, file, code);
  if (out && !code) return Ok{};
  const int reason = code ? code.value() : errno;
  std::filesystem::remove(part, code);
  return cannotWrite(file, reason);
}

}  // namespace roomlight
