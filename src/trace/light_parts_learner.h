// Finds out by shadow rays what part of the light that lights could give arrives at places that are near one another
 // and look the same way.
#pragma once

#include "trace/light_looks.h"
#include "trace/light_parts.h"

namespace roomlight {

// Few lights, each of which is looked for.
class SinglePartsLearner {
 public:
  template <class Kind>
  explicit SinglePartsLearner(const Kind& kind) : ones_(kind.count()) {}

  template <class Kind, class Places>
  size_t look(const RayScene& rays, const Kind& kind, const Places& places, Sampler& sampler) {
    could_.assign(ones_.size(), 0);  // at three places
    float total = 0;
    for (size_t i = 0; i < ones_.size(); ++i) {
      ones_[i] = {};
      for (const size_t k : {size_t{0}, places.size() / 2, places.size() - 1})
        could_[i] += kind.importance(i, places.position(k));
      total += could_[i];
    }
    for (uint32_t i = 0; i < ones_.size(); ++i) {
      const uint32_t tries = could_[i] > kMatters * total  ? places.kRays
                             : could_[i] > kHardly * total ? places.kFewRays
                                                           : 0;
      for (uint32_t k = 0; k < tries; ++k) {
        const auto at = places.draw(k, tries, sampler);
        const Vec2 u{sampler.fast1(), sampler.fast1()};
        looks_.add(i, kind.importance(i, at.p), kind.sample(i, at.p, u, sampler.fast1()), at.p, at.n);
      }
    }
    return looks_.finish(rays, [&](uint32_t i, float asked, float found) { ones_[i].add(asked, found); });
  }
  void list(std::vector<LightPart>& out) const {
    for (uint32_t i = 0; i < ones_.size(); ++i) out.push_back({i, ones_[i].part()});
  }

 private:
  static constexpr float kMatters = 0.01f,
                         kHardly =
                             1e-4f;  // of what all could give: lights that could give more are sent kRays, and kFewRays
  std::vector<LightLook> ones_;
  std::vector<float> could_;
  LightLooks looks_;
};

// Many lights: some are drawn, and what is found of them tells what is seen of the groups that hold them.
class GroupPartsLearner {
 public:
  template <class Kind>
  explicit GroupPartsLearner(const Kind& kind) : tree_(kind.tree()), found_(tree_.nodeCount()) {}

  template <class Kind, class Places>
  size_t look(const RayScene& rays, const Kind& kind, const Places& places, Sampler& sampler) {
    for (const uint32_t node : touched_) found_[node] = {};
    touched_.clear();
    within_ = places.bounds();
    for (uint32_t k = 0; k < kDraws; ++k) {
      const auto at = places.draw(k, kDraws, sampler);
      const LightTree::Choice c = kind.choose(at.p, sampler.fast1());
      const Vec2 u{sampler.fast1(), sampler.fast1()};
      if (c.chance > 0)
        looks_.add(static_cast<uint32_t>(c.index), kind.importance(c.index, at.p),
                   kind.sample(c.index, at.p, u, c.rest), at.p, at.n, c.chance);
    }
    return looks_.finish(rays, [&](uint32_t light, float asked, float found) {
      for (uint32_t node = tree_.leafOf(light);; node = tree_.parent(node)) {
        found_[node].add(asked, found);
        touched_.push_back(node);
        if (node == 0) break;
      }
    });
  }

  // Those apart that are near, then those that are seen in part.
  void list(std::vector<LightPart>& out) const {
    const float perDraw = std::max(found_[0].asked / static_cast<float>(kDraws), 1e-30f);
    std::vector<Group> groups{group(0, LightLook::kUntried, perDraw)};
    while (groups.size() < kMostParts) {
      const auto most = std::max_element(groups.begin(), groups.end(),
                                         [](const Group& a, const Group& b) { return a.worth < b.worth; });
      if (!(most->worth > 0)) break;
      const Group apart = *most;
      *most = group(tree_.left(apart.node), apart.part, perDraw);
      groups.push_back(group(tree_.right(apart.node), apart.part, perDraw));
    }
    for (const Group& g : groups) out.push_back({g.node, std::max(g.part, LightLook::kFloor)});
  }

 private:
  static constexpr uint32_t kDraws = 128;  // rays to lights drawn
  static constexpr float kLikeParent = 4;  // draws: so much a group's parent tells of what is seen of it
  static constexpr float kMixed =
      2;  // draws: groups that are seen in part are taken apart while they have more of these seen and hidden
  struct Group {
    uint32_t node;
    float part, worth;  // to take it apart; 0: none
  };
  Group group(uint32_t node, float partOfParent, float perDraw) const {
    const float asked = found_[node].asked / perDraw, found = found_[node].found / perDraw;
    const float part = (found + kLikeParent * partOfParent) / (asked + kLikeParent),
                mixed = asked * part * std::max(0.0f, 1 - part);
    if (tree_.isLeaf(node)) return {node, part, 0};
    if (tree_.isWide(node, within_)) return {node, part, static_cast<float>(kDraws) + asked};
    return {node, part, mixed > kMixed ? mixed : 0};
  }

  const LightTree& tree_;
  std::vector<LightLook> found_;  // of each node
  std::vector<uint32_t> touched_;  // nodes of which something was found
  Bounds3 within_;
  LightLooks looks_;
};

// Calls work(learner) with the one that suits so many lights.
template <class Kind, class Work>
void withPartsLearner(const Kind& kind, const Work& work) {
  if (kind.tree().empty()) {
    SinglePartsLearner learner(kind);
    work(learner);
  } else {
    GroupPartsLearner learner(kind);
    work(learner);
  }
}

}  // namespace roomlight
