#include "bake/seams.h"

#include <algorithm>
#include <cmath>

namespace roomlight::bake {
namespace {

constexpr float kAlike = 0.9f;          // cosine between normals of two charts where one goes on as the other
constexpr float kAlikeHere = 0.995f;    // where both have the same place
constexpr float kAlikeCharts = 0.6f;    // between those of the charts, which may bend
constexpr float kOffSurfaceM = 0.001f;  // that the other may lie off an arc through both places
constexpr float kNearTexels = 0.75f;  // of the finer chart: from where a texel of the other is looked for to its place
constexpr float kTouchTexels = 0.45f;  // likewise, from a place to a chart that has it, too
constexpr float kOffEdgesM = 2 * OffEdge{}.distanceM;  // that both may be taken from their edges
constexpr float kLeastLiftM = 0.005f, kLift = 0.1f;  // of rays off the surface: of their length
constexpr float kLeastWeight = 0.5f;  // of the texels around a place that are lit

float texelM(const PlacedChart& of) { return 1 / std::min(of.grid.perM.x, of.grid.perM.y); }
float finerM(const PlacedChart& a, const PlacedChart& b) { return std::min(texelM(a), texelM(b)); }

bool overlap(const Bounds3& a, const Bounds3& b) {
  return a.lo.x <= b.hi.x && b.lo.x <= a.hi.x && a.lo.y <= b.hi.y && b.lo.y <= a.hi.y && a.lo.z <= b.hi.z &&
         b.lo.z <= a.hi.z;
}

}  // namespace

Seams::Seams(const Atlas& atlas, std::span<const uint32_t> elementAt, std::span<const uint8_t> buried,
             const RayScene& rays)
    : atlas_(atlas), elementAt_(elementAt), buried_(buried), rays_(rays), touching_(atlas.charts.size()) {
  const std::vector<std::vector<uint32_t>> near = nearCharts();
  for (size_t i = 0; i < atlas.elements.size(); ++i) {
    const uint32_t own = atlas.chartOf[i];
    for (const uint32_t other : near[own]) {
      std::vector<uint32_t>& found = touching_[own];
      if (std::find(found.begin(), found.end(), other) != found.end() || !reaches(other, i)) continue;
      found.push_back(other);
      if (std::find(touching_[other].begin(), touching_[other].end(), own) == touching_[other].end())
        touching_[other].push_back(own);
    }
  }
  for (std::vector<uint32_t>& of : touching_) std::sort(of.begin(), of.end());
}

// Others within a texel that face the same way.
std::vector<std::vector<uint32_t>> Seams::nearCharts() const {
  std::vector<std::vector<uint32_t>> near(atlas_.charts.size());
  std::vector<Bounds3> bounds(near.size());
  for (size_t i = 0; i < atlas_.elements.size(); ++i) bounds[atlas_.chartOf[i]].add(atlas_.elements[i].position);
  std::vector<uint32_t> order;
  for (uint32_t c = 0; c < near.size(); ++c) {
    if (atlas_.charts[c].chart.byVertices || bounds[c].empty()) continue;
    bounds[c].lo = bounds[c].lo - Vec3(texelM(atlas_.charts[c])),
    bounds[c].hi = bounds[c].hi + Vec3(texelM(atlas_.charts[c]));
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
      near[a].push_back(b), near[b].push_back(a);
    }
  }
  return near;
}

// Whether a chart has the place of an element, or ends there.
bool Seams::reaches(uint32_t chart, size_t element) const {
  const PlacedChart& placed = atlas_.charts[chart];
  const Vec2 at = onGrid(placed, atlas_.elements[element].position);
  const float x = std::clamp(at.x, 0.0f, static_cast<float>(placed.grid.width - 1)),
              y = std::clamp(at.y, 0.0f, static_cast<float>(placed.grid.height - 1));
  const float mostM = kTouchTexels * finerM(placed, atlas_.charts[atlas_.chartOf[element]]) + kOffEdgesM;
  if (!(std::abs(x - at.x) <= mostM * placed.grid.perM.x && std::abs(y - at.y) <= mostM * placed.grid.perM.y))
    return false;
  const uint32_t found = elementOf(chart, static_cast<int>(x + 0.5f), static_cast<int>(y + 0.5f));
  return found != kNoElement && length(atlas_.elements[found].position - atlas_.elements[element].position) <=
                                    kNearTexels * texelM(placed) + kOffEdgesM;
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

bool Seams::goesOn(size_t from, size_t to, float alike) const {
  if (buried_[from] || buried_[to]) return false;
  const SurfaceElement &a = atlas_.elements[from], &b = atlas_.elements[to];
  const Vec3 d = b.position - a.position;
  if (dot(a.normal, b.normal) < alike || std::abs(dot(d, a.normal + b.normal)) > 2 * kOffSurfaceM) return false;
  const float lift = std::max(kLeastLiftM, kLift * length(d));
  const Vec3 start = a.position + a.normal * lift, end = b.position + b.normal * lift;
  return luminance(rays_.transmittance({start, end - start, 0, 1})) > 0;
}

uint32_t Seams::beyond(size_t element, Vec2 texels) const {
  const uint32_t own = atlas_.chartOf[element];
  const PlacedChart& placed = atlas_.charts[own];
  const Vec3 p = atlas_.elements[element].position + placed.chart.alongU * (texels.x / placed.grid.perM.x) +
                 placed.chart.alongV * (texels.y / placed.grid.perM.y);
  for (const uint32_t other : touching_[own]) {
    const PlacedChart& there = atlas_.charts[other];
    const Vec2 at = onGrid(there, p);
    if (!(at.x > -1 && at.y > -1 && at.x < static_cast<float>(there.grid.width) &&
          at.y < static_cast<float>(there.grid.height)))
      continue;
    const uint32_t found =
        elementOf(other, static_cast<int>(std::floor(at.x + 0.5f)), static_cast<int>(std::floor(at.y + 0.5f)));
    if (found == kNoElement) continue;
    const float apart = length(atlas_.elements[found].position - p);
    if (apart <= kNearTexels * finerM(placed, there) + kOffEdgesM && goesOn(element, found, kAlike)) return found;
  }
  return kNoElement;
}

std::vector<std::vector<std::pair<uint32_t, float>>> Seams::at(size_t element) const {
  std::vector<std::vector<std::pair<uint32_t, float>>> out;
  for (const uint32_t other : touching_[atlas_.chartOf[element]]) {
    if (!reaches(other, element)) continue;
    const PlacedChart& placed = atlas_.charts[other];
    const Vec2 at = onGrid(placed, atlas_.elements[element].position);
    const float x = std::clamp(at.x, 0.0f, static_cast<float>(placed.grid.width - 1)),
                y = std::clamp(at.y, 0.0f, static_cast<float>(placed.grid.height - 1));
    const int x0 = std::min(static_cast<int>(x), placed.grid.width - 2),
              y0 = std::min(static_cast<int>(y), placed.grid.height - 2);
    const float fx = x - static_cast<float>(x0), fy = y - static_cast<float>(y0);
    std::vector<std::pair<uint32_t, float>> found;
    float sum = 0;
    for (int k = 0; k < 4; ++k) {
      const float weight = (k % 2 ? fx : 1 - fx) * (k / 2 ? fy : 1 - fy);
      const uint32_t j = elementOf(other, x0 + k % 2, y0 + k / 2);
      if (weight < 1e-3f || j == kNoElement || !goesOn(element, j, kAlikeHere)) continue;
      found.emplace_back(j, weight), sum += weight;
    }
    if (sum < kLeastWeight) continue;
    for (auto& [j, weight] : found) weight /= sum;
    out.push_back(std::move(found));
  }
  return out;
}

}  // namespace roomlight::bake
