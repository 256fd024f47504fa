// Sampling the sky through windows: directions that other rays from the same brick found open, and those that slots
// asked for light.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "base/vec.h"
#include "radiance/radiance_field.h"
#include "radiance/slot_lookup.h"
#include "radiance/slot_remap.h"

namespace roomlight {

// Builds the guide from the links: every direction tried, and how much of the sky's light came through (0..1).
class SkyGuideBuilder {
 public:
  SkyGuideBuilder(const Voxels& voxels, const SkyDistribution& sky);
  void add(size_t brick, int face, Vec3 direction, float open);  // one thread a brick
  SkyGuide finish(const Progress& progress) const;  // of no use once that says stop
  // Of each brick what its neighbours tell alone. Of no use once `progress` says stop.
  SkyGuide finishOfOthers(const Progress& progress) const;

 private:
  struct Tries {
    float open = 0, tried = 0;
  };
  using Blocks = std::array<Tries, SkyDistribution::kBlocks>;
  SkyGuide finish(float ownWeight, const Progress& progress) const;
  Blocks around(size_t brick, size_t face, float ownWeight) const;
  bool density(const Blocks& tries, SkyGuide::Cdf& cdf) const;
  const Voxels& voxels_;
  const SkyDistribution& sky_;
  std::vector<std::array<std::unique_ptr<Blocks>, 6>> blocks_;  // per brick and face; null: no slot
};

// The guides of `fresh`, and those of `before` for bricks that are carried.
SkyGuide keptGuide(const SkyGuide& before, const SkyGuide& fresh, const SlotRemap& remap);

// A sky direction for a surface: by `guide` (an index into SkyGuide::cdf), or where that is -1 by the sky's own
// brightness. `radiance` is divided by the density.
LightSample sampleSkyGuided(const SkyGuide& guides, int32_t guide, const Lights& lights, Vec2 u, float choice);
// The same in two steps, between which the light that the second reads is fetched from memory.
SkyDistribution::Sample drawSkyGuided(const SkyGuide& guides, int32_t guide, const Lights& lights, Vec2 u,
                                      float choice);
LightSample skyLight(const Lights& lights, const SkyDistribution::Sample& drawn);

// Density with which sampleSkyGuided chooses the direction of a place in the sky's map, per steradian.
float pdfSkyGuided(const SkyGuide& guides, int32_t guide, const Lights& lights, Vec2 uv);
inline float pdfSkyGuided(const SkyGuide& guides, int32_t guide, const Lights& lights, Vec3 d) {
  return pdfSkyGuided(guides, guide, lights, lights.sky().toUv(d));
}

// The guide that serves a surface at p with unit normal n: of its own brick, or where the surface lies on the border of
// bricks of the one on the other side; -1 where neither saw sky.
int32_t guideAt(const SkyGuide& guides, const Voxels& voxels, Vec3 p, Vec3 n);
// The same for who knows the side of a brick that it lies on (brickSideAt); -1: none.
inline int32_t guideOfSide(const SkyGuide& guides, int32_t side) {
  return side < 0 || guides.guideOfBrick.empty()
             ? -1
             : guides.guideOfBrick[static_cast<size_t>(side) / kBrickSides][static_cast<size_t>(side) % kBrickSides];
}

// Where the rays went that slots asked the sky for light with: kept, so that after a move only those that it concerns
// are found without choosing all directions anew.
constexpr uint32_t kSkySamples = 8;  // a slot

// A unit direction in 16 bits: a cell of an octahedron unfolded. None at all is one of the codes.
class SkyDirection {
 public:
  // So far a direction, times its length, may lie beside that of its cell.
  static constexpr float kOff = 0.02f;
  SkyDirection() = default;
  explicit SkyDirection(Vec3 d);
  Vec3 direction() const;  // unit; zero: none

 private:
  static constexpr uint16_t kNone = 0xffff;
  uint16_t code_ = kNone;
};

using SkyDirections = std::vector<std::array<SkyDirection, kSkySamples>>;  // per slot

}  // namespace roomlight
