// Content of input files, hashed once as long as size and time of a file stay.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "base/result.h"

namespace roomlight::batch {

class InputHashes {
 public:
  // 16 hexadecimal digits; empty where there is no file to read.
  std::string of(const std::filesystem::path& file);

  // Files that the file names and that lie where it says: buffers and textures of .gltf, materials of .obj, webs and
  // skies of lighting files, catalogues of studies; and what these name. Without the file itself, sorted.
  const std::vector<std::filesystem::path>& named(const std::filesystem::path& file);

 private:
  struct Known {
    uintmax_t size = 0;
    int64_t time = 0;
    std::string hash;
  };
  std::map<std::filesystem::path, Known> known_;
  std::map<std::filesystem::path, std::vector<std::filesystem::path>> named_;
};

}  // namespace roomlight::batch
