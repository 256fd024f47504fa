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
  std::string camera =
      {};             // of a Sweet Home 3D home, by name or number: whose time of day it is; empty: the one in use
  std::optional<char> upAxis = {};  // 'x', 'y' or 'z': what points up in a file other than glTF and Sweet Home 3D's;
                                    // none: as the file says, or guessed
  std::filesystem::path companionRoot = {};  // of a scene in a folder or an archive: its top folder, below which
                                             // companions are looked for; empty: the scene's own
  size_t maxTriangles = 200'000'000;  // of all instances; refuse absurd files before allocating
};

// What a file says of its unit of length.
enum class StatedUnit {
  None,  // nothing: OBJ, STL, PLY, 3DS
  Stated,  // by its format or in the file; often wrong
  Certain,  // Sweet Home 3D counts in centimetres, always
};

// The photo that a home was last set to be taken as.
struct PhotoWish {
  int widthPx = 0, heightPx = 0;
  int quality = 0;  // Sweet Home 3D's: 0 and 1 without ray tracing, 2 and 3 with it
};

struct Imported {
  Scene scene;
  std::vector<std::string>
      warnings;  // what somebody must know: one per kind of thing that could not be honoured, with how often
  std::optional<PhotoWish> photo = {};  // of a Sweet Home 3D home where somebody chose one
  // Of a Sweet Home 3D home that says where and when: a `daylight` as lighting files have it, much like the scene's own
  // sun and sky, for other times. JSON; empty: none.
  std::string daylight = {};
  // Lamps that a Sweet Home 3D home has switched off, not in the scene, as they would shine at their usual power: for
  // who switches them on.
  std::vector<Lamp> offLamps = {};
  std::vector<std::string> faults =
      {};  // small things that were mended and that nobody sees: one per kind, with how often
  size_t faultCount = 0;  // of all kinds together
  StatedUnit unit = StatedUnit::Stated;  // the scene is in metres as far as the file knows
};

// ".glb, .gltf, ...": what importScene opens, for people.
std::string supportedFiles();

// A file of a kind that supportedFiles() names, also under another extension; a folder or a zip file with one scene in
// it. The error is one line that names the file and the place in it.
Result<Imported> importScene(const std::filesystem::path& file, const ImportOptions& options = {});

// Each format's own reader; same contract.
Result<Imported> importGltf(const std::filesystem::path& file, const ImportOptions& options);
Result<Imported> importObj(const std::filesystem::path& file, const ImportOptions& options);
Result<Imported> importSh3d(const std::filesystem::path& file, const ImportOptions& options);
Result<Imported> importSh3f(const std::filesystem::path& file, const ImportOptions& options);

}  // namespace roomlight
