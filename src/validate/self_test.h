// Pictures whose light is known in closed form: does the program compute right on this machine, and how fast?
#pragma once

#include <string>

#include "base/progress.h"
#include "base/result.h"
#include "scene/scene.h"

namespace roomlight {

// A closed cube of albedo 0.5 with a point lamp in its middle, and its floor seen square on. What the lamp sends out is
// absorbed by six equal faces, so the mean illuminance of each is flux / ((1 - albedo) area of all six), whatever way
// light takes from face to face.
struct KnownPicture {
  Scene scene;
  Camera camera;
  double meanCdM2 = 0;
};
KnownPicture knownPicture();

constexpr double kSelfTestPercent = 3;  // that a mean may be off: what techniques promise of meters

struct SelfTest {
  std::string technique;
  double expectedCdM2 = 0, meanCdM2 = 0, errorPercent = 0;  // means over the picture
  double seconds = 0, samplesPerSecond = 0;  // samples: of all pixels together
  bool pass = false;
  bool complete = true;  // false: stopped early
};

// Takes some seconds; a slow processor is given half a minute for `path`. Errors: as render().
Result<SelfTest> selfTest(const std::string& technique, double allowedPercent, const Progress& progress = {});

}  // namespace roomlight
