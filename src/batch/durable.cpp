#include "batch/durable.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cctype>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <fstream>
#include <iterator>

#include "base/write_file.h"

namespace roomlight::batch {
namespace {

namespace fs = std::filesystem;

Status syncOne(const fs::path& path, int flags) {
  const int file = open(path.c_str(), O_RDONLY | O_CLOEXEC | flags);
  if (file < 0) return cannotWrite(path, errno);
  // Some file systems sync no folders; those order renames by themselves.
  const bool done = fsync(file) == 0 || errno == EINVAL || errno == EROFS;
  const int reason = errno;
  close(file);
  return done ? Status(Ok{}) : cannotWrite(path, reason);
}

}  // namespace

std::string processToken() {
  static const std::string host = [] {
    char whole[256] = "host";
    gethostname(whole, sizeof whole - 1);
    std::string name;
    for (const char* c = whole; *c && *c != '.'; ++c) name += std::isalnum(static_cast<unsigned char>(*c)) ? *c : '-';
    return name;
  }();
  static const auto start = std::chrono::steady_clock::now().time_since_epoch().count() & 0xffffffff;
  return fmt::format("{}-{}-{:x}", host, getpid(), start);  // a child by fork() has one of its own
}

Status writeDurably(const fs::path& file, std::string_view bytes) {
  const fs::path part = file.string() + "." + processToken() + ".part";
  const int reason = writeSynced(part, bytes);
  Status status = reason == 0 ? Status(Ok{}) : cannotWrite(part, reason);
  std::error_code code;
  if (status) {
    fs::rename(part, file, code);
    if (code) status = cannotWrite(file, code.value());
  }
  if (status) return syncOne(file.parent_path(), O_DIRECTORY);
  fs::remove(part, code);
  return status;
}

Status syncTree(const fs::path& folder) {
  std::error_code code;
  for (fs::recursive_directory_iterator it(folder, code), end; !code && it != end; it.increment(code)) {
    if (it->is_symlink()) continue;
    if (const Status s = syncOne(it->path(), it->is_directory() ? O_DIRECTORY : 0); !s) return s;
  }
  return code ? Status(cannotWrite(folder, code.value())) : syncOne(folder, O_DIRECTORY);
}

Status publishFolder(const fs::path& from, const fs::path& to) {
  std::error_code code;
  if (rename(from.c_str(), to.c_str()) != 0) {
    const int reason = errno;
    if (reason != ENOTEMPTY && reason != EEXIST) return cannotWrite(to, reason);
    fs::remove_all(from, code);
  }
  return syncOne(to.parent_path(), O_DIRECTORY);
}

std::string textOf(const fs::path& file) {
  std::error_code code;
  if (!fs::is_regular_file(file, code)) return {};
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

bool tellsOfFullDisk(std::string_view line) {
  return line.find(std::strerror(ENOSPC)) != std::string_view::npos ||
         line.find(std::strerror(EDQUOT)) != std::string_view::npos;
}

}  // namespace roomlight::batch
