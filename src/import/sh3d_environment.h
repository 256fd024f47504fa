// From where and when a home is seen, and the sun, sky and ground around it.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "import/sh3d_draft.h"
#include "import/sh3d_home.h"
#include "import/sh3d_paints.h"
#include "import/warnings.h"
#include "scene/scene.h"

namespace roomlight::importers::sh3d {

// The one that is on comes first, then the other of observer and top, then the stored ones by their names.
void addCameras(const Home& home, Scene& scene, Warnings& warnings);

// The one whose time of day counts: that of this name or number, where it has a time; otherwise the one that is on, or
// the first. None where the home has none.
const Camera* cameraOfTime(const Home& home, const std::string& wanted);

// Seconds to add to UTC for the clock at `wallSeconds` since 1970-01-01 00:00 on that clock, by the system's time
// zones; none where the zone is unknown there. "Europe/Paris", "UTC". In an hour that a change of the clock skips or
// repeats the later of the two moments counts, as Java reads it.
std::optional<int> utcOffsetSeconds(const std::string& zone, int64_t wallSeconds);

// A clear CIE sky (type 12) and its sun, by the compass' place and the time of `camera` (see cameraOfTime). The sky has
// the hue of the home's sky colour, or looks like its picture; both have the hue of the home's light colour. How much
// light they give is that of the time; at night there is a sky of twilight, moon and stars. Returns a `daylight` of
// lighting files for other times, as JSON, empty where place or time is not known. Needs Scene's geometry to be
// complete: the ground lies around it, just below the floors, out to 5 m; farther away the sky's lower half stands for
// it. Throws Failure.
std::string addEnvironment(const Home& home, Paints& paints, const std::string& camera, Draft& draft);

}  // namespace roomlight::importers::sh3d
