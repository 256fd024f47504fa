// Everything that decides what a picture looks like besides the scene and the camera. Read from and written to JSON
// with the names of the members; the command line fills the same struct.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/result.h"
#include "baselines/lpv.h"
#include "baselines/photon_settings.h"
#include "baselines/vxgi.h"
#include "gather/cone_gather.h"
#include "gather/frame.h"
#include "gather/ray_gather.h"
#include "radiance/radiance_field.h"
#include "reference/path_tracer.h"
#include "voxel/voxelise.h"

// Names of techniques, for what is about one of them alone. What a technique can do is asked of its row: technique.h.
namespace roomlight::technique {

inline constexpr char kHybrid[] = "hybrid";
inline constexpr char kCone[] = "cone";
inline constexpr char kVxgi[] = "vxgi";
inline constexpr char kLpv[] = "lpv";
inline constexpr char kPhoton[] = "photon";
inline constexpr char kPath[] = "path";

}  // namespace roomlight::technique

namespace roomlight {

struct RenderSettings {
  std::string technique = technique::kHybrid;  // a row of the registry (engine/technique.h)
  std::string quality = "good";      // a name of qualities(); what it stands for is in the members below
  int width = 960, height = 540;
  int samples = 0;         // per pixel; 0: the technique's default, or no limit where time or noise ends the work
  double timeLimitS = 0;   // be done after this long, but not before every pixel has light; 0: no limit
  double noiseLevel = 0;  // technique "path": stop when the mean relative standard error is below this; "hybrid": rays
                          // go on where a pixel's is above; 0: never
  uint64_t seed = 0;
  bool layers =
      false;  // techniques "hybrid" and "path": the light of every lamp, emissive mesh, sun and sky apart as well
  bool layersByRoom = false;  // and lamps of a room together
  int threads = 0;  // 0: all cores
  bool blend =
      true;  // technique "hybrid": paths are traced and blended in while the time limit leaves time (time_plan.h)
  double blendUntilMse = 0;  // and, without a limit too, until the error estimated is below this; 0: time alone ends it
  PathSettings path;  // technique "path"; size, samples, limits and seed are those above
  VoxelSettings voxel;  // techniques "hybrid" and "cone"
  RadianceSettings radiance;  // of the same; its seed is the one above
  RayGatherSettings hybrid;  // technique "hybrid"; size, samples, time limit and seed are those above
  ConeGatherSettings cone;  // technique "cone"; size, samples, time limit and seed are those above
  VxgiSettings vxgi;  // technique "vxgi"; size, samples, time limit and seed are those above
  LpvSettings lpv;  // technique "lpv"; the same
  PhotonSettings photon;  // technique "photon"; size, samples, time limit and seed are those above
  FrameSettings frames;  // of walks, all techniques but "path"
};

// One JSON object with every member, in the order above, less those that repeat one above.
std::string settingsToJson(const RenderSettings& settings);

// Members that the text does not mention keep their value in `defaults`, or get that of the quality it names;
// `quality`, where given, goes before that. An unknown key, a wrong type or a value out of range is an error that
// starts with `where` (the file's name) and the JSON path.
Result<RenderSettings> settingsFromJson(std::string_view text, const std::string& where,
                                        const RenderSettings& defaults = {}, const std::string& quality = {});

// Values in range? The error names the member as in JSON. The technique's name is left to render().
Status checkSettings(const RenderSettings& settings);

// Presets of quality: how much is done for a picture before anybody asks for more. Names for --quality, each with one
// line of explanation, the quickest first.
std::vector<std::pair<std::string, std::string>> qualities();

// The starting values of the groups "voxel", "radiance" and "hybrid" and of blendUntilMse. Errors: an unknown name.
Status applyQuality(const std::string& name, RenderSettings& settings);

// The program's version, as in CMakeLists.txt.
const char* version();  // "1.0.0-rc1"

}  // namespace roomlight
