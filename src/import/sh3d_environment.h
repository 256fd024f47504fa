// Sun, sky and ground around a home.
#pragma once

#include "import/sh3d_draft.h"
#include "import/sh3d_home.h"
#include "import/sh3d_paints.h"

namespace roomlight::importers::sh3d {

// A clear CIE sky (type 12) and its sun, by the compass' place and the time of `camera` (see cameraOfTime). The sky has
// the hue of the home's sky colour, or looks like its picture; both have the hue of the home's light colour. How much
// light they give is that of the time; at night there is a sky of twilight, moon and stars. Returns a `daylight` of
// lighting files for other times, as JSON, empty where place or time is not known. Needs Scene's geometry to be
// complete: the ground lies around it, just below the floors, out to 5 m; farther away the sky's lower half stands for
// it. Throws Failure.
std::string addEnvironment(const Home& home, Paints& paints, const std::string& camera, Draft& draft);

}  // namespace roomlight::importers::sh3d
