// What shines by reflection alone, small and bright: what lamps light beside them, and what the sun lights. Such light
 // is sampled by place, since rays that gather seldom find it.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "radiance/lamp_glow.h"
#include "radiance/slot_lookup.h"
#include "trace/ray_scene.h"

namespace roomlight {

// Points of one brick's surfaces that face alike make a patch. Rays that each patch sends out tell how much of its
// light arrives in every brick of voxels; a place samples its brick's patches by that. Rays that gather find the same
// light: both share it by multiple importance sampling (Veach 1997, power heuristic).
class BrightPatches {
 public:
  BrightPatches() = default;
  // `points`: of lamps' glow, and of slots that the sun lights (neither lamp nor emitter). `glowShare`: of what each
  // slot reflects the part that the glow's points stand for, whether or not one of them lies on it; empty: none.
// `farM`: nearer than that gathering rays alone find what the sun lights.
  BrightPatches(const RayScene& rays, const Voxels& voxels, std::span<const GlowPoint> points,
                std::span<const float> glowShare, float farM, uint64_t seed);

  bool empty() const { return points_.empty(); }
  size_t pointCount() const { return points_.size(); }
  const GlowPoint& point(size_t index) const { return points_[index]; }
  static bool isSun(const GlowPoint& g) { return g.lamp < 0 && g.emitter < 0; }

  // One point for a surface at p on that side of a brick, none where no patch is seen, any where there is no brick
  // (-1), as in the air; `pdf` is 0 and `radiance` what arrives if nothing is in the way, divided by the density of its
  // choice. Not shared yet.
  GlowSample sample(Vec3 p, Vec3 n, int32_t side, Sampler& sampler) const {
    return choose(draw(side, sampler), p, n, sampler);
  }
  // The same in two steps, between which what the second reads is fetched from memory: candidates drawn by what lights
  // the side, and one of them by what it could give at p.
  struct Candidates {
    static constexpr size_t kMost = 4;
    size_t count = 0;  // kMost or 0
    std::array<uint32_t, kMost> point;
    std::array<float, kMost> perPoint;  // points of its patch over the patch's chance
  };
  Candidates draw(int32_t side, Sampler& sampler) const;
  GlowSample choose(const Candidates& candidates, Vec3 p, Vec3 n, Sampler& sampler) const;
  // Per steradian at p, whose side that is, with which points stand for the light from one of them; 0: nearer than rays
  // leave it to points.
  float densityAt(size_t point, Vec3 p, int32_t side) const;
  // The part that points of that density take of the light, where rays find it with another.
  static float pointShare(float density, float rayPdf);
  // The part of what a slot reflects of `radianceCdM2` that rays take who find it so.
  float rayShare(int64_t slot, float radianceCdM2, float distance, float cosLight, int32_t side, float rayPdf) const;
  bool holdsSun(int64_t slot) const { return !holdsSun_.empty() && holdsSun_[static_cast<size_t>(slot)]; }
  // Whether any patch is known to light a side.
  bool reaches(int32_t side) const { return (side < 0 && !points_.empty()) || seenFrom(side) != nullptr; }
  size_t bytes() const;

 private:
  static constexpr size_t kSeen = 24;
  struct Patch {
    uint32_t first, count;  // points
    float fluxLm;
  };
  struct Seen {
    static constexpr uint32_t kNone = ~0u;
    int32_t count = 0;
    std::array<uint32_t, kSeen> patch;  // kNone after the last
    std::array<float, kSeen + 1> upTo;  // of chances: before each; from the end of the last on 1
    // All are looked at, eight at a time, whichever it is.
    float chance(uint32_t p) const {
      int32_t at = -1;
      for (int32_t i = 0; i < static_cast<int32_t>(kSeen); ++i)
        at = std::max(at, patch[static_cast<size_t>(i)] == p ? i : -1);
      return at < 0 ? 0 : chanceOf(at);
    }
    float chanceOf(int32_t i) const { return upTo[static_cast<size_t>(i) + 1] - upTo[static_cast<size_t>(i)]; }
    int32_t chosen(float choice) const {
      int32_t i = 0;
      for (size_t k = 1; k <= kSeen; ++k) i += upTo[k] <= choice;
      return std::min(i, count - 1);
    }
  };
  struct alignas(64) Point : GlowPoint {};  // in one cache line
  const Seen* seenFrom(int32_t side) const {
    return side < 0 || points_.empty() || seenOfSide_[static_cast<size_t>(side)] < 0
               ? nullptr
               : &seen_[static_cast<size_t>(seenOfSide_[static_cast<size_t>(side)])];
  }
  void gatherPatches(const Voxels& voxels, std::span<const GlowPoint> points, std::span<const float> glowShare);
  std::vector<std::pair<uint32_t, uint32_t>> lights(const RayScene& rays, uint32_t patch, uint64_t seed) const;
  void learn(const RayScene& rays, uint64_t seed);
  struct Choice {
    uint32_t patch;
    float chance;
  };
  Choice patchFor(const Seen* seen, float u) const;
  float byFlux(uint32_t patch) const { return upTo_[patch] - (patch > 0 ? upTo_[patch - 1] : 0); }
  float chanceOf(uint32_t patch, int32_t side) const;
  float chancePerLumen(int32_t patch, int32_t side) const;
  float pointsDensity(int32_t patch, float radianceCdM2, float distance, float cosLight, int32_t side) const;

  const Voxels* voxels_ = nullptr;
  std::vector<Point> points_;  // by patch
  std::vector<uint32_t> patchOfPoint_;
  std::vector<int32_t> patchOfSlot_;  // -1: none
  std::vector<uint8_t> holdsSun_;  // per slot: points stand for what the sun lights there
  std::vector<Patch> patches_;
  std::vector<float> upTo_;  // of flux, all patches
  std::vector<int32_t> seenOfSide_;  // of each brick's sides; -1: no patch
  std::vector<Seen> seen_;
  float farM_ = 0, fluxLm_ = 0;
};

}  // namespace roomlight
