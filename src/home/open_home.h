// The one way from a file to a home that can be looked at: its unit, its rooms, cameras that see something, and light
 // where it has none.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "import/import.h"

namespace roomlight::home {

enum class LightWish {
  Auto,     // what the file has; where that is none, daylight and lamps are added
  Day,      // sun and sky of a clear day instead of the file's
  Evening,  // the sky after sunset, and lamps in rooms that have none
  Night,    // a sky all but dark, and lamps likewise
  None,     // no light but that of a lighting file
  File,     // what the file has, even if that is none
};
// "auto", "day", ...; the error names them.
Result<LightWish> lightWishFromName(const std::string& name);
const std::vector<std::pair<std::string, std::string>>& lightWishes();  // names with explanations

struct OpenWish {
  std::filesystem::path scene, lighting;  // lighting: of a lighting file, or empty
  std::optional<nlohmann::json> document; // what is applied as that file, where it was read before
  ImportOptions import;                   // but for its metresPerUnit
  std::optional<float> metresPerUnit;     // none: guessed where the file does not know
  LightWish light = LightWish::Auto;
  std::string camera;                     // that will be asked for, by name or number; empty: the default one
  std::vector<std::string> moreCameras;   // likewise
  bool allCameras = false;                // proposals also where the file has a camera that will do
};

// The light of all that the file itself has, before a lighting file or LightWish::None switches any of it off.
struct LightBefore {
  std::vector<Lamp> lamps;
  std::vector<Vec3> emission;  // of materials
};

struct OpenedHome {
  // With the cameras of the file first, then those proposed, if any; `cameraInUse` is one that sees something. Rooms
// are the file's; where it has none, those found.
  Scene scene;
  size_t fileCameras = 0;
  std::vector<std::string> warnings, faults;  // as Imported has them
  size_t faultCount = 0;
  std::vector<std::string> notes;    // what was guessed or added, a line each
  double metresPerUnit = 1;          // as taken
  std::string added;                 // what was added, in words; empty: nothing
  nlohmann::ordered_json lighting;   // the same, as a lighting file; null: nothing
  std::optional<PhotoWish> photo;    // as Imported has them
  std::string daylight;
  std::vector<Lamp> offLamps;
  LightBefore before;
  bool placed() const {
    return static_cast<size_t>(scene.cameraInUse) < fileCameras;
  }  // whether the default camera is the file's
};

// The error is one line.
Result<OpenedHome> openHome(const OpenWish& wish);
// The same of a scene that was read already, or made; of `wish` what is about the file is not asked for.
Result<OpenedHome> openImported(Imported imported, const OpenWish& wish);

}  // namespace roomlight::home
