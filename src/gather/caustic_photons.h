// Photons for what polished surfaces throw on others: the bow of light under a tap in the sun, the spots that a chrome
 // lamp has on its wall, the sun in a pane. Rays that gather find such light by chance only.
#pragma once

#include <span>
#include <vector>

#include "trace/traced_scene.h"

namespace roomlight {

struct CausticPhoton {
  Vec3 p, n;    // where it arrived; the unit geometric normal on that side
  Vec3 wi;      // unit, towards where it came from
  Vec3 fluxLm;
  int32_t lamp = -1, emitter = -1;  // whose it was; neither: a sun's
};

// The light of suns, lamps and emissive meshes that surfaces which throw light reflect (throwsLight(),
// scene/surface.h), once or several times in a row, where it then meets other surfaces: through panes and veils, on
// each of which it is kept too. Of the sky there is none. About `count` photons arrive near the places `seen`; the flux
// of all is right in the mean everywhere. None where such surfaces get no light. `apart`: that of each lamp and
// emissive mesh is wanted apart. The same for any number of threads.
std::vector<CausticPhoton> traceCausticPhotons(const TracedScene& scene, std::span<const Vec3> seen, size_t count,
                                               bool apart, uint64_t seed, uint64_t& rayCount);

}  // namespace roomlight
