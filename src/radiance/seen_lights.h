// Which lamps and emissive meshes light a place: each is chosen by what it could give there without shadows, times what shadow rays from the same side of the same brick
// found of that (after Vévoda, Kondapaneni & Křivánek 2018, "Bayesian online regression for adaptive direct illumination sampling"; learned once, not on the way). Of many lights groups
// are known, nodes of their tree.
#pragma once

#include <array>
#include <atomic>
#include <span>
#include <vector>

#include "radiance/brick_side.h"
#include "radiance/slot_paths.h"
#include "trace/lights.h"

namespace roomlight {

class SeenLights {
 public:
  SeenLights() = default;  // knows nothing: lights are chosen without shadows
  SeenLights(const RayScene& rays, const Lights& lights, const Voxels& voxels, const SlotPaths& paths, uint64_t seed, uint64_t& rayCount);

  // As Lights::sampleLamps and its like, for a place on that side; -1: as if nothing were known. `lights` are those learned from.
  LightSample sampleLamps(const Lights& lights, Vec3 p, int32_t side, Sampler& sampler) const;
  LightSample sampleEmitters(const Lights& lights, Vec3 p, int32_t side, Vec2 u, float choice) const {
    LightSample one;
    sampleEmitters(lights, p, side, {&u, 1}, choice, {&one, 1});
    return one;
  }
  // As many as there are `u`, by choices that are equally far apart: `radiance` and `pdf` are such that all of them together are one estimate.
  void sampleEmitters(const Lights& lights, Vec3 p, int32_t side, std::span<const Vec2> u, float choice, std::span<LightSample> out) const;
  float pdfEmitters(const Lights& lights, Vec3 p, int32_t side, const SurfacePoint& q) const;
  size_t bytes() const { return lamps_.bytes() + emitters_.bytes(); }

 private:
  static constexpr size_t kMost = Lights::kMostOneByOne;  // that are weighed for a sample
  struct Seen {
    uint32_t which;  // a light, or, where there is a tree, one of its nodes
    float part;      // of what it could give without shadows
  };
  struct Table {
    std::vector<uint32_t> first;  // of each side, into `seen`; one more at the end
    std::vector<Seen> seen;       // together all lights; none of sides without slots
    std::span<const Seen> of(int32_t side) const {
      if (side < 0 || static_cast<size_t>(side) + 1 >= first.size()) return {};
      const auto from = first[static_cast<size_t>(side)], to = first[static_cast<size_t>(side) + 1];
      return std::span(seen).subspan(from, to - from);
    }
    size_t bytes() const { return first.size() * sizeof(first[0]) + seen.size() * sizeof(seen[0]); }
  };
  class Singles;
  class Groups;
  template <class Learner, class Kind>
  static Table learn(const RayScene& rays, const Voxels& voxels, const SlotPaths& paths, const Kind& kind, uint64_t seed, std::atomic<uint64_t>& count);
  template <class Kind>
  static Table learn(const RayScene& rays, const Voxels& voxels, const SlotPaths& paths, const Kind& kind, uint64_t seed, std::atomic<uint64_t>& count);
  struct Weighed {
    std::span<const Seen> seen;
    std::array<float, kMost> own;
    float sum = 0;
  };
  template <class Kind>
  static Weighed weigh(const Table& table, const Kind& kind, Vec3 p, int32_t side);
  template <class Kind>
  static LightTree::Choice choose(const Weighed& weighed, const Kind& kind, Vec3 p, float choice);
  template <class Kind>
  static float chance(const Table& table, const Kind& kind, size_t light, Vec3 p, int32_t side);

  Table lamps_, emitters_;
};

}  // namespace roomlight
