#include "radiance/seen_lights.h"

#include <algorithm>
#include <array>
#include <atomic>

#include "base/parallel.h"
#include "base/weighted_choice.h"
#include "trace/light_looks.h"

namespace roomlight {
namespace {

constexpr uint32_t kRays = 8, kFewRays = 2;
constexpr float kMatters = 0.01f, kHardly = 1e-4f;  // of what all could give a side: lights that could give more send kRays, and kFewRays
constexpr uint32_t kDraws = 128;       // rays of a side to lights drawn among many
constexpr float kLikeParent = 4;       // draws: so much a group's parent tells of what is seen of it
constexpr float kMixed = 2;        // draws: groups that are seen in part are taken apart while they have more of these seen and hidden

struct Lamps {
  static constexpr uint64_t kKey = 17;
  const Lights& lights;
  size_t count() const { return lights.lampCount(); }
  const LightTree& tree() const { return lights.lampTree(); }
  float importance(size_t i, Vec3 p) const { return lights.lampImportance(i, p); }
  LightSample sample(size_t i, Vec3 p, Vec2 u, float) const { return lights.sampleLamp(i, p, u); }
  LightTree::Choice choose(Vec3 p, float choice) const { return lights.chooseLamp(p, choice); }
  float chance(size_t i, Vec3 p) const { return lights.chanceOfLamp(i, p); }
};

struct Emitters {
  static constexpr uint64_t kKey = 18;
  const Lights& lights;
  size_t count() const { return lights.emitterCount(); }
  const LightTree& tree() const { return lights.emitterTree(); }
  float importance(size_t i, Vec3 p) const { return lights.emitterImportance(i, p); }
  LightSample sample(size_t i, Vec3 p, Vec2 u, float choice) const { return lights.sampleEmitter(i, p, u, choice); }
  LightTree::Choice choose(Vec3 p, float choice) const { return lights.chooseEmitter(p, choice); }
  float chance(size_t i, Vec3 p) const { return lights.chanceOfEmitter(i, p); }
};

// What one of the listed could give at p without shadows.
template <class Kind>
float couldGive(const Kind& kind, uint32_t which, Vec3 p) {
  if (kind.tree().empty()) return kind.importance(which, p);
  return kind.tree().weight(which, p, [&](size_t i) { return kind.importance(i, p); });
}

// The k-th of n places on slots of a side.
struct PlaceOnSide {
  PlaceOnSide(const Voxels& voxels, const SlotPaths& paths, std::span<const uint32_t> slots, uint32_t k, uint32_t n, Sampler& sampler) {
    const uint32_t s = slots[std::min(slots.size() - 1, static_cast<size_t>((static_cast<float>(k) + sampler.fast1()) / static_cast<float>(n) * static_cast<float>(slots.size())))];
    p = paths.point(s, k), normal = voxels.slots[s].normal;
  }
  Vec3 p, normal;
};

}  // namespace

// Few lights: each is looked for.
class SeenLights::Singles {
 public:
  template <class Kind>
  explicit Singles(const Kind& kind) : ones_(kind.count()) {}

  template <class Kind>
  void look(const RayScene& rays, const Voxels& voxels, const SlotPaths& paths, const Kind& kind, std::span<const uint32_t> slots, Sampler& sampler, std::atomic<uint64_t>& count) {
    std::vector<float> could(ones_.size());  // at three places
    float total = 0;
    for (size_t i = 0; i < ones_.size(); ++i) {
      ones_[i] = {};
      for (const size_t s : {size_t{0}, slots.size() / 2, slots.size() - 1}) could[i] += kind.importance(i, voxels.slots[slots[s]].position);
      total += could[i];
    }
    for (uint32_t i = 0; i < ones_.size(); ++i) {
      const uint32_t tries = could[i] > kMatters * total ? kRays : could[i] > kHardly * total ? kFewRays
                                                                                              : 0;
      for (uint32_t k = 0; k < tries; ++k) {
        const PlaceOnSide at(voxels, paths, slots, k, tries, sampler);
        const Vec2 u{sampler.fast1(), sampler.fast1()};
        looks_.add(i, kind.importance(i, at.p), kind.sample(i, at.p, u, sampler.fast1()), at.p, at.normal);
      }
    }
    count += looks_.finish(rays, [&](uint32_t i, float asked, float found) { ones_[i].add(asked, found); });
  }
  void list(std::vector<Seen>& out) const {
    for (uint32_t i = 0; i < ones_.size(); ++i) out.push_back({i, ones_[i].part()});
  }

 private:
  std::vector<LightLook> ones_;
  LightLooks looks_;
};

// Many lights: some are drawn, and what is found of them tells what is seen of the groups that hold them.
class SeenLights::Groups {
 public:
  template <class Kind>
  explicit Groups(const Kind& kind) : tree_(kind.tree()), found_(tree_.nodeCount()) {}

  template <class Kind>
  void look(const RayScene& rays, const Voxels& voxels, const SlotPaths& paths, const Kind& kind, std::span<const uint32_t> slots, Sampler& sampler, std::atomic<uint64_t>& count) {
    found_.assign(found_.size(), {});
    side_ = {};
    for (const uint32_t s : slots) side_.add(voxels.slots[s].position);
    for (uint32_t k = 0; k < kDraws; ++k) {
      const PlaceOnSide at(voxels, paths, slots, k, kDraws, sampler);
      const LightTree::Choice c = kind.choose(at.p, sampler.fast1());
      const Vec2 u{sampler.fast1(), sampler.fast1()};
      if (c.chance > 0) looks_.add(static_cast<uint32_t>(c.index), kind.importance(c.index, at.p), kind.sample(c.index, at.p, u, c.rest), at.p, at.normal, c.chance);
    }
    count += looks_.finish(rays, [&](uint32_t light, float asked, float found) {
      for (uint32_t node = tree_.leafOf(light);; node = tree_.parent(node)) {
        found_[node].add(asked, found);
        if (node == 0) break;
      }
    });
  }

  // Those apart that are near, then those that are seen in part.
  void list(std::vector<Seen>& out) const {
    const float perDraw = std::max(found_[0].asked / static_cast<float>(kDraws), 1e-30f);
    std::vector<Group> groups{group(0, LightLook::kUntried, perDraw)};
    while (groups.size() < kMost) {
      const auto most = std::max_element(groups.begin(), groups.end(), [](const Group& a, const Group& b) { return a.worth < b.worth; });
      if (!(most->worth > 0)) break;
      const Group apart = *most;
      *most = group(tree_.left(apart.node), apart.part, perDraw);
      groups.push_back(group(tree_.right(apart.node), apart.part, perDraw));
    }
    for (const Group& g : groups) out.push_back({g.node, std::max(g.part, LightLook::kFloor)});
  }

 private:
  struct Group {
    uint32_t node;
    float part, worth;  // to take it apart; 0: none
  };
  Group group(uint32_t node, float partOfParent, float perDraw) const {
    const float asked = found_[node].asked / perDraw, found = found_[node].found / perDraw;
    const float part = (found + kLikeParent * partOfParent) / (asked + kLikeParent), mixed = asked * part * std::max(0.0f, 1 - part);
    if (tree_.isLeaf(node)) return {node, part, 0};
    if (tree_.isWide(node, side_)) return {node, part, static_cast<float>(kDraws) + asked};
    return {node, part, mixed > kMixed ? mixed : 0};
  }

  const LightTree& tree_;
  std::vector<LightLook> found_;  // of each node
  Bounds3 side_;
  LightLooks looks_;
};

template <class Learner, class Kind>
SeenLights::Table SeenLights::learn(const RayScene& rays, const Voxels& voxels, const SlotPaths& paths, const Kind& kind, uint64_t seed, std::atomic<uint64_t>& count) {
  std::vector<std::vector<Seen>> found(kBrickSides * voxels.bricks.size());
  parallelFor(voxels.bricks.size(), 4, [&](size_t b) {
    std::array<std::vector<uint32_t>, kBrickSides> slots;
    const auto [first, last] = slotsOfBrick(voxels, b);
    for (size_t s = first; s < last; ++s) slots[voxels.slots[s].face].push_back(static_cast<uint32_t>(s));
    Learner learner(kind);
    for (size_t face = 0; face < kBrickSides; ++face) {
      if (slots[face].empty()) continue;
      Sampler sampler(paths.key(slots[face][0]), 0, seed + Kind::kKey);
      learner.look(rays, voxels, paths, kind, slots[face], sampler, count);
      learner.list(found[kBrickSides * b + face]);
    }
  });
  Table table;
  for (const auto& list : found) {
    table.first.push_back(static_cast<uint32_t>(table.seen.size()));
    table.seen.insert(table.seen.end(), list.begin(), list.end());
  }
  table.first.push_back(static_cast<uint32_t>(table.seen.size()));
  return table;
}

template <class Kind>
SeenLights::Table SeenLights::learn(const RayScene& rays, const Voxels& voxels, const SlotPaths& paths, const Kind& kind, uint64_t seed, std::atomic<uint64_t>& count) {
  if (kind.count() < 2) return {};  // nothing to choose
  return kind.tree().empty() ? learn<Singles>(rays, voxels, paths, kind, seed, count) : learn<Groups>(rays, voxels, paths, kind, seed, count);
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
  for (size_t i = 0; i < w.seen.size(); ++i) w.sum += w.own[i] = w.seen[i].part * couldGive(kind, w.seen[i].which, p);
  return w;
}

template <class Kind>
LightTree::Choice SeenLights::choose(const Weighed& w, const Kind& kind, Vec3 p, float choice) {
  if (w.seen.empty()) return kind.choose(p, choice);
  if (!(w.sum > 0)) return {};
  const size_t chosen = chooseByWeight(
      w.seen.size(), w.sum, [&](size_t i) { return w.own[i]; }, choice);
  const uint32_t which = w.seen[chosen].which;
  LightTree::Choice c = kind.tree().empty() ? LightTree::Choice{which, 1, choice} : kind.tree().chooseIn(which, p, choice, [&](size_t i) { return kind.importance(i, p); });
  c.chance *= w.own[chosen] / w.sum;
  return c;
}

template <class Kind>
float SeenLights::chance(const Table& table, const Kind& kind, size_t light, Vec3 p, int32_t side) {
  const Weighed w = weigh(table, kind, p, side);
  if (w.seen.empty()) return kind.chance(light, p);
  if (!(w.sum > 0)) return 0;
  const LightTree& tree = kind.tree();
  const auto holds = [&](const Seen& s) { return tree.empty() ? s.which == light : tree.holds(s.which, light); };
  const auto at = static_cast<size_t>(std::find_if(w.seen.begin(), w.seen.end(), holds) - w.seen.begin());
  const float within = tree.empty() ? 1 : tree.chanceIn(w.seen[at].which, light, p, [&](size_t i) { return kind.importance(i, p); });
  return within * w.own[at] / w.sum;
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
  // Choices rise, so samples of one mesh follow one another.
  EmitterPieces::Weights pieces;
  size_t of = lights.emitterCount();
  for (size_t k = 0; k < u.size(); ++k) {
    const LightTree::Choice c = choose(weighed, kind, p, std::min((choice + static_cast<float>(k)) / n, kBelowOne));
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
  const float c = chance(emitters_, Emitters{lights}, i, p, side);
  return c > 0 ? c * lights.pdfEmitter(i, p, q) : 0;
}

}  // namespace roomlight
