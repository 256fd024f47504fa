#include "radiance/seen_lights.h"

#include <algorithm>
#include <array>
#include <atomic>

#include "base/parallel.h"
#include "base/weighted_choice.h"
#include "trace/shadow_ray.h"

namespace roomlight {
namespace {

constexpr size_t kOneByOne = 256, kDrawn = 128;  // lights of which each is looked at; of more so many are drawn
constexpr uint32_t kRays = 8, kFewRays = 2;
constexpr float kMatters = 0.01f, kHardly = 1e-4f;  // of what all could give a side: lights that could give more send kRays, and kFewRays
constexpr float kFloor = 0.03f;        // a light that no ray found gives that part of what it could
constexpr float kUntried = 0.25f;      // and one that no ray looked for
constexpr float kOthers = 0.05f, kWorthIt = 0.5f;  // of samples at least, where lists leave lights out; a list that holds less than half of the light is none

struct Lamps {
  static constexpr uint64_t kKey = 17;
  const Lights& lights;
  size_t count() const { return lights.lampCount(); }
  float importance(size_t i, Vec3 p) const { return lights.lampImportance(i, p); }
  LightSample sample(size_t i, Vec3 p, Vec2 u, float) const { return lights.sampleLamp(i, p, u); }
  LightTree::Choice choose(Vec3 p, float choice) const { return lights.chooseLamp(p, choice); }
  float chance(size_t i, Vec3 p) const { return lights.chanceOfLamp(i, p); }
};

struct Emitters {
  static constexpr uint64_t kKey = 18;
  const Lights& lights;
  size_t count() const { return lights.emitterCount(); }
  float importance(size_t i, Vec3 p) const { return lights.emitterImportance(i, p); }
  LightSample sample(size_t i, Vec3 p, Vec2 u, float choice) const { return lights.sampleEmitter(i, p, u, choice); }
  LightTree::Choice choose(Vec3 p, float choice) const { return lights.chooseEmitter(p, choice); }
  float chance(size_t i, Vec3 p) const { return lights.chanceOfEmitter(i, p); }
};

// Lights that one side might see.
class Candidates {
 public:
  struct One {
    uint32_t light;
    float could = 0, found = 0, asked = 0;  // without shadows at three places; by rays, and what these could have found
    bool tried = false;
    // Nothing was asked of a spot that shines on other places of the side.
    float part() const { return tried && asked > 0 ? std::max(found, kFloor * asked) / asked : kUntried; }
  };

  template <class Kind>
  Candidates(const Kind& kind, const Voxels& voxels, std::span<const uint32_t> slots, size_t most, Sampler& sampler) {
    const size_t n = slots.size();
    const Vec3 at[] = {voxels.slots[slots[0]].position, voxels.slots[slots[n / 2]].position, voxels.slots[slots[n - 1]].position};
    std::vector<uint32_t> lights;
    const bool drawn = kind.count() > kOneByOne;
    if (!drawn) {
      for (uint32_t i = 0; i < kind.count(); ++i) lights.push_back(i);
    } else {
      for (size_t k = 0; k < kDrawn; ++k) {
        const LightTree::Choice c = kind.choose(at[k % 3], sampler.fast1());
        if (c.chance > 0) lights.push_back(static_cast<uint32_t>(c.index));
      }
      std::sort(lights.begin(), lights.end());
      lights.erase(std::unique(lights.begin(), lights.end()), lights.end());
    }
    for (const uint32_t i : lights) {
      One& one = all.emplace_back(One{i});
      for (const Vec3 p : at) one.could += kind.importance(i, p);
    }
    std::sort(all.begin(), all.end(), [](const One& a, const One& b) { return a.could != b.could ? a.could > b.could : a.light < b.light; });
    float whole = 0;
    for (const One& one : all) whole += one.could;
    all.resize(std::min(all.size(), most));
    for (const One& one : all) total += one.could;
    float listed = 0;
    for (const One& one : all) listed += !drawn ? one.could / std::max(whole, 1e-30f) : kind.chance(one.light, at[1]);
    others = std::max(1 - listed, kOthers);
    if (listed < kWorthIt) all.clear();
  }

  std::vector<One> all;
  float total = 0, others = 0;  // what those in the list could give; the part that others could: of samples, for them
};

}  // namespace

template <class Kind>
SeenLights::Table SeenLights::learn(const RayScene& rays, const Voxels& voxels, const SlotPaths& paths, const Kind& kind, uint64_t seed, std::atomic<uint64_t>& count) {
  Table table;
  if (kind.count() < 2) return table;  // nothing to choose
  std::vector<std::vector<Seen>> found(kBrickSides * voxels.bricks.size());
  table.others.assign(kind.count() > kMost ? found.size() : 0, 1);
  parallelFor(voxels.bricks.size(), 4, [&](size_t b) {
    std::array<std::vector<uint32_t>, kBrickSides> slots;
    const auto [first, last] = slotsOfBrick(voxels, b);
    for (size_t s = first; s < last; ++s) slots[voxels.slots[s].face].push_back(static_cast<uint32_t>(s));
    std::vector<Ray> ways;
    std::vector<std::pair<Candidates::One*, float>> gives;
    std::vector<Vec3> left;
    for (size_t face = 0; face < kBrickSides; ++face) {
      if (slots[face].empty()) continue;
      Sampler sampler(paths.key(slots[face][0]), 0, seed + Kind::kKey);
      Candidates candidates(kind, voxels, slots[face], kMost, sampler);
      ways.clear(), gives.clear();
      for (Candidates::One& one : candidates.all) {
        const uint32_t tries = one.could > kMatters * candidates.total ? kRays : one.could > kHardly * candidates.total ? kFewRays
                                                                                                                        : 0;
        one.tried = tries > 0;
        for (uint32_t k = 0; k < tries; ++k) {
          const uint32_t s = slots[face][std::min(slots[face].size() - 1, static_cast<size_t>((static_cast<float>(k) + sampler.fast1()) / static_cast<float>(tries) * static_cast<float>(slots[face].size())))];
          const Vec3 p = paths.point(s, k);
          one.asked += kind.importance(one.light, p);
          const Vec2 u{sampler.fast1(), sampler.fast1()};
          const LightSample light = kind.sample(one.light, p, u, sampler.fast1());
          const float cosine = dot(light.wi, voxels.slots[s].normal);
          if (!light.valid() || cosine <= 0) continue;
          ways.push_back(shadowRay(p, p, light)), gives.emplace_back(&one, luminance(light.radiance) * cosine);
        }
      }
      left.resize(ways.size());
      rays.transmittance(ways, left);
      count += ways.size();
      for (size_t i = 0; i < ways.size(); ++i) gives[i].first->found += gives[i].second * luminance(left[i]);
      if (!table.others.empty()) table.others[kBrickSides * b + face] = candidates.others;
      for (const Candidates::One& one : candidates.all) found[kBrickSides * b + face].push_back({one.light, one.part()});
    }
  });
  for (const auto& list : found) {
    table.first.push_back(static_cast<uint32_t>(table.seen.size()));
    table.seen.insert(table.seen.end(), list.begin(), list.end());
  }
  table.first.push_back(static_cast<uint32_t>(table.seen.size()));
  return table;
}

SeenLights::SeenLights(const RayScene& rays, const Lights& lights, const Voxels& voxels, const SlotPaths& paths, uint64_t seed, uint64_t& rayCount) {
  std::atomic<uint64_t> count = 0;
  lamps_ = learn(rays, voxels, paths, Lamps{lights}, seed, count);
  emitters_ = learn(rays, voxels, paths, Emitters{lights}, seed, count);
  rayCount += count;
}

template <class Kind>
SeenLights::Weighed SeenLights::weigh(const Table& table, const Kind& kind, Vec3 p, int32_t side) {
  Weighed w;
  w.seen = table.of(side);
  if (w.seen.empty()) return w;
  for (size_t i = 0; i < w.seen.size(); ++i) w.sum += w.own[i] = w.seen[i].part * kind.importance(w.seen[i].light, p);
  w.others = table.othersOf(side, w.sum);
  return w;
}

template <class Kind>
LightTree::Choice SeenLights::choose(const Weighed& w, const Kind& kind, Vec3 p, float choice) {
  if (choice < w.others) {
    LightTree::Choice c = kind.choose(p, w.seen.empty() ? choice : choice / w.others);
    for (const Seen& s : w.seen) {
      if (s.light == c.index) return {};
    }
    c.chance *= w.others;
    return c;
  }
  if (!(w.sum > 0)) return {};
  float rest = std::min((choice - w.others) / (1 - w.others), kBelowOne);
  const size_t chosen = chooseByWeight(
      w.seen.size(), w.sum, [&](size_t i) { return w.own[i]; }, rest);
  return {w.seen[chosen].light, (1 - w.others) * w.own[chosen] / w.sum, rest};
}

template <class Kind>
float SeenLights::chance(const Table& table, const Kind& kind, size_t light, Vec3 p, int32_t side) {
  const auto seen = table.of(side);
  if (seen.empty()) return kind.chance(light, p);
  float sum = 0, own = -1;
  for (const Seen& s : seen) {
    const float w = s.part * kind.importance(s.light, p);
    sum += w;
    if (s.light == light) own = w;
  }
  const float others = table.othersOf(side, sum);
  if (own < 0) return others > 0 ? others * kind.chance(light, p) : 0;
  return sum > 0 ? (1 - others) * own / sum : 0;
}

LightSample SeenLights::sampleLamps(const Lights& lights, Vec3 p, int32_t side, Sampler& sampler) const {
  const Lamps kind{lights};
  const float choice = sampler.next1();
  const Vec2 u = lights.hasExtendedLamps() ? sampler.next2() : Vec2{};
  const LightTree::Choice c = choose(weigh(lamps_, kind, p, side), kind, p, choice);
  if (!(c.chance > 0)) return {};
  LightSample s = lights.sampleLamp(c.index, p, u);
  s.radiance *= 1 / c.chance;
  return s;
}

void SeenLights::sampleEmitters(const Lights& lights, Vec3 p, int32_t side, std::span<const Vec2> u, float choice, std::span<LightSample> out) const {
  const Emitters kind{lights};
  const Weighed weighed = weigh(emitters_, kind, p, side);
  const auto n = static_cast<float>(u.size());
  for (size_t k = 0; k < u.size(); ++k) {
    const LightTree::Choice c = choose(weighed, kind, p, std::min((choice + static_cast<float>(k)) / n, kBelowOne));
    out[k] = {};
    if (!(c.chance > 0)) continue;
    out[k] = lights.sampleEmitter(c.index, p, u[k], c.rest);
    out[k].radiance *= 1 / (c.chance * n), out[k].pdf *= c.chance * n;
  }
}

float SeenLights::pdfEmitters(const Lights& lights, Vec3 p, int32_t side, const SurfacePoint& q) const {
  const int32_t index = lights.emitterOf(q.instance);
  if (index < 0) return 0;
  const auto i = static_cast<size_t>(index);
  const float c = chance(emitters_, Emitters{lights}, i, p, side);
  return c > 0 ? c * lights.pdfEmitter(i, p, q) : 0;
}

}  // namespace roomlight
