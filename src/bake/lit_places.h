// The places of a home whose light is worked out, and how the texels of the atlas take theirs from them. Texels of
// charts have a place each; vertices of fine things share places that are near and face the same way.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "bake/atlas.h"
#include "bake/seen_sides.h"

namespace roomlight::bake {

constexpr size_t kMostShares = 4;

// Of what places: weights that add up to one; those behind the first of 0 are none.
struct LightShares {
  std::array<uint32_t, kMostShares> place{};
  std::array<float, kMostShares> weight{};
};

struct LitSide {
  uint32_t instance = 0;
  bool back = false;
  bool shared = false;  // by vertices: the normal is a mean of theirs
  uint32_t chart = 0;   // of the atlas
};

struct LitPlaces {
  std::vector<SurfaceElement> places;
  std::vector<LitSide> sides;          // that the places are on
  std::vector<LightShares> ofElement;  // of the atlas
  std::vector<uint8_t> buried;         // likewise
  // Light on all elements of the atlas from light on places.
  template <class T>
  std::vector<T> spread(std::span<const T> light) const {
    std::vector<T> out(ofElement.size());
    for (size_t i = 0; i < out.size(); ++i) {
      for (size_t k = 0; k < kMostShares && ofElement[i].weight[k] > 0; ++k)
        out[i] += light[ofElement[i].place[k]] * ofElement[i].weight[k];
    }
    return out;
  }
};

// Whether next to nothing of what a place sees can be seen from the rooms. `number`: of its rays.
bool isBuried(const SurfaceElement& place, size_t number, const RayScene& rays, const SeenSides& seen);

// A place that is buried, as the part of a floor under a wall is, where next to nothing of what it sees can be seen
// from the rooms, takes the light of the nearest open one of its chart: what is dark there may not bleed into what is
// seen beside it. `apartM`: between places that vertices share. Does not depend on the number of threads.
LitPlaces litPlacesOf(const Atlas& atlas, const RayScene& rays, const SeenSides& seen, float apartM);

}  // namespace roomlight::bake
