// What has been measured, on disk: a study that was stopped goes on where it was.
#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "base/result.h"
#include "base/write_file.h"

namespace roomlight {

class RunStore {
 public:
  // `folder` is made where it is not there, and is this store's alone (among processes too) for as long as the store or
  // a copy of it lives: an error where another has it.
  static Result<RunStore> open(const std::filesystem::path& folder);

  // A result is known by what it is (a kind, a scene, a light, ..) and by everything that it depends on.
  struct Key {
    std::vector<std::string> names;
    std::string circumstances;
  };
  std::optional<nlohmann::json> find(const Key& key) const;
  Status keep(const Key& key, const nlohmann::json& result) const;  // whole or not at all
  void forget(const Key& key) const;

  // A file that goes with a result, such as a picture: readable, and another for every key.
  std::filesystem::path file(const Key& key, const std::string& extension) const;
  const std::filesystem::path& folder() const { return folder_; }

 private:
  RunStore(std::filesystem::path folder, HeldFolder held) : folder_(std::move(folder)), held_(std::move(held)) {}
  std::filesystem::path folder_;
  HeldFolder held_;
};

// Letters, digits and - of a name, lower case, others as _: fit for a file.
std::string fileNameOf(const std::string& name);

// 64 bits of a text or of a file's content in hexadecimal (FNV-1a); "-" where there is no file to read.
std::string contentHash(const std::filesystem::path& file);
std::string textHash(const std::string& text);

}  // namespace roomlight
