// What has been measured, on disk: a study that was stopped goes on where it was.
#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>

#include "base/result.h"

namespace roomlight {

class RunStore {
 public:
  // `folder` is made where it is not there.
  static Result<RunStore> open(const std::filesystem::path& folder);

  // A result is known by a readable name and by everything that it depends on. None where there is none, or one of other circumstances.
  std::optional<nlohmann::json> find(const std::string& name, const std::string& circumstances) const;
  Status keep(const std::string& name, const std::string& circumstances, const nlohmann::json& result) const;

  // A file beside the results, such as a picture.
  std::filesystem::path file(const std::string& name, const std::string& extension) const;
  const std::filesystem::path& folder() const { return folder_; }

 private:
  explicit RunStore(std::filesystem::path folder) : folder_(std::move(folder)) {}
  std::filesystem::path folder_;
};

// Letters, digits and - of a name, lower case, others as _: fit for a file.
std::string fileNameOf(const std::string& name);

// 64 bits of a file's content in hexadecimal (FNV-1a); "-" where there is no file to read.
std::string contentHash(const std::filesystem::path& file);

}  // namespace roomlight
