#include "base/write_file.h"

#include <fmt/format.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <vector>

#include "base/platform/files.h"
#include "base/platform/process.h"

namespace roomlight {

std::filesystem::path unfinishedName(std::filesystem::path file) {
  file += fmt::format(".part-{}", processNumber());
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

namespace {

constexpr int kMostAttempts = 100;

struct Hold {
  std::vector<std::filesystem::path> made;  // the innermost first
  LockedFile lock;

  Hold() = default;
  Hold(const Hold&) = delete;
  Hold& operator=(const Hold&) = delete;
  ~Hold() {
    lock.letGo();
    for (const std::filesystem::path& folder : made) removeIfEmpty(folder);
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
  const std::filesystem::path lock = folder / ".lock";
  hold->made = missing(folder);
  // Who held it last takes the lock along, and perhaps the folder: then once more.
  for (int attempt = 0; attempt < kMostAttempts; ++attempt) {
    std::error_code code;
    std::filesystem::create_directories(folder, code);
    if (code) return Error{fmt::format("{}: cannot be made: {}", folder.string(), code.message())};
    int reason = 0;
    const LockedFile::Outcome outcome = hold->lock.take(lock, reason);
    if (outcome == LockedFile::Outcome::Held) return HeldFolder(hold);
    if (outcome == LockedFile::Outcome::HeldByAnother) break;
    const bool isLast = attempt + 1 == kMostAttempts;
    if (outcome == LockedFile::Outcome::NotOpened || (reason != 0 && isLast && outcome == LockedFile::Outcome::Gone))
      return cannotWrite(folder, reason);
    if (outcome == LockedFile::Outcome::NotLocked)
      return Error{fmt::format("{}: cannot be locked: {}", lock.string(), std::strerror(reason))};
  }
  return HeldFolder();
}

}  // namespace roomlight
