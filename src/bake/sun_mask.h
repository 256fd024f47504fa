// What of a sun's light arrives straight, on cells finer than texels: edges of sunlit patches are sharper than bounced
// light needs.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "bake/atlas.h"
#include "bake/lit_places.h"
#include "bake/seen_sides.h"
#include "base/progress.h"

namespace roomlight::bake {

constexpr int kFineCells = 5;  // cells along the edge of a texel

// On all cells of an atlas, in rows of atlas.width * kFineCells.
struct SunMask {
  std::vector<std::array<uint8_t, 3>> left;  // of linear red, green and blue; 255: all arrives
  bool coloured = false;  // panes let more of some channels pass than of others
  bool any() const { return !left.empty(); }
};

// Cells that are buried (lit_places.h), in rows as SunMask has them. `rays`, `atlas` and what is seen are of the same
// home, simplified.
std::vector<bool> buriedCells(const RayScene& rays, const Atlas& atlas, const LitPlaces& lit, const SeenSides& seen);

// What masks of all suns have in common.
struct SunCells {
  const Scene& scene;  // simplified
  const Atlas& atlas;
  const LitPlaces& lit;
  std::span<const float> movedM;     // how far each mesh may have moved
  const std::vector<bool>& buried;   // cells
};

// By rays in the home as it is. One a cell; where neighbours differ 32, over the cell and the disc of the sun. Cells
// that are buried show what the nearest one does that is not; texels of vertices are even. Does not depend on the
// number of threads. Nothing once `progress` says stop.
SunMask sunMaskOf(const SunCells& cells, const RayScene& home, const Sun& sun, const Progress& progress = {});

// Straight from the sun on the elements of the atlas, lux: means over their texels.
std::vector<Vec3> sunlightOn(const Atlas& atlas, const SunMask& mask, const Sun& sun);

}  // namespace roomlight::bake
