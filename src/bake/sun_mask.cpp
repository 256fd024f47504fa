#include "bake/sun_mask.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <functional>
#include <mutex>

#include "base/parallel.h"
#include "base/sampler.h"
#include "base/sampling.h"

namespace roomlight::bake {
namespace {

constexpr float kReachTexels = 1.35f;  // beyond a chart: all cells of texels that have elements
constexpr OffEdge kOffEdge{0.0003f, 0.15f};
constexpr size_t kRays = 32;         // of a cell at the edge of a patch
constexpr int kNear = 2;          // cells, each way, that must be alike
constexpr float kAlike = 1.5f / 255;
constexpr float kMovedTimes = 2;  // by which rays start further off what was simplified
constexpr int kGreyBytes = 2;     // by which channels may differ
constexpr float kDiscFrom = 1e-6f;  // rad: suns smaller than that are points

// One chart's cells.
struct Cells {
  int width, height;
  std::vector<uint8_t> onChart;
  std::vector<Vec3> left;
  template <class Visit>
  void forEachNear(size_t i, int reach, const Visit& visit) const {
    const int x = static_cast<int>(i) % width, y = static_cast<int>(i) / width;
    for (int ny = std::max(0, y - reach); ny <= std::min(height - 1, y + reach); ++ny) {
      for (int nx = std::max(0, x - reach); nx <= std::min(width - 1, x + reach); ++nx) {
        const auto n = static_cast<size_t>(ny * width + nx);
        if (n != i && onChart[n]) visit(n);
      }
    }
  }
};

bool alike(Vec3 a, Vec3 b) { return maxComponent(abs(a - b)) <= kAlike; }
bool isWhole(Vec3 left) { return alike(left, Vec3(0)) || alike(left, Vec3(1)); }

class SunRays {
 public:
  SunRays(const RayScene& home, const Sun& sun) : home_(home), sun_(sun), disc_(sun.toLight) {}

  bool faces(Vec3 normal) const { return dot(normal, sun_.toLight) > 0; }
  Vec3 fromMiddle(const SurfaceElement& e, float offM) const {
    return home_.transmittance({offsetOrigin(e.position, e.normal) + e.normal * offM, sun_.toLight});
  }
  // A mean over a square, `u` and `v` wide, and the disc. Where something is in the way to a place, the middle stands
  // for it.
  Vec3 mean(const SurfaceElement& e, float offM, Vec3 u, Vec3 v, uint64_t key) const {
    const Vec3 middle = offsetOrigin(e.position, e.normal) + e.normal * offM;
    std::array<Ray, kRays> ways, rays;
    std::array<Vec3, kRays> open, left;
    const float oneMinusCos = sun_.halfAngleRad > kDiscFrom ? 1 - std::cos(sun_.halfAngleRad) : 0;
    for (size_t k = 0; k < kRays; ++k) {
      Sampler sampler(key, static_cast<uint32_t>(k), 0);
      const Vec2 at = sampler.next2();
      const Vec3 way = u * (at.x - 0.5f) + v * (at.y - 0.5f);
      ways[k] = {middle, way, 0, 1};
      rays[k] = {middle + way, disc_.toWorld(sampleCone(sampler.next2(), oneMinusCos))};
    }
    home_.transmittance(ways, open);
    for (size_t k = 0; k < kRays; ++k) {
      if (isBlack(open[k])) rays[k].origin = middle;
    }
    home_.transmittance(rays, left);
    Vec3 sum;
    for (const Vec3 l : left) sum += l;
    return sum / kRays;
  }

 private:
  const RayScene& home_;
  const Sun& sun_;
  const Frame disc_;
};

// Where neighbours differ, and around what proves to be neither lit nor dark.
void refine(Cells& cells, const std::vector<uint8_t>& facing, const std::function<Vec3(size_t)>& mean) {
  std::vector<uint8_t> known(cells.left.size(), 0);
  std::vector<size_t> due;
  const auto want = [&](size_t i) {
    if (!known[i] && facing[i]) known[i] = 1, due.push_back(i);
  };
  for (size_t i = 0; i < cells.left.size(); ++i) {
    if (!cells.onChart[i]) continue;
    bool edge = !isWhole(cells.left[i]);
    cells.forEachNear(i, kNear, [&](size_t n) { edge |= facing[n] && !alike(cells.left[i], cells.left[n]); });
    if (edge) want(i);
  }
  const std::vector<Vec3> before = cells.left;
  for (size_t k = 0; k < due.size(); ++k) {
    const size_t i = due[k];
    cells.left[i] = mean(i);
    if (!isWhole(cells.left[i]) && !alike(cells.left[i], before[i])) cells.forEachNear(i, kNear, want);
  }
}

// Cells that are not open take what the nearest open one has, step by step.
void fillBuried(Cells& cells, std::vector<uint8_t>& buried) {
  for (bool changed = true; changed;) {
    changed = false;
    const std::vector<uint8_t> before = buried;
    for (size_t i = 0; i < buried.size(); ++i) {
      if (!before[i]) continue;
      Vec3 sum;
      int count = 0;
      cells.forEachNear(i, 1, [&](size_t n) {
        if (!before[n]) sum += cells.left[n], ++count;
      });
      if (count > 0) cells.left[i] = sum / static_cast<float>(count), buried[i] = 0, changed = true;
    }
  }
}

std::array<uint8_t, 3> bytesOf(Vec3 left) {
  const auto byte = [](float f) { return static_cast<uint8_t>(std::lround(std::clamp(f, 0.0f, 1.0f) * 255)); };
  return {byte(left.x), byte(left.y), byte(left.z)};
}

ChartTexels cellsOf(const ChartSurface& surface, const PlacedChart& placed) {
  return {surface, placed.chart, placed.grid, kFineCells, kReachTexels};
}

// Of a chart's cell in the atlas.
size_t inAtlas(const Atlas& atlas, const PlacedChart& placed, int width, size_t cell) {
  const auto row = static_cast<size_t>(atlas.width * kFineCells), w = static_cast<size_t>(width);
  return (static_cast<size_t>(placed.top * kFineCells) + cell / w) * row +
         static_cast<size_t>(placed.left * kFineCells) + cell % w;
}

// The upper left one of a texel of the atlas.
size_t firstCellOf(const Atlas& atlas, uint32_t texel) {
  const auto w = static_cast<size_t>(atlas.width);
  return (texel / w * kFineCells * w + texel % w) * kFineCells;
}

size_t texelOf(size_t cell, int width) {
  const auto w = static_cast<size_t>(width);
  return cell / w / kFineCells * (w / kFineCells) + cell % w / kFineCells;
}

// Texels of a chart that hold a buried element, 2, or are beside one, 1.
std::vector<uint8_t> nearBuried(const Atlas& atlas, const PlacedChart& placed, std::span<const uint32_t> elementOfTexel,
                                const std::vector<uint8_t>& buried) {
  const int w = placed.grid.width + 2 * kGap, h = placed.grid.height + 2 * kGap;
  std::vector<uint8_t> out(static_cast<size_t>(w * h));
  for (int y = 0; y < h; ++y) {
    for (int x = 0; x < w; ++x) {
      const uint32_t e = elementOfTexel[static_cast<size_t>((placed.top + y) * atlas.width + placed.left + x)];
      if (e == kNoElement || !buried[e]) continue;
      for (int ny = std::max(0, y - 1); ny <= std::min(h - 1, y + 1); ++ny) {
        for (int nx = std::max(0, x - 1); nx <= std::min(w - 1, x + 1); ++nx) {
          uint8_t& near = out[static_cast<size_t>(ny * w + nx)];
          near = std::max<uint8_t>(near, nx == x && ny == y ? 2 : 1);
        }
      }
    }
  }
  return out;
}

// One mask, chart by chart.
class MaskMaker {
 public:
  MaskMaker(const SunCells& cells, const RayScene& home, const Sun& sun, SunMask& mask)
      : of_(cells),
        atlas_(cells.atlas),
        rays_(home, sun),
        row_(static_cast<size_t>(atlas_.width) * kFineCells),
        mask_(mask) {
    mask_.left.resize(row_ * static_cast<size_t>(atlas_.height) * kFineCells);
  }

  void addTexels(const PlacedChart& placed) {
    const ChartSurface surface(of_.scene, placed.chart);
    const ChartTexels on = cellsOf(surface, placed);
    const float off = offOf(placed);
    const auto cellInAtlas = [&](size_t i) { return inAtlas(atlas_, placed, on.width(), i); };
    Cells cells{on.width(), on.height(), std::vector<uint8_t>(on.count()), std::vector<Vec3>(on.count())};
    std::vector<uint8_t> facing(on.count()), buried(on.count());
    bool any = false;
    for (size_t i = 0; i < on.count(); ++i) {
      if (!on.onTriangle(i)) continue;
      const SurfaceElement e = on.element(i, kOffEdge);
      cells.onChart[i] = 1, facing[i] = rays_.faces(e.normal), buried[i] = of_.buried[cellInAtlas(i)];
      if (facing[i]) cells.left[i] = rays_.fromMiddle(e, off), any = true;
    }
    if (!any) return;
    const Vec3 u = placed.chart.alongU / (placed.grid.perM.x * kFineCells),
               v = placed.chart.alongV / (placed.grid.perM.y * kFineCells);
    refine(cells, facing, [&](size_t i) {
      const SurfaceElement e = on.element(i, kOffEdge);
      const auto inPlane = [&](Vec3 way) { return way - e.normal * dot(way, e.normal); };
      // A part of the square may be buried where a neighbour is.
      bool atFoot = false;
      cells.forEachNear(i, 1, [&](size_t n) { atFoot |= buried[n] != 0; });
      return rays_.mean(e, off, atFoot ? Vec3() : inPlane(u), atFoot ? Vec3() : inPlane(v), cellInAtlas(i));
    });
    fillBuried(cells, buried);
    for (size_t i = 0; i < on.count(); ++i) {
      if (cells.onChart[i]) mask_.left[cellInAtlas(i)] = bytesOf(cells.left[i]);
    }
  }

  // An element of a chart by vertices: all cells of its texel.
  void addVertex(size_t i) {
    SurfaceElement e = atlas_.elements[i];
    if (!rays_.faces(e.normal)) return;
    if (of_.lit.buried[i]) e.position = of_.lit.places[of_.lit.ofElement[i].place[0]].position;
    const std::array<uint8_t, 3> left = bytesOf(rays_.mean(e, offOf(atlas_.charts[atlas_.chartOf[i]]), {}, {}, i));
    const size_t first = firstCellOf(atlas_, atlas_.texels[i]);
    for (size_t dy = 0; dy < kFineCells; ++dy)
      std::fill_n(mask_.left.begin() + static_cast<ptrdiff_t>(first + dy * row_), kFineCells, left);
  }

 private:
  float offOf(const PlacedChart& placed) const {
    return kMovedTimes * of_.movedM[static_cast<size_t>(of_.scene.instances[placed.chart.instance].mesh)];
  }

  const SunCells& of_;
  const Atlas& atlas_;
  const SunRays rays_;
  const size_t row_;  // cells
  SunMask& mask_;
};

}  // namespace

std::vector<bool> buriedCells(const RayScene& rays, const Atlas& atlas, const LitPlaces& lit, const SeenSides& seen) {
  const std::vector<uint32_t> elementOfTexel = elementsByTexel(atlas);
  std::vector<bool> out(elementOfTexel.size() * kFineCells * kFineCells);
  std::mutex adding;
  parallelFor(atlas.charts.size(), 1, [&](size_t c) {
    const PlacedChart& placed = atlas.charts[c];
    if (placed.chart.byVertices) return;
    const std::vector<uint8_t> near = nearBuried(atlas, placed, elementOfTexel, lit.buried);
    if (std::all_of(near.begin(), near.end(), [](uint8_t n) { return n == 0; })) return;
    const ChartSurface surface(rays.scene(), placed.chart);
    const ChartTexels cells = cellsOf(surface, placed);
    std::vector<size_t> found;
    for (size_t i = 0; i < cells.count(); ++i) {
      const uint8_t beside = near[texelOf(i, cells.width())];
      if (beside == 0 || !cells.onTriangle(i)) continue;
      const size_t cell = inAtlas(atlas, placed, cells.width(), i);
      if (beside == 2 || isBuried(cells.element(i, kOffEdge), cell, rays, seen)) found.push_back(cell);
    }
    const std::lock_guard lock(adding);
    for (const size_t cell : found) out[cell] = true;
  });
  return out;
}

SunMask sunMaskOf(const SunCells& cells, const RayScene& home, const Sun& sun, const Progress& progress) {
  const Atlas& atlas = cells.atlas;
  SunMask mask;
  MaskMaker maker(cells, home, sun, mask);
  std::atomic<size_t> done = 0;
  std::mutex reporting;
  parallelFor(atlas.charts.size(), 1, [&](size_t c) {
    if (!atlas.charts[c].chart.byVertices && !progress.stop()) maker.addTexels(atlas.charts[c]);
    if (const size_t d = ++done; reporting.try_lock()) {
      progress.at(static_cast<float>(d) / static_cast<float>(atlas.charts.size()));
      reporting.unlock();
    }
  });
  parallelFor(atlas.elements.size(), 256, [&](size_t i) {
    if (atlas.charts[atlas.chartOf[i]].chart.byVertices && !progress.stop()) maker.addVertex(i);
  });
  if (progress.stop()) return {};
  mask.coloured = std::any_of(mask.left.begin(), mask.left.end(), [](const auto& l) {
    return std::max({l[0], l[1], l[2]}) - std::min({l[0], l[1], l[2]}) > kGreyBytes;
  });
  return mask;
}

std::vector<Vec3> sunlightOn(const Atlas& atlas, const SunMask& mask, const Sun& sun) {
  std::vector<Vec3> lux(atlas.elements.size());
  const size_t row = static_cast<size_t>(atlas.width) * kFineCells;
  if (!mask.any()) return lux;
  parallelFor(lux.size(), 4096, [&](size_t i) {
    const float cosine = dot(atlas.elements[i].normal, sun.toLight);
    if (cosine <= 0) return;
    const size_t first = firstCellOf(atlas, atlas.texels[i]);
    Vec3 left;
    for (size_t dy = 0; dy < kFineCells; ++dy) {
      for (size_t dx = 0; dx < kFineCells; ++dx) {
        const std::array<uint8_t, 3>& l = mask.left[first + dy * row + dx];
        left += Vec3(l[0], l[1], l[2]) / 255.0f;
      }
    }
    lux[i] = sun.illuminanceLux * left * (cosine / (kFineCells * kFineCells));
  });
  return lux;
}

}  // namespace roomlight::bake
