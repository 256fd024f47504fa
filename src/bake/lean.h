// Where the light of texels comes from, as far as normal maps need it: how illuminance changes as a place is turned
// about the axes of its chart. Told at one texel of every five by five, since it changes slowly; between those it is
// a mean of what they tell.
#pragma once

#include <array>
#include <vector>

#include "bake/atlas.h"
#include "bake/layers.h"
#include "bake/lit_places.h"

namespace roomlight::bake {

constexpr size_t kMostTellers = 9;

// Of which of `TurnedPlaces::of`; weights of 0 are none.
struct LeanShares {
  std::array<uint32_t, kMostTellers> teller{};
  std::array<float, kMostTellers> weight{};
};

struct TurnedPlaces {
  std::vector<uint32_t> of;            // places, on charts whose normal map has slopes of 3° and more
  std::vector<SurfaceElement> turned;  // four for each of them: by 30° along u, against it, along v, against it
  std::vector<uint32_t> elements;      // of the atlas, that lie on such charts,
  std::vector<LeanShares> shares;      // and what each takes from those places
};

TurnedPlaces turnedPlaces(const Scene& scene, const Atlas& atlas, const LitPlaces& lit);

// A layer has light on all of `lit`, and behind them on the places that are turned: takes that away, and keeps the
// layer's lean.
void takeLean(const TurnedPlaces& turned, const LitPlaces& lit, BakedLayer& layer);

}  // namespace roomlight::bake
