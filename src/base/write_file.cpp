#include "base/write_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <vector>

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

int writeSynced(const std::filesystem::path& file, std::string_view bytes) {
  const int out = ::open(file.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
  if (out < 0) return errno;
  int reason = 0;
  while (!bytes.empty() && reason == 0) {
    const ssize_t written = ::write(out, bytes.data(), bytes.size());
    if (written > 0) bytes.remove_prefix(static_cast<size_t>(written));
    if (written < 0 && errno != EINTR) reason = errno;
  }
  if (reason == 0 && ::fsync(out) != 0) reason = errno;
  if (::close(out) != 0 && reason == 0) reason = errno;
  return reason;
}

namespace {

constexpr int kMostAttempts = 100;

bool isFileAt(const std::filesystem::path& path, int file) {
  struct stat ours, there;
  return ::fstat(file, &ours) == 0 && ::stat(path.c_str(), &there) == 0 && ours.st_dev == there.st_dev &&
         ours.st_ino == there.st_ino;
}

struct Hold {
  std::vector<std::filesystem::path> made;  // the innermost first
  std::filesystem::path lock;
  int file = -1;  // open and locked

  Hold() = default;
  Hold(const Hold&) = delete;
  Hold& operator=(const Hold&) = delete;
  ~Hold() {
    // Removed while it is locked: who has opened it meanwhile sees that it is gone.
    if (file >= 0 && isFileAt(lock, file)) ::unlink(lock.c_str());
    if (file >= 0) ::close(file);
    for (const std::filesystem::path& folder : made) ::rmdir(folder.c_str());  // not where there is something in it
  }
};

// The folder and those around it that are not there yet.
std::vector<std::filesystem::path> missing(const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> out;
  std::error_code code;
  std::filesystem::path path = std::filesystem::absolute(folder, code);
  if (!path.has_filename()) path = path.parent_path();
  for (; path.has_filename() && std::filesystem::status(path, code).type() == std::filesystem::file_type::not_found;
       path = path.parent_path())
    out.push_back(path);
  return out;
}

}  // namespace

Result<HeldFolder> holdFolder(const std::filesystem::path& folder) {
  const auto hold = std::make_shared<Hold>();
  hold->made = missing(folder), hold->lock = folder / ".lock";
  // Who held it last takes the lock along, and perhaps the folder: then once more.
  for (int attempt = 0; attempt < kMostAttempts; ++attempt) {
    std::error_code code;
    std::filesystem::create_directories(folder, code);
    if (code) return Error{fmt::format("{}: cannot be made: {}", folder.string(), code.message())};
    const int file = ::open(hold->lock.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
    if (file < 0 && errno == ENOENT && attempt + 1 < kMostAttempts) continue;
    if (file < 0) return cannotWrite(folder, errno);
    const int reason = ::flock(file, LOCK_EX | LOCK_NB) == 0 ? 0 : errno;
    if (reason == 0 && isFileAt(hold->lock, file)) {
      hold->file = file;
      return HeldFolder(hold);
    }
    ::close(file);
    if (reason == EWOULDBLOCK) break;
    if (reason != 0) return Error{fmt::format("{}: cannot be locked: {}", hold->lock.string(), std::strerror(reason))};
  }
  return HeldFolder();
}

}  // namespace roomlight
