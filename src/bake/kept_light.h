// Light that has been found, kept in a folder until the home is written: the same run, interrupted, goes on from there.
#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace roomlight::bake {

class KeptLight {
 public:
  KeptLight() = default;  // keeps nothing
  // The folder is made once there is something to keep.
  explicit KeptLight(std::filesystem::path folder) : folder_(std::move(folder)) {}

  // `name`: a hash of all that the numbers depend on. None where nothing was kept, or it is damaged.
  std::optional<std::vector<float>> find(const std::string& name, size_t count) const;
  // Where nothing can be written nothing is kept: the light is not lost for it.
  void keep(const std::string& name, std::span<const float> numbers) const;
  // Removes what was kept, and the folder if that was all.
  void forget() const;
  // Whether anything is kept.
  bool any() const;

 private:
  std::filesystem::path folder_;  // empty: none
};

}  // namespace roomlight::bake
