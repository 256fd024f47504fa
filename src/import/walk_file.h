// The walk file: JSON with a camera's way through a home and what moves or is dimmed meanwhile. Schema:
 // docs/reference/walk.md.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "base/result.h"
#include "scene/scene.h"
#include "scene/scene_change.h"

namespace roomlight {

// Values at times, smooth between them: monotone cubics (Fritsch and Carlson 1980), which never overshoot; constant
// before and after.
struct WalkTrack {
  std::vector<double> timesS;               // increasing
  std::vector<std::vector<float>> channels;  // of as many values each
  float at(size_t channel, double timeS) const;
};

struct Walk {
  double seconds = 0, framesPerSecond = 0;
  WalkTrack camera;  // position, target, full vertical angle in radians
  struct Thing {
    std::vector<uint32_t> instances;
    Vec3 about;                        // what it turns about
    std::vector<Affine> atRest;        // its instances' places
    WalkTrack track;                   // move along x, y, z in m, turn about +y in radians
  };
  std::vector<Thing> things;
  struct Dimmed {
    std::vector<size_t> lamps;          // of the scene's
    std::vector<size_t> materials;      // that glow
    std::vector<uint32_t> instances;    // of these
    std::vector<Vec3> intensityCd, luminanceCdM2, emission;  // of lamps and materials, undimmed
    WalkTrack track;                   // dimming, 0 to 1
  };
  std::vector<Dimmed> lamps;

  int frameCount() const;
  double timeOf(int frame) const { return frame / framesPerSecond; }
};

// The scene as the file's author knows it: nothing has moved. Errors name the file and the JSON path: unknown keys,
// times that do not increase, names that the scene does not have, with those it has.
Result<Walk> readWalkFile(const std::filesystem::path& file, const Scene& scene);

Camera cameraAt(const Walk& walk, double timeS);
// Puts all things and lamps of the walk where they are then, and returns what that changed.
SceneChange stage(const Walk& walk, double timeS, Scene& scene);
// As the file was read.
void atRest(const Walk& walk, Scene& scene);
// All that the walk may change.
SceneChange everythingIn(const Walk& walk);

}  // namespace roomlight
