// Any bytes as a lighting file: no crash, no hang. An error is one short line and leaves the scene alone; what is
// accepted holds finite light only.
#include <unistd.h>

#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

#include "fuzz/fuzz_support.h"
#include "import/lighting_file.h"
#include "scene/validate.h"

namespace roomlight::fuzz {
namespace {

// With a light of each kind.
Scene smallScene() {
  Scene scene = glowingTriangle();
  scene.lamps.emplace_back();
  scene.suns.emplace_back();
  scene.sky.luminanceCdM2 = Vec3(9);
  return scene;
}

// Inputs may name pictures relative to the file: its folder holds nothing else.
const std::filesystem::path& inputFile() {
  static const std::filesystem::path file = [] {
    std::string folder = (std::filesystem::temp_directory_path() / "roomlight-fuzz-XXXXXX").string();
    require(mkdtemp(folder.data()) != nullptr);
    static const std::filesystem::path made = folder;
    std::atexit([] {
      std::error_code ignored;
      std::filesystem::remove_all(made, ignored);
    });
    return made / "input.json";
  }();
  return file;
}

}  // namespace

void lighting(const uint8_t* data, size_t size) {
  std::ofstream(inputFile(), std::ios::binary)
      .write(reinterpret_cast<const char*>(data), static_cast<std::streamsize>(size));
  Scene scene = smallScene();
  const Status status = applyLightingFile(inputFile(), scene);
  if (status) {
    require(validate(scene).ok());
  } else {
    require(status.error().find('\n') == std::string::npos && status.error().size() < 2000);
    require(scene.lamps.size() == 1 && scene.suns.size() == 1 && scene.meshes.size() == 1);
    require(scene.materials[0].emission == Vec3(100) && scene.sky.luminanceCdM2 == Vec3(9));
  }
}

}  // namespace roomlight::fuzz
