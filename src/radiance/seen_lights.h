// Which lamps and emissive meshes light a place: what arrives of each is known for every side of every brick
 // (trace/light_parts.h).
#pragma once

#include <atomic>
#include <span>
#include <vector>

#include "radiance/slot_lookup.h"
#include "radiance/slot_paths.h"
#include "trace/light_parts.h"

namespace roomlight {

class SeenLights {
 public:
  SeenLights() = default;  // knows nothing: lights are chosen without shadows
  SeenLights(const RayScene& rays, const Lights& lights, const Voxels& voxels, const SlotPaths& paths, uint64_t seed,
             uint64_t& rayCount);

  // As Lights::sampleLamps and its like, for a place on that side; -1: as if nothing were known. `lights` are those
// learned from.
  LightSample sampleLamps(const Lights& lights, Vec3 p, int32_t side, Sampler& sampler) const;
  LightSample sampleEmitters(const Lights& lights, Vec3 p, int32_t side, Vec2 u, float choice) const {
    LightSample one;
    sampleEmitters(lights, p, side, {&u, 1}, choice, {&one, 1});
    return one;
  }
  // As many as there are `u`, by choices that are equally far apart: `radiance` and `pdf` are such that all of them
// together are one estimate.
  void sampleEmitters(const Lights& lights, Vec3 p, int32_t side, std::span<const Vec2> u, float choice,
                      std::span<LightSample> out) const;
  float pdfEmitters(const Lights& lights, Vec3 p, int32_t side, const SurfacePoint& q) const;
  size_t bytes() const { return lamps_.bytes() + emitters_.bytes(); }
  // All that `seen` holds, array by array, for who keeps it in files.
  static void visit(auto& seen, auto&& array) {
    for (auto* table : {&seen.lamps_, &seen.emitters_}) array(table->first), array(table->parts);
  }

 private:
  struct Table {
    std::vector<uint32_t> first;   // of each side, into `parts`; one more at the end
    std::vector<LightPart> parts;  // none of sides without slots
    std::span<const LightPart> of(int32_t side) const {
      if (side < 0 || static_cast<size_t>(side) + 1 >= first.size()) return {};
      const auto from = first[static_cast<size_t>(side)], to = first[static_cast<size_t>(side) + 1];
      return std::span(parts).subspan(from, to - from);
    }
    size_t bytes() const { return first.size() * sizeof(first[0]) + parts.size() * sizeof(parts[0]); }
  };
  template <class Kind>
  static Table learn(const RayScene& rays, const Voxels& voxels, const SlotPaths& paths, const Kind& kind, uint64_t key,
                     std::atomic<uint64_t>& count);

  Table lamps_, emitters_;
};

}  // namespace roomlight
