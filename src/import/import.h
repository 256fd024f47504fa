// Opens a home: picks the importer by the file's extension and returns a validated scene.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "base/result.h"
#include "scene/scene.h"

namespace roomlight {

struct ImportOptions {
  float metresPerUnit = 1;             // multiplies lengths; OBJ files carry no unit
  double lumenAtFullPower = 1600;      // what Sweet Home 3D's lights of power 1 send out; their power has no unit
  std::string camera = {};             // of a Sweet Home 3D home, by name or number: whose time of day it is; empty: the one in use
  size_t maxTriangles = 200'000'000;   // of all instances; refuse absurd files before allocating
};

// The photo that a home was last set to be taken as.
struct PhotoWish {
  int widthPx = 0, heightPx = 0;
  int quality = 0;  // Sweet Home 3D's: 0 and 1 without ray tracing, 2 and 3 with it
};

struct Imported {
  Scene scene;
  std::vector<std::string> warnings;  // one per kind of thing that could not be honoured, with how often
  std::optional<PhotoWish> photo = {};  // of a Sweet Home 3D home where somebody chose one
  // Of a Sweet Home 3D home that says where and when: a `daylight` as lighting files have it, much like the scene's own sun and sky, for
  // other times. JSON; empty: none.
  std::string daylight = {};
};

// .gltf, .glb, .obj, .sh3d, .sh3f. The error is one line that names the file and the place in it.
Result<Imported> importScene(const std::filesystem::path& file, const ImportOptions& options = {});

// Each format's own reader; same contract.
Result<Imported> importGltf(const std::filesystem::path& file, const ImportOptions& options);
Result<Imported> importObj(const std::filesystem::path& file, const ImportOptions& options);
Result<Imported> importSh3d(const std::filesystem::path& file, const ImportOptions& options);
Result<Imported> importSh3f(const std::filesystem::path& file, const ImportOptions& options);

}  // namespace roomlight
