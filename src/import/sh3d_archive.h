// The zip file that a Sweet Home 3D home is, or that a model inside it may be. Nothing it claims is believed before it
 // is checked.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "import/file_access.h"

struct zip;  // the library's

namespace roomlight::importers {

// Limits of one archive; what is unpacked counts against `totalBytes` as it is read.
struct ArchiveLimits {
  size_t entries = 100'000;
  size_t entryBytes = size_t{1} << 30;
  size_t totalBytes = size_t{4} << 30;
  size_t ratio = 1100;             // unpacked to packed; deflate reaches 1032
  size_t largeBytes = 64 << 20;    // entries above are models and pictures, which do not pack as tightly as that
  size_t largeRatio = 200;         // of those
};

class Archive {
 public:
  // Lists the entries. Throws Failure: no zip file, damaged, more entries than the limit. `bytes` must outlive the
// archive.
  Archive(std::span<const uint8_t> bytes, const std::string& place, const ArchiveLimits& limits = {});
  ~Archive();
  Archive(const Archive&) = delete;
  Archive& operator=(const Archive&) = delete;

  // Names of the files in it, normalised: '/' between folders, no "." and no empty parts. Names that climb out ("..")
  // or are absolute are left out and counted in refused().
  const std::vector<std::string>& names() const { return names_; }
  size_t refused() const { return refused_; }
  bool has(std::string_view name) const;
  size_t sizeOf(std::string_view name) const;  // unpacked, as the archive claims; 0 where it does not say
  std::vector<std::string> namesIn(std::string_view folder) const;  // that begin with it ("3/"), sorted

  // The unpacked entry; none where there is no such entry. A name with percent escapes also means the entry of the name
  // without them. Throws Failure: damaged, encrypted, or beyond a limit. Several threads may read at a time.
  std::optional<Bytes> read(std::string_view name) const;

 private:
  struct State;
  Bytes unpacked(zip* zip, uint64_t index, const std::string& place) const;
  std::optional<uint64_t> indexOf(std::string_view name) const;
  std::unique_ptr<State> state_;
  std::vector<std::string> names_;
  size_t refused_ = 0;
};

// '\' to '/', without "." and empty parts; none where the name climbs out, is absolute, has a drive or holds a NUL.
std::optional<std::string> normalisedEntryName(std::string_view name);

}  // namespace roomlight::importers
