// Where the light of texels comes from, as far as normal maps need it: how illuminance changes as a place is turned
// about the axes of its chart.
#pragma once

#include <span>
#include <vector>

#include "bake/atlas.h"
#include "bake/layers.h"
#include "bake/lit_places.h"

namespace roomlight::bake {

struct TurnedPlaces {
  std::vector<uint32_t> of;             // places of texels whose material has a normal map
  std::vector<SurfaceElement> turned;  // four for each of them: by 30° along u, against it, along v, against it
};

TurnedPlaces turnedPlaces(const Scene& scene, const Atlas& atlas, const LitPlaces& lit);

// A layer has light on all places, and behind them on those that are turned: takes that away, and keeps the layer's
// lean on places. Linear in the light, so that layers add up.
void takeLean(const TurnedPlaces& turned, size_t places, BakedLayer& layer);

}  // namespace roomlight::bake
