// A folder of results that several processes keep for one another as sealed files, up to a size of all together.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

#include "base/progress.h"
#include "base/result.h"
#include "base/write_file.h"

namespace roomlight {

// Nothing is held between calls; files of the folder that are not its own stay untouched. Names are hashes in
// hexadecimal (Hash::text()), with hyphens between several.
class SharedFiles {
 public:
  // The folder is made once there is something to keep. `kind` is what its files end in, with a dot.
  SharedFiles(std::filesystem::path folder, std::string kind, uint64_t mostBytes)
      : folder_(std::move(folder)), kind_(std::move(kind)), mostBytes_(mostBytes) {}

  // What was kept under the name, which counts as used now; none where nothing was. The error is of a file that was not
  // as it was written, and has been removed.
  Result<std::optional<std::string>> find(const std::string& name) const;
  bool has(const std::string& name) const;

  // On the disk, then under its name: whole or not at all. Then those used longest ago are removed until all together
  // are within the size; they may be read meanwhile. Errors: what cannot be written, or is larger than that alone.
  Status keep(const std::string& name, std::string bytes) const;

  // Waits while another process makes what is to be kept under the name, until that is there, for `seconds` at most.
  // What comes back is to be held while it is made here. Null: it is there, or time is over, or there is no way to
  // tell others; two that make the same do no harm. A process that ends, however it does, no longer holds it.
  HeldFolder turn(const std::string& name, double seconds, const Progress& progress) const;

 private:
  std::filesystem::path fileOf(const std::string& name) const { return folder_ / (name + kind_); }
  void removeOldest() const;
  void removeLeftovers() const;

  std::filesystem::path folder_;
  std::string kind_;
  uint64_t mostBytes_;
};

}  // namespace roomlight
