// Light for scenes that have none: what there is, and what would make the scene look right.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "trace/ray_scene.h"

namespace roomlight::home {

// What a scene's own light could give at the most.
struct OwnLight {
  bool lamps = false;                 // point, spot and area lamps
  double indoorLux = 0,
         outdoorLux =
             0;  // on surfaces, estimated: all the flux of lamps and shining surfaces over all surfaces; suns and sky
  std::vector<std::string> farLamps;  // that stand so far outside the scene that they light nothing

  static constexpr double kFaintLux = 0.5;  // less than a full moon gives is no light to see a home by
  double meanLux() const { return indoorLux + outdoorLux; }
  bool outdoors() const { return outdoorLux >= kFaintLux; }
  bool none() const { return !lamps && meanLux() < kFaintLux; }
  bool faint() const { return meanLux() < kFaintLux; }
};
OwnLight ownLightOf(const Scene& scene);

// Whether the scene's suns and sky light anything that the camera sees; true out of doors.
bool outdoorLightComesIn(const RayScene& rays, const std::vector<Room>& rooms, const Camera& camera);

enum class Mood {
  Auto,  // rooms by daylight and a ceiling lamp each, all else by sun and sky
  Day,  // daylight; lamps only in rooms that it does not reach
  Evening,  // a ceiling lamp in each room and the last light of the sky
  Night,  // the same under a sky that is all but dark
};

// Light for a scene, as a lighting file has it (docs/reference/lighting.md).
struct AddedLight {
  nlohmann::ordered_json document;
  std::string summary;  // "daylight and 3 ceiling lamps"
};

// `camera`: what is looked at. `rooms`: those of the scene, or found in it. Indoors the sun stands where most of it
// comes in. Where all that would leave the picture black, a lamp is added over the camera. `ownGround`: reflectance of
// the home's own ground, as a `daylight` has it; null: there is none, and homes seen from outside get one.
AddedLight lightFor(const RayScene& rays, const std::vector<Room>& rooms, const Camera& camera, Mood mood,
                    const nlohmann::ordered_json& ownGround = {});

// A clear noon in June where the light that is added is taken from, with north towards -z: for homes of which nobody
// says place or time. As a `daylight` of a lighting file.
nlohmann::ordered_json assumedDaylight();

// What a lamp at that place is taken to give where nobody says, lm: as a ceiling lamp that is added to its room.
double assumedFluxLm(const std::vector<Room>& rooms, Vec3 position);

}  // namespace roomlight::home
