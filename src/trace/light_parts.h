// What part of the light that lights could give arrives at a place, as shadow rays found, and choices by that (after
// Vévoda, Kondapaneni & Křivánek 2018, "Bayesian online regression for adaptive direct illumination sampling"; learned
// once, so that it does not depend on threads).
#pragma once

#include <algorithm>
#include <array>
#include <span>

#include "base/sampling.h"
#include "trace/lights.h"

namespace roomlight {

struct LightPart {
  uint32_t which;  // a light; where there are many, a node of their tree
  float part;  // of what it could give without shadows; above 0
};
constexpr size_t kMostParts = Lights::kMostOneByOne;  // of a place; together they hold all lights

// Kinds of lights to choose among.
struct LampChoice {
  const Lights& lights;
  size_t count() const { return lights.lampCount(); }
  const LightTree& tree() const { return lights.lampTree(); }
  float importance(size_t i, Vec3 p) const { return lights.lampImportance(i, p); }
  LightSample sample(size_t i, Vec3 p, Vec2 u, float) const { return lights.sampleLamp(i, p, u); }
  LightTree::Choice choose(Vec3 p, float choice) const { return lights.chooseLamp(p, choice); }
  float chance(size_t i, Vec3 p) const { return lights.chanceOfLamp(i, p); }
};
struct EmitterChoice {
  const Lights& lights;
  size_t count() const { return lights.emitterCount(); }
  const LightTree& tree() const { return lights.emitterTree(); }
  float importance(size_t i, Vec3 p) const { return lights.emitterImportance(i, p); }
  LightSample sample(size_t i, Vec3 p, Vec2 u, float choice) const { return lights.sampleEmitter(i, p, u, choice); }
  LightTree::Choice choose(Vec3 p, float choice) const { return lights.chooseEmitter(p, choice); }
  float chance(size_t i, Vec3 p) const { return lights.chanceOfEmitter(i, p); }
};
// Lamps first, then emissive meshes.
struct LocalChoice {
  const Lights& lights;
  size_t count() const { return lights.localCount(); }
  const LightTree& tree() const { return lights.localTree(); }
  float importance(size_t i, Vec3 p) const { return lights.localImportance(i, p); }
  LightSample sample(size_t i, Vec3 p, Vec2 u, float choice) const {
    return i < lights.lampCount() ? lights.sampleLamp(i, p, u)
                                  : lights.sampleEmitter(i - lights.lampCount(), p, u, choice);
  }
  LightTree::Choice choose(Vec3 p, float choice) const { return lights.chooseLocal(p, choice); }
  float chance(size_t i, Vec3 p) const { return lights.chanceOfLocal(i, p); }
};

// What one of the parts could give at p without shadows.
template <class Kind>
float couldGive(const Kind& kind, uint32_t which, Vec3 p) {
  if (kind.tree().empty()) return kind.importance(which, p);
  return kind.tree().weight(which, p, [&](size_t i) { return kind.importance(i, p); });
}

struct WeighedParts {
  std::span<const LightPart> parts;
  std::array<float, kMostParts> own;
  float sum = 0;
};

template <class Kind>
WeighedParts weighed(std::span<const LightPart> parts, const Kind& kind, Vec3 p) {
  WeighedParts w;
  w.parts = parts;
  for (size_t i = 0; i < parts.size(); ++i) w.sum += w.own[i] = parts[i].part * couldGive(kind, parts[i].which, p);
  return w;
}

// By what arrives; without parts by what could be given without shadows.
template <class Kind>
LightTree::Choice chooseLight(const WeighedParts& w, const Kind& kind, Vec3 p, float choice) {
  if (w.parts.empty()) return kind.choose(p, choice);
  if (!(w.sum > 0)) return {};
  const size_t chosen = chooseByWeight(
      w.parts.size(), w.sum, [&](size_t i) { return w.own[i]; }, choice);
  const uint32_t which = w.parts[chosen].which;
  LightTree::Choice c = kind.tree().empty()
                            ? LightTree::Choice{which, 1, choice}
                            : kind.tree().chooseIn(which, p, choice, [&](size_t i) { return kind.importance(i, p); });
  c.chance *= w.own[chosen] / w.sum;
  return c;
}

// With which chooseLight() chooses it.
template <class Kind>
float chanceOfLight(std::span<const LightPart> parts, const Kind& kind, size_t light, Vec3 p) {
  if (parts.empty()) return kind.chance(light, p);
  const WeighedParts w = weighed(parts, kind, p);
  if (!(w.sum > 0)) return 0;
  const LightTree& tree = kind.tree();
  const auto holds = [&](const LightPart& part) {
    return tree.empty() ? part.which == light : tree.holds(part.which, light);
  };
  const auto at = static_cast<size_t>(std::find_if(parts.begin(), parts.end(), holds) - parts.begin());
  const float within =
      tree.empty() ? 1 : tree.chanceIn(parts[at].which, light, p, [&](size_t i) { return kind.importance(i, p); });
  return within * w.own[at] / w.sum;
}

// One sample among lamps and emissive meshes.
LightSample sampleLocal(const Lights& lights, std::span<const LightPart> parts, Vec3 p, Vec2 u, float choice);
// Density with which it would have chosen the direction to point q of an emissive triangle.
float pdfLocal(const Lights& lights, std::span<const LightPart> parts, Vec3 p, const SurfacePoint& q);

}  // namespace roomlight
