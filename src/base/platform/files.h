// What std::filesystem does not do with files: sync, lock, make exclusively, ask the file server. Errors are the
// system's numbers (errno); 0: done.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string_view>
#include <vector>

namespace roomlight {

// Written and on the disk, under this name; what stood there is lost.
int writeSynced(const std::filesystem::path& file, std::string_view bytes);

// What is there already is on the disk after this; done too where the file system syncs nothing of that kind.
int syncFile(const std::filesystem::path& file);
int syncFolder(const std::filesystem::path& folder);

// Makes an empty file; an error where the name is taken.
int makeNew(const std::filesystem::path& file);

// What a pattern with * ? [] in any of its names stands for, sorted by name.
std::vector<std::filesystem::path> filesNamedLike(const std::filesystem::path& pattern);

// Each name in a folder, as it comes; quicker than std::filesystem, which asks what each is.
void forEachName(const std::filesystem::path& folder, const std::function<void(std::string_view name)>& take);

void removeIfEmpty(const std::filesystem::path& folder);

// Whether this user may run it as a program.
bool isExecutable(const std::filesystem::path& file);

// A new folder in that for temporary files, for its owner alone, called so and something that no other is. Empty: none.
std::filesystem::path makeTemporaryFolder(std::string_view name);

struct FileFacts {
  double modifiedS = 0;  // by the clock of the file server, since 1970
  uint64_t links = 0;  // names that the file has
};
std::optional<FileFacts> factsOf(const std::filesystem::path& file);

// Modified now, by the clock of the file server.
void touch(const std::filesystem::path& file);
// That clock's time in seconds since 1970; by a file of this name, which is gone afterwards.
std::optional<double> fileServerTime(const std::filesystem::path& probe);

// Renames a folder. `taken`: whether it could not since there is something at `to`.
int renameFolder(const std::filesystem::path& from, const std::filesystem::path& to, bool& taken);

// A file that one holder at a time has open and locked, among all processes and in this one. It is removed when it is
// let go.
class LockedFile {
 public:
  enum class Outcome { Held, HeldByAnother, Gone, NotOpened, NotLocked };

  LockedFile() = default;
  ~LockedFile() { letGo(); }
  LockedFile(const LockedFile&) = delete;
  LockedFile& operator=(const LockedFile&) = delete;

  // Once, at most. Gone: the file, or its folder, was taken away meanwhile; `error` is of the last two.
  Outcome take(const std::filesystem::path& file, int& error);
  void letGo();

 private:
  std::filesystem::path path_;
  int file_ = -1;
};

}  // namespace roomlight
