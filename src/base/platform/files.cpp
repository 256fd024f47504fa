#include "base/platform/files.h"

#if defined(__unix__) || defined(__APPLE__)

#include <dirent.h>
#include <fcntl.h>
#include <glob.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <string>

namespace roomlight {
namespace {

int syncOne(const std::filesystem::path& path, int flags) {
  const int file = ::open(path.c_str(), O_RDONLY | O_CLOEXEC | flags);
  if (file < 0) return errno;
  // Some file systems sync no folders; those order renames by themselves.
  const bool done = ::fsync(file) == 0 || errno == EINVAL || errno == EROFS;
  const int reason = errno;
  ::close(file);
  return done ? 0 : reason;
}

double modifiedS(const struct stat& about) {
#ifdef __APPLE__
  const timespec& t = about.st_mtimespec;
#else
  const timespec& t = about.st_mtim;
#endif
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

bool isFileAt(const std::filesystem::path& path, int file) {
  struct stat ours, there;
  return ::fstat(file, &ours) == 0 && ::stat(path.c_str(), &there) == 0 && ours.st_dev == there.st_dev &&
         ours.st_ino == there.st_ino;
}

}  // namespace

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

int syncFile(const std::filesystem::path& file) { return syncOne(file, 0); }
int syncFolder(const std::filesystem::path& folder) { return syncOne(folder, O_DIRECTORY); }

int makeNew(const std::filesystem::path& file) {
  const int made = ::open(file.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
  if (made < 0) return errno;
  ::close(made);
  return 0;
}

std::vector<std::filesystem::path> filesNamedLike(const std::filesystem::path& pattern) {
  std::vector<std::filesystem::path> out;
  glob_t found{};
  if (::glob(pattern.c_str(), 0, nullptr, &found) == 0) out.assign(found.gl_pathv, found.gl_pathv + found.gl_pathc);
  ::globfree(&found);
  return out;
}

void forEachName(const std::filesystem::path& folder, const std::function<void(std::string_view name)>& take) {
  DIR* const names = ::opendir(folder.c_str());
  if (!names) return;
  while (const dirent* entry = ::readdir(names)) take(entry->d_name);
  ::closedir(names);
}

void removeIfEmpty(const std::filesystem::path& folder) { ::rmdir(folder.c_str()); }

bool isExecutable(const std::filesystem::path& file) { return ::access(file.c_str(), X_OK) == 0; }

std::filesystem::path makeTemporaryFolder(std::string_view name) {
  std::error_code code;
  std::string pattern = (std::filesystem::temp_directory_path(code) / name).string() + "-XXXXXX";
  if (code || !::mkdtemp(pattern.data())) return {};
  return pattern;
}

std::optional<FileFacts> factsOf(const std::filesystem::path& file) {
  struct stat about {};
  if (::stat(file.c_str(), &about) != 0) return std::nullopt;
  return FileFacts{modifiedS(about), about.st_nlink};
}

void touch(const std::filesystem::path& file) { ::utimensat(AT_FDCWD, file.c_str(), nullptr, 0); }

std::optional<double> fileServerTime(const std::filesystem::path& probe) {
  const int file = ::open(probe.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC, 0666);
  if (file < 0) return std::nullopt;
  struct stat about {};
  const bool known = ::futimens(file, nullptr) == 0 && ::fstat(file, &about) == 0;
  ::close(file), ::unlink(probe.c_str());
  return known ? std::optional(modifiedS(about)) : std::nullopt;
}

int renameFolder(const std::filesystem::path& from, const std::filesystem::path& to, bool& taken) {
  const int reason = ::rename(from.c_str(), to.c_str()) == 0 ? 0 : errno;
  taken = reason == ENOTEMPTY || reason == EEXIST;
  return reason;
}

void LockedFile::letGo() {
  if (file_ < 0) return;
  // Removed while it is locked: who has opened it meanwhile sees that it is gone.
  if (isFileAt(path_, file_)) ::unlink(path_.c_str());
  ::close(file_);
  file_ = -1;
}

LockedFile::Outcome LockedFile::take(const std::filesystem::path& path, int& error) {
  const int file = ::open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
  if (file < 0) {
    error = errno;
    return error == ENOENT ? Outcome::Gone : Outcome::NotOpened;
  }
  error = ::flock(file, LOCK_EX | LOCK_NB) == 0 ? 0 : errno;
  if (error == 0 && isFileAt(path, file)) {
    path_ = path, file_ = file;
    return Outcome::Held;
  }
  ::close(file);
  return error == 0 ? Outcome::Gone : error == EWOULDBLOCK ? Outcome::HeldByAnother : Outcome::NotLocked;
}

}  // namespace roomlight

#endif
