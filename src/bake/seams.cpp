#include "bake/seams.h"

#include <algorithm>
#include <cmath>

namespace roomlight::bake {
namespace {

constexpr float kAlike = 0.9f;          // cosine between normals of two charts where one goes on as the other
constexpr float kAlikeHere = 0.995f;    // where both have the same place
constexpr float kAlikeCharts = 0.6f;    // between those of the charts, which may bend
constexpr float kOffSurfaceM = 0.001f;  // that the other may lie off an arc through both places
constexpr float kNearTexels = 0.75f;    // from where a texel of the other is looked for to its place
constexpr float kTouchTexels = 0.45f;   // from the edge of a chart to a place that it reaches
constexpr float kLeastLiftM = 0.005f, kLift = 0.1f;  // of rays off the surface: of their length

float texelM(const PlacedChart& of) { return 1 / std::min(of.grid.perM.x, of.grid.perM.y); }

bool overlap(const Bounds3& a, const Bounds3& b) {
  return a.lo.x <= b.hi.x && b.lo.x <= a.hi.x && a.lo.y <= b.hi.y && b.lo.y <= a.hi.y && a.lo.z <= b.hi.z &&
         b.lo.z <= a.hi.z;
}

}  // namespace

std::vector<uint32_t> elementsByTexel(const Atlas& atlas) {
  std::vector<uint32_t> out(static_cast<size_t>(atlas.width) * static_cast<size_t>(atlas.height), kNoElement);
  for (size_t i = 0; i < atlas.texels.size(); ++i) out[atlas.texels[i]] = static_cast<uint32_t>(i);
  return out;
}

Seams::Seams(const Atlas& atlas, std::span<const uint32_t> elementAt, const RayScene& rays, float reachTexels)
    : atlas_(atlas), elementAt_(elementAt), rays_(rays), near_(atlas.charts.size()) {
  findNearCharts(reachTexels);
}

void Seams::findNearCharts(float reachTexels) {
  std::vector<Bounds3> bounds(near_.size());
  for (size_t i = 0; i < atlas_.elements.size(); ++i) bounds[atlas_.chartOf[i]].add(atlas_.elements[i].position);
  std::vector<uint32_t> order;
  for (uint32_t c = 0; c < near_.size(); ++c) {
    if (atlas_.charts[c].chart.byVertices || bounds[c].empty()) continue;
    const Vec3 reach((reachTexels + 1) * texelM(atlas_.charts[c]));
    bounds[c].lo = bounds[c].lo - reach, bounds[c].hi = bounds[c].hi + reach;
    order.push_back(c);
  }
  std::sort(order.begin(), order.end(),
            [&](uint32_t a, uint32_t b) { return std::pair(bounds[a].lo.x, a) < std::pair(bounds[b].lo.x, b); });
  for (size_t k = 0; k < order.size(); ++k) {
    const uint32_t a = order[k];
    for (size_t l = k + 1; l < order.size() && bounds[order[l]].lo.x <= bounds[a].hi.x; ++l) {
      const uint32_t b = order[l];
      if (!overlap(bounds[a], bounds[b])) continue;
      if (dot(atlas_.charts[a].chart.normal, atlas_.charts[b].chart.normal) < kAlikeCharts) continue;
      near_[a].push_back(b), near_[b].push_back(a);
    }
  }
  for (std::vector<uint32_t>& of : near_) std::sort(of.begin(), of.end());
}

Vec2 Seams::onGrid(const PlacedChart& placed, Vec3 p) {
  const Chart& plane = placed.chart;
  return {(dot(p, plane.alongU) - plane.lowM.x) * placed.grid.perM.x,
          (dot(p, plane.alongV) - plane.lowM.y) * placed.grid.perM.y};
}

uint32_t Seams::elementOf(uint32_t chart, int column, int row) const {
  const PlacedChart& placed = atlas_.charts[chart];
  if (column < 0 || row < 0 || column >= placed.grid.width || row >= placed.grid.height) return kNoElement;
  const int x = placed.left + kGap + column, y = placed.top + kGap + row;
  const uint32_t found =
      elementAt_[static_cast<size_t>(y) * static_cast<size_t>(atlas_.width) + static_cast<size_t>(x)];
  return found != kNoElement && atlas_.chartOf[found] == chart ? found : kNoElement;
}

bool Seams::goesOn(const SurfaceElement& a, const SurfaceElement& b, float alike) const {
  const Vec3 d = b.position - a.position;
  if (dot(a.normal, b.normal) < alike || std::abs(dot(d, a.normal + b.normal)) > 2 * kOffSurfaceM) return false;
  const float lift = std::max(kLeastLiftM, kLift * length(d));
  const Vec3 from = a.position + a.normal * lift, to = b.position + b.normal * lift;
  return luminance(rays_.transmittance({from, to - from, 0, 1})) > 0;
}

uint32_t Seams::beyond(size_t element, Vec2 texels) const {
  const uint32_t own = atlas_.chartOf[element];
  const PlacedChart& placed = atlas_.charts[own];
  const SurfaceElement& from = atlas_.elements[element];
  const Vec3 p = from.position + placed.chart.alongU * (texels.x / placed.grid.perM.x) +
                 placed.chart.alongV * (texels.y / placed.grid.perM.y);
  for (const uint32_t other : near_[own]) {
    const Vec2 at = onGrid(atlas_.charts[other], p);
    const uint32_t found =
        elementOf(other, static_cast<int>(std::floor(at.x + 0.5f)), static_cast<int>(std::floor(at.y + 0.5f)));
    if (found == kNoElement) continue;
    const SurfaceElement& to = atlas_.elements[found];
    if (length(to.position - p) <= kNearTexels * texelM(atlas_.charts[other]) && goesOn(from, to, kAlike)) return found;
  }
  return kNoElement;
}

std::vector<std::pair<uint32_t, float>> Seams::at(size_t element) const {
  std::vector<std::pair<uint32_t, float>> out;
  const SurfaceElement& here = atlas_.elements[element];
  for (const uint32_t other : near_[atlas_.chartOf[element]]) {
    const PlacedChart& placed = atlas_.charts[other];
    const Vec2 at = onGrid(placed, here.position);
    const auto w = static_cast<float>(placed.grid.width - 1), h = static_cast<float>(placed.grid.height - 1);
    const float x = std::clamp(at.x, 0.0f, w), y = std::clamp(at.y, 0.0f, h);
    if (!(std::abs(x - at.x) <= kTouchTexels && std::abs(y - at.y) <= kTouchTexels)) continue;
    const int x0 = std::min(static_cast<int>(x), placed.grid.width - 2),
              y0 = std::min(static_cast<int>(y), placed.grid.height - 2);
    const float fx = x - static_cast<float>(x0), fy = y - static_cast<float>(y0);
    const size_t first = out.size();
    float sum = 0;
    for (const auto& [column, row, weight] : {std::tuple(x0, y0, (1 - fx) * (1 - fy)),
                                              {x0 + 1, y0, fx * (1 - fy)},
                                              {x0, y0 + 1, (1 - fx) * fy},
                                              {x0 + 1, y0 + 1, fx * fy}}) {
      const uint32_t found = elementOf(other, column, row);
      if (weight < 1e-3f || found == kNoElement || !goesOn(here, atlas_.elements[found], kAlikeHere)) continue;
      out.emplace_back(found, weight), sum += weight;
    }
    for (size_t k = first; k < out.size(); ++k) out[k].second /= sum;
  }
  return out;
}

}  // namespace roomlight::bake
