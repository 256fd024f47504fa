#include "bake/chart_texels.h"

#include <algorithm>
#include <cmath>

#include "trace/surface_point.h"

namespace roomlight::bake {
namespace {

constexpr float kLongestFootprintM = 0.3f;  // over which a texel's direct light is averaged
constexpr float kTypical = 0.985f;  // cosine between the normal of a place and the mean of its texel's: 10°
constexpr size_t kMostWithBorder = 1000;  // triangles: each texel may look at all of them
constexpr int kTries = 4;
constexpr float kAlike = 0.9962f;   // between normals and that of their chart: 5°

Vec2 nearestOnEdge(Vec2 p, Vec2 a, Vec2 b) {
  const Vec2 e = b - a, d = p - a;
  const float l = e.x * e.x + e.y * e.y;
  const float t = l > 0 ? std::clamp((d.x * e.x + d.y * e.y) / l, 0.0f, 1.0f) : 0;
  return a + e * t;
}

float cross2(Vec2 a, Vec2 b) { return a.x * b.y - a.y * b.x; }
float square(Vec2 v) { return v.x * v.x + v.y * v.y; }

// The place of a triangle on the plane that is nearest to p, as barycentric weights of corners 1 and 2.
struct Nearest {
  float distance2, b1, b2;
};
Nearest nearestIn(const std::array<Vec2, 3>& c, Vec2 p) {
  const float area = cross2(c[1] - c[0], c[2] - c[0]);
  const auto weights = [&](Vec2 q) {
    if (std::abs(area) < 1e-12f) return Vec2{1.0f / 3, 1.0f / 3};
    return Vec2{cross2(q - c[0], c[2] - c[0]) / area, cross2(c[1] - c[0], q - c[0]) / area};
  };
  const Vec2 w = weights(p);
  if (w.x >= 0 && w.y >= 0 && w.x + w.y <= 1) return {0, w.x, w.y};
  Nearest best{kInfinity, 0, 0};
  for (size_t k = 0; k < 3; ++k) {
    const Vec2 q = nearestOnEdge(p, c[k], c[(k + 1) % 3]);
    if (const float d = square(q - p); d < best.distance2) {
      const Vec2 at = weights(q);
      best = {d, std::clamp(at.x, 0.0f, 1.0f), std::clamp(at.y, 0.0f, 1.0f)};
    }
  }
  return best;
}

}  // namespace

ChartSurface::ChartSurface(const Scene& scene, const Chart& chart)
    : back_(chart.back),
      mesh_(&scene.meshes[static_cast<size_t>(scene.instances[chart.instance].mesh)]),
      worldFromObject_(&scene.instances[chart.instance].worldFromObject) {}

std::array<uint32_t, 3> ChartSurface::cornersOf(uint32_t t) const {
  std::array<uint32_t, 3> c{mesh_->indices[3 * t], mesh_->indices[3 * t + 1], mesh_->indices[3 * t + 2]};
  if (back_) std::swap(c[1], c[2]);
  return c;
}

std::array<Vec3, 3> ChartSurface::placesOf(const std::array<uint32_t, 3>& c) const {
  return {worldFromObject_->point(mesh_->positions[c[0]]), worldFromObject_->point(mesh_->positions[c[1]]),
          worldFromObject_->point(mesh_->positions[c[2]])};
}

Vec3 ChartSurface::normalAt(uint32_t triangle, Vec3 geometric, float b1, float b2) const {
  if (back_) std::swap(b1, b2);
  return smoothNormalAt(*mesh_, *worldFromObject_, {triangle, b1, b2}, geometric);
}

Vec3 ChartSurface::geometricNormal(const std::array<Vec3, 3>& p) {
  const Vec3 n = cross(p[1] - p[0], p[2] - p[0]);
  return length(n) > 0 ? normalize(n) : Vec3(0, 1, 0);
}

Vec3 offEdge(Vec3 p, Vec3 middle, OffEdge off) {
  const Vec3 d = middle - p;
  const float l = length(d);
  return l > 0 ? p + d * std::min(off.share, off.distanceM / l) : p;
}

ChartTexels::ChartTexels(const ChartSurface& surface, const Chart& chart, const ChartGrid& grid, int fine,
                         float reachTexels)
    : surface_(surface),
      chart_(chart),
      grid_(grid),
      fine_(fine),
      width_((grid.width + 2 * kGap) * fine),
      height_((grid.height + 2 * kGap) * fine),
      reachTexels_(reachTexels),
      nearest_(static_cast<size_t>(width_) * static_cast<size_t>(height_)) {
  for (const uint32_t t : chart.triangles) cover(t);
  if (chart.triangles.size() > kMostWithBorder) return;
  for (const uint32_t t : chart.triangles) planeOf_.push_back(onPlane(t));
  border_ = ChartBorder(planeOf_);
}

std::array<Vec2, 3> ChartTexels::onPlane(uint32_t triangle) const {
  std::array<Vec2, 3> out;
  const std::array<Vec3, 3> p = surface_.placesOf(surface_.cornersOf(triangle));
  for (size_t k = 0; k < 3; ++k) out[k] = {dot(p[k], chart_.alongU), dot(p[k], chart_.alongV)};
  return out;
}

float ChartTexels::distanceTexels(size_t cell) const {
  return std::sqrt(nearest_[cell].distance2) / static_cast<float>(fine_);
}

Vec2 ChartTexels::onGrid(Vec3 p) const {
  return {(dot(p, chart_.alongU) - chart_.lowM.x) * grid_.perM.x + kGap,
          (dot(p, chart_.alongV) - chart_.lowM.y) * grid_.perM.y + kGap};
}

// Keeps for each cell about a triangle where it is nearest.
void ChartTexels::cover(uint32_t triangle) {
  const std::array<Vec3, 3> p = surface_.placesOf(surface_.cornersOf(triangle));
  std::array<Vec2, 3> c;
  for (size_t k = 0; k < 3; ++k) {
    const Vec2 texels = onGrid(p[k]);
    c[k] = {inCells(texels.x), inCells(texels.y)};
  }
  const float reach = reachTexels_ * static_cast<float>(fine_);
  const auto from = [&](float a, float b, float d) {
    return std::max(0, static_cast<int>(std::ceil(std::min({a, b, d}) - reach)));
  };
  const auto to = [&](float a, float b, float d, int end) {
    return std::min(end - 1, static_cast<int>(std::floor(std::max({a, b, d}) + reach)));
  };
  for (int y = from(c[0].y, c[1].y, c[2].y); y <= to(c[0].y, c[1].y, c[2].y, height_); ++y) {
    for (int x = from(c[0].x, c[1].x, c[2].x); x <= to(c[0].x, c[1].x, c[2].x, width_); ++x) {
      Corner& best = nearest_[static_cast<size_t>(y * width_ + x)];
      const Nearest here = nearestIn(c, {static_cast<float>(x), static_cast<float>(y)});
      if (here.distance2 < best.distance2 && here.distance2 <= reach * reach)
        best = {triangle, here.distance2, here.b1, here.b2};
    }
  }
}

// The place of a cell, off the chart's edges. Where the chart is too narrow for that it moves less far.
ChartTexels::Corner ChartTexels::insetAt(size_t cell, OffEdge off) const {
  const Corner at = nearest_[cell];
  const std::array<Vec2, 3> c = onPlane(at.triangle);
  const Vec2 place = c[0] * (1 - at.b1 - at.b2) + c[1] * at.b1 + c[2] * at.b2;
  float byM = std::min(off.distanceM, off.share * border_.widthM());
  for (int k = 0; k < kTries; ++k, byM /= 2) {
    const Vec2 moved = border_.inset(place, byM);
    if (!(square(moved - place) > 0)) break;
    for (size_t i = 0; i < planeOf_.size(); ++i) {
      const Nearest here = nearestIn(planeOf_[i], moved);
      if (here.distance2 <= 0) return {chart_.triangles[i], 0, here.b1, here.b2};
    }
  }
  return at;
}

SurfaceElement ChartTexels::element(size_t cell, OffEdge off) const {
  const Corner at = border_.empty() ? nearest_[cell] : insetAt(cell, off), &was = nearest_[cell];
  const bool moved = at.triangle != was.triangle || at.b1 != was.b1 || at.b2 != was.b2;
  const std::array<Vec3, 3> p = surface_.placesOf(surface_.cornersOf(at.triangle));
  const Vec3 place = p[0] * (1 - at.b1 - at.b2) + p[1] * at.b1 + p[2] * at.b2;
  const float edgeM = std::min(
      kLongestFootprintM, 1 / (std::sqrt(std::max(grid_.perM.x * grid_.perM.y, 1e-6f)) * static_cast<float>(fine_)));
  return {moved ? place : offEdge(place, (p[0] + p[1] + p[2]) / 3, off),
          surface_.normalAt(at.triangle, ChartSurface::geometricNormal(p), at.b1, at.b2), edgeM};
}

bool normalsAreAlike(const ChartSurface& surface, const Chart& chart) {
  constexpr Vec2 kCorners[] = {{0, 0}, {1, 0}, {0, 1}};
  return std::all_of(chart.triangles.begin(), chart.triangles.end(), [&](uint32_t t) {
    const Vec3 geometric = ChartSurface::geometricNormal(surface.placesOf(surface.cornersOf(t)));
    return std::all_of(std::begin(kCorners), std::end(kCorners),
                       [&](Vec2 b) { return dot(surface.normalAt(t, geometric, b.x, b.y), chart.normal) >= kAlike; });
  });
}

SurfaceElement typicalElement(const ChartTexels& texels, const ChartTexels& cells, size_t texel) {
  const SurfaceElement own = texels.element(texel, {});
  const int x = static_cast<int>(texel) % texels.width(), y = static_cast<int>(texel) / texels.width();
  std::array<SurfaceElement, kCellsATexel * kCellsATexel> found;
  size_t count = 0;
  Vec3 sum;
  for (int k = 0; k < kCellsATexel * kCellsATexel; ++k) {
    const int cx = kCellsATexel * x + k % kCellsATexel, cy = kCellsATexel * y + k / kCellsATexel;
    const auto cell = static_cast<size_t>(cy * cells.width() + cx);
    if (!cells.covers(cell)) continue;
    found[count] = cells.element(cell, {});
    sum += found[count++].normal;
  }
  if (!(length(sum) > 0.1f)) return own;
  const Vec3 mean = normalize(sum);
  if (dot(own.normal, mean) >= kTypical) return own;
  // The nearest of those that are typical; where none is, the one that is most.
  const auto rank = [&](const SurfaceElement& e) {
    const float facing = std::min(dot(e.normal, mean), kTypical);
    return std::pair(-facing, length(e.position - own.position));
  };
  SurfaceElement best = *std::min_element(found.begin(), found.begin() + static_cast<ptrdiff_t>(count),
                                          [&](const auto& a, const auto& b) { return rank(a) < rank(b); });
  best.footprintM = own.footprintM;
  return best;
}

}  // namespace roomlight::bake
