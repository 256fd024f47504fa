// Caustics: photons for what polished surfaces throw on others.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "trace/light_layers.h"
#include "trace/traced_scene.h"

namespace roomlight {

// The bow of light under a tap in the sun, the spots that a chrome lamp has on its wall, the sun in a pane. Rays that
// gather find such light by chance only.
struct CausticPhoton {
  Hit hit;       // where it arrived, met along -wi
  Vec3 p, n;     // there; the unit geometric normal on the side it came from
  Vec3 wi;       // unit, towards where it came from
  Vec3 fluxLm;
  int32_t lamp = -1, emitter = -1;  // whose it was; neither: a sun's
};

// Whose light it is; -1: of no layer.
int32_t layerOf(const CausticPhoton& photon, const LightLayers& layers);

// The light of suns, lamps and emissive meshes that surfaces which throw light reflect (throwsLight(),
// scene/surface.h), once or several times in a row, where it then meets other surfaces: through panes and veils, on
// each of which it is kept too. Of the sky there is none. Pilot photons tell which surfaces throw light to places that
// are seen. The same for any number of threads.
class CausticPhotons {
 public:
  static constexpr int kMostReflections = 7;  // in a row; what is left after those is lost

  struct Wish {
    bool apart = false;  // the light of each lamp and emissive mesh is wanted apart
    bool white = false;  // what is seen is whitened: photons are kept on black surfaces, too
  };
  // Refers to the scene. `seen`: places, near which most photons shall arrive.
  CausticPhotons(const TracedScene& scene, std::span<const Vec3> seen, Wish wish, uint64_t seed);
  ~CausticPhotons();
  // About `count` arrive near the places seen; the flux of all is right in the mean everywhere, in every round, and
  // rounds are independent. None where such surfaces get no light.
  std::vector<CausticPhoton> trace(size_t count, uint32_t round = 0);
  bool any() const;  // whether such surfaces get light, as far as pilots tell
  uint64_t rayCount() const;  // traced so far, pilots' too

 private:
  class Tracer;
  std::unique_ptr<Tracer> tracer_;
};

}  // namespace roomlight
