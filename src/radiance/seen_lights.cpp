#include "radiance/seen_lights.h"

#include <array>
#include <atomic>

#include "base/parallel.h"
#include "trace/light_parts_learner.h"

namespace roomlight {
namespace {

constexpr uint64_t kLampKey = 17, kEmitterKey = 18;  // for random numbers

// On slots of a side.
struct PlacesOnSide {
  static constexpr uint32_t kRays = 8, kFewRays = 2;
  const Voxels& voxels;
  const SlotPaths& paths;
  std::span<const uint32_t> slots;

  size_t size() const { return slots.size(); }
  Vec3 position(size_t k) const { return voxels.slots[slots[k]].position; }
  Bounds3 bounds() const {
    Bounds3 out;
    for (const uint32_t s : slots) out.add(voxels.slots[s].position);
    return out;
  }
  struct Place {
    Vec3 p, n;
  };
  // The k-th of n.
  Place draw(uint32_t k, uint32_t n, Sampler& sampler) const {
    const uint32_t s = slots[std::min(
        slots.size() - 1, static_cast<size_t>((static_cast<float>(k) + sampler.fast1()) / static_cast<float>(n) *
                                              static_cast<float>(slots.size())))];
    return {paths.point(s, k), voxels.slots[s].normal};
  }
};

}  // namespace

template <class Kind>
SeenLights::Table SeenLights::learn(const RayScene& rays, const Voxels& voxels, const SlotPaths& paths,
                                    const Kind& kind, uint64_t key, std::atomic<uint64_t>& count) {
  if (kind.count() < 2) return {};  // nothing to choose
  std::vector<std::vector<LightPart>> found(kBrickSides * voxels.bricks.size());
  parallelFor(voxels.bricks.size(), 4, [&](size_t b) {
    std::array<std::vector<uint32_t>, kBrickSides> slots;
    const auto [first, last] = slotsOfBrick(voxels, b);
    for (size_t s = first; s < last; ++s) slots[voxels.slots[s].face].push_back(static_cast<uint32_t>(s));
    withPartsLearner(kind, [&](auto& learner) {
      for (size_t face = 0; face < kBrickSides; ++face) {
        if (slots[face].empty()) continue;
        Sampler sampler(paths.key(slots[face][0]), 0, key);
        count += learner.look(rays, kind, PlacesOnSide{voxels, paths, slots[face]}, sampler);
        learner.list(found[kBrickSides * b + face]);
      }
    });
  });
  Table table;
  for (const auto& list : found) {
    table.first.push_back(static_cast<uint32_t>(table.parts.size()));
    table.parts.insert(table.parts.end(), list.begin(), list.end());
  }
  table.first.push_back(static_cast<uint32_t>(table.parts.size()));
  return table;
}

SeenLights::SeenLights(const RayScene& rays, const Lights& lights, const Voxels& voxels, const SlotPaths& paths,
                       uint64_t seed, uint64_t& rayCount) {
  std::atomic<uint64_t> count = 0;
  lamps_ = learn(rays, voxels, paths, LampChoice{lights}, seed + kLampKey, count);
  emitters_ = learn(rays, voxels, paths, EmitterChoice{lights}, seed + kEmitterKey, count);
  rayCount += count;
}

LightSample SeenLights::sampleLamps(const Lights& lights, Vec3 p, int32_t side, Sampler& sampler) const {
  const LampChoice kind{lights};
  const float choice = sampler.next1();
  const Vec2 u = lights.hasExtendedLamps() ? sampler.next2() : Vec2{};
  const LightTree::Choice c = chooseLight(weighed(lamps_.of(side), kind, p), kind, p, choice);
  if (!(c.chance > 0)) return {};
  LightSample s = lights.sampleLamp(c.index, p, u);
  s.radiance *= 1 / c.chance;
  return s;
}

void SeenLights::sampleEmitters(const Lights& lights, Vec3 p, int32_t side, std::span<const Vec2> u, float choice,
                                std::span<LightSample> out) const {
  const EmitterChoice kind{lights};
  const WeighedParts parts = weighed(emitters_.of(side), kind, p);
  const auto n = static_cast<float>(u.size());
  // Choices rise, so samples of one mesh follow one another.
  EmitterPieces::Weights pieces;
  size_t of = lights.emitterCount();
  for (size_t k = 0; k < u.size(); ++k) {
    const LightTree::Choice c = chooseLight(parts, kind, p, std::min((choice + static_cast<float>(k)) / n, kBelowOne));
    out[k] = {};
    if (!(c.chance > 0)) continue;
    if (c.index != of) of = c.index, pieces = lights.emitterPieces(of, p);
    out[k] = lights.sampleEmitter(of, pieces, p, u[k], c.rest);
    out[k].radiance *= 1 / (c.chance * n), out[k].pdf *= c.chance * n;
  }
}

float SeenLights::pdfEmitters(const Lights& lights, Vec3 p, int32_t side, const SurfacePoint& q) const {
  const int32_t index = lights.emitterOf(q.instance);
  if (index < 0) return 0;
  const auto i = static_cast<size_t>(index);
  const float c = chanceOfLight(emitters_.of(side), EmitterChoice{lights}, i, p);
  return c > 0 ? c * lights.pdfEmitter(i, p, q) : 0;
}

}  // namespace roomlight
