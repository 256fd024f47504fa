// Any bytes as a walk file: no crash, no hang. An error is one short line; what is accepted can be played and put back.
#include <unistd.h>

#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

#include "fuzz/fuzz_support.h"
#include "import/walk_file.h"

namespace roomlight::fuzz {
namespace {

// A triangle called Chair, and a lamp.
Scene smallScene() {
  Scene scene = glowingTriangle();
  scene.instances[0].name = "Chair";
  scene.lamps.emplace_back().name = "Lamp";
  return scene;
}

const std::filesystem::path& inputFile() {
  static const std::filesystem::path file = [] {
    std::atexit([] { std::filesystem::remove(inputFile()); });
    return std::filesystem::temp_directory_path() / ("roomlight-fuzz-walk-" + std::to_string(getpid()) + ".json");
  }();
  return file;
}

}  // namespace

void walk(const uint8_t* data, size_t size) {
  const std::filesystem::path& file = inputFile();
  std::ofstream(file, std::ios::binary).write(reinterpret_cast<const char*>(data), static_cast<std::streamsize>(size));
  Scene scene = smallScene();
  const Result<Walk> walk = readWalkFile(file, scene);
  if (!walk) {
    require(walk.error().find('\n') == std::string::npos && walk.error().size() < 4000);
    return;
  }
  for (int k = 0; k <= 4; ++k) {
    const double timeS = walk.value().seconds * k / 4;
    stage(walk.value(), timeS, scene);
    const Affine camera = cameraAt(walk.value(), timeS).worldFromCamera;
    require(isFinite(camera.w) && isFinite(camera.z) && isFinite(scene.instances[0].worldFromObject.w));
  }
  atRest(walk.value(), scene);
  require(scene.materials[0].emission == Vec3(100) && scene.instances[0].worldFromObject.w == Vec3(0));
}

}  // namespace roomlight::fuzz
