#include "measure/lattice.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "base/parallel.h"

namespace roomlight {
namespace {

constexpr float kCellM = 0.2f;            // of the search, at least
constexpr int kMostCellsASide = 250;
constexpr float kRounding = 1e-3f;        // of a cell
constexpr float kHeadroomM = 1.9f;        // above a floor
constexpr float kOverDoorsM = 2.2f;       // above a floor
constexpr float kLevelM = 0.05f;          // floors within as much are one level
constexpr double kLeastFloorM2 = 2, kLeastAreaM2 = 1.5;
constexpr float kThingM2 = 4;             // what covers more is a room's shell, not furniture
constexpr float kElbowM = 0.35f;          // free to all sides of where a person stands
constexpr int kMostHits = 64;
constexpr double kMapCells = 48;          // along the longer side

enum Cell : int { kOutside = -1, kInThing = -2, kOpen = -3 };  // or the number of an area, from 0 on

Hit look(const RayScene& rays, Vec3 from, Vec3 direction, float most = kInfinity) {
  return rays.intersect({from, direction, 1e-4f, most});
}

bool seesBack(const Hit& hit, Vec3 direction) { return dot(hit.ng, direction) > 0; }

// Columns of the search over the part of the scene that is under a roof.
struct Search {
  const RayScene& rays;
  Vec3 low;
  float cellM = kCellM;
  int columns = 0, rows = 0;
  float topM = 0;

  size_t count() const { return static_cast<size_t>(columns) * static_cast<size_t>(rows); }
  Vec3 at(size_t i, float y) const {
    const auto column = static_cast<float>(i % static_cast<size_t>(columns)),
               row = static_cast<float>(i / static_cast<size_t>(columns));
    return {low.x + (column + 0.5f) * cellM, y, low.z + (row + 0.5f) * cellM};
  }
};

Search searchOver(const RayScene& rays, const Bounds3& b) {
  Search s{rays, b.lo};
  const float side = std::max(b.size().x, b.size().z);
  s.cellM = std::max(kCellM, side / kMostCellsASide);
  // A scene that was scaled into metres is not a cell longer for that.
  s.columns = std::max(1, static_cast<int>(std::ceil(b.size().x / s.cellM - kRounding)));
  s.rows = std::max(1, static_cast<int>(std::ceil(b.size().z / s.cellM - kRounding)));
  s.topM = b.hi.y + 1;
  return s;
}

// Heights below which a ray from above finds headroom, of one column.
std::vector<float> floorsOf(const Search& s, size_t column) {
  std::vector<float> floors;
  float above = kInfinity, from = s.topM;
  for (int i = 0; i < kMostHits; ++i) {
    const Vec3 start = s.at(column, from);
    const Hit hit = look(s.rays, start, {0, -1, 0});
    if (!hit.valid()) break;
    const float y = start.y - hit.t;
    if (above - y >= kHeadroomM && above < kInfinity) floors.push_back(y);
    above = y, from = y;
  }
  return floors;
}

std::vector<std::vector<float>> allFloors(const Search& s) {
  std::vector<std::vector<float>> floors(s.count());
  parallelFor(s.count(), 64, [&](size_t i) { floors[i] = floorsOf(s, i); });
  return floors;
}

// A garden around a home makes the first search coarse: it is narrowed to what has a floor under a roof.
Search searchIndoors(const RayScene& rays, std::vector<std::vector<float>>& floors) {
  Bounds3 within = rays.bounds();
  for (int round = 0;; ++round) {
    const Search s = searchOver(rays, within);
    floors = allFloors(s);
    Bounds3 covered;
    for (size_t i = 0; i < s.count(); ++i) {
      if (!floors[i].empty()) covered.add(s.at(i, within.lo.y));
    }
    if (covered.empty() || s.cellM <= kCellM || round == 3) return s;
    const Vec3 margin{2 * s.cellM, 0, 2 * s.cellM};
    within.lo = max(within.lo, Vec3{covered.lo.x, within.lo.y, covered.lo.z} - margin);
    within.hi = min(within.hi, Vec3{covered.hi.x, within.hi.y, covered.hi.z} + margin);
  }
}

// The most frequent first; those that are the same storey, less than kHeadroomM apart, once.
std::vector<float> levelsOf(const Search& s, const std::vector<std::vector<float>>& floors) {
  struct Bin {
    int count = 0;
    double sumM = 0;
  };
  std::map<int, Bin> bins;
  for (const auto& column : floors) {
    for (const float y : column) {
      Bin& bin = bins[static_cast<int>(std::floor(y / kLevelM))];
      ++bin.count, bin.sumM += static_cast<double>(y);
    }
  }
  std::vector<Bin> levels;  // two neighbouring bins each, since a floor may lie on the border of two
  for (const auto& [number, bin] : bins) {
    const auto next = bins.find(number + 1);
    levels.push_back(next == bins.end() ? bin : Bin{bin.count + next->second.count, bin.sumM + next->second.sumM});
  }
  std::stable_sort(levels.begin(), levels.end(), [](const Bin& a, const Bin& b) { return a.count > b.count; });
  std::vector<float> chosen;
  const double cellM2 = static_cast<double>(s.cellM) * static_cast<double>(s.cellM);
  for (const Bin& level : levels) {
    if (level.count * cellM2 < std::max(kLeastFloorM2, 0.1 * levels.front().count * cellM2)) break;
    const float y = static_cast<float>(level.sumM / level.count);
    if (std::none_of(chosen.begin(), chosen.end(), [&](float other) { return std::abs(other - y) < kHeadroomM; }))
      chosen.push_back(y);
  }
  return chosen;
}

Cell cellAt(const RayScene& rays, Vec3 p, float levelM) {
  const Hit up = look(rays, p, {0, 1, 0}), down = look(rays, p, {0, -1, 0});
  if (!up.valid() || !down.valid() || p.y - down.t < levelM - 2 * kLevelM) return kOutside;
  return insideThing(rays, p) ? kInThing : kOpen;
}

// One storey: which area each cell belongs to.
class Storey {
 public:
  Storey(const Search& search, float levelM, float planeM)
      : s_(search), levelM_(levelM), planeM_(planeM), cells_(search.count()) {
    parallelFor(s_.count(), 64, [&](size_t i) { cells_[i] = cellAt(s_.rays, s_.at(i, levelM_ + planeM_), levelM_); });
    part(levelM_ + overDoors());
    joinSmall();
  }
  std::vector<double> sizes() const {
    std::vector<double> m2(static_cast<size_t>(areas_));
    for (const int c : cells_) {
      if (c >= 0) m2[static_cast<size_t>(c)] += static_cast<double>(s_.cellM * s_.cellM);
    }
    return m2;
  }
  Bounds3 boundsOf(int area) const {
    Bounds3 b;
    const Vec3 half{s_.cellM / 2, 0, s_.cellM / 2};
    for (size_t i = 0; i < cells_.size(); ++i) {
      const Vec3 p = s_.at(i, levelM_ + planeM_);
      if (cells_[i] == area) b.add(p - half), b.add(p + half);
    }
    return b;
  }
  // Wide enough somewhere to stand in: hollow walls are not.
  bool holdsAPerson(int area) const {
    const int reach = static_cast<int>(std::ceil(kElbowM / s_.cellM));
    for (size_t i = 0; i < cells_.size(); ++i) {
      const int column = static_cast<int>(i % static_cast<size_t>(s_.columns)),
                row = static_cast<int>(i / static_cast<size_t>(s_.columns));
      bool wide = cells_[i] == area;
      for (int k = -reach; wide && k <= reach; ++k) wide = at(column + k, row) == area && at(column, row + k) == area;
      if (wide) return true;
    }
    return false;
  }
  // A point on the plane belongs to the area, and no wall of it is nearer than borderM.
  bool belongs(Vec3 p, int area, float borderM) const {
    const int reach = static_cast<int>(std::ceil(borderM / s_.cellM)), column = columnOf(p), row = rowOf(p);
    if (at(column, row) != area || cellAt(s_.rays, p, levelM_) != kOpen) return false;
    for (int dr = -reach; dr <= reach; ++dr) {
      for (int dc = -reach; dc <= reach; ++dc) {
        const int c = at(column + dc, row + dr);
        const float dx = s_.low.x + (static_cast<float>(column + dc) + 0.5f) * s_.cellM - p.x,
                    dz = s_.low.z + (static_cast<float>(row + dr) + 0.5f) * s_.cellM - p.z;
        if (c != area && c != kInThing && std::hypot(dx, dz) < borderM + s_.cellM / 2) return false;
      }
    }
    return true;
  }

 private:
  int columnOf(Vec3 p) const { return static_cast<int>(std::floor((p.x - s_.low.x) / s_.cellM)); }
  int rowOf(Vec3 p) const { return static_cast<int>(std::floor((p.z - s_.low.z) / s_.cellM)); }
  int at(int column, int row) const {
    const bool in = column >= 0 && row >= 0 && column < s_.columns && row < s_.rows;
    return in ? cells_[static_cast<size_t>(row) * static_cast<size_t>(s_.columns) + static_cast<size_t>(column)]
              : kOutside;
  }
  // Below the ceiling of most cells.
  float overDoors() const {
    std::vector<float> ceilings;
    for (size_t i = 0; i < s_.count(); ++i) {
      if (cells_[i] == kOpen) ceilings.push_back(planeM_ + look(s_.rays, s_.at(i, levelM_ + planeM_), {0, 1, 0}).t);
    }
    if (ceilings.empty()) return kOverDoorsM;
    std::nth_element(ceilings.begin(), ceilings.begin() + static_cast<std::ptrdiff_t>(ceilings.size() / 2),
                     ceilings.end());
    return std::min(kOverDoorsM, ceilings[ceilings.size() / 2] - 0.1f);
  }
  bool linked(size_t a, size_t b, float y) const {
    const Vec3 from = s_.at(a, y), to = s_.at(b, y);
    return !look(s_.rays, from, to - from, 1).valid() && !look(s_.rays, to, from - to, 1).valid();
  }
  template <class Visit>
  void neighbours(size_t i, Visit&& visit) const {
    const size_t column = i % static_cast<size_t>(s_.columns), width = static_cast<size_t>(s_.columns);
    if (column > 0) visit(i - 1);
    if (column + 1 < width) visit(i + 1);
    if (i >= width) visit(i - width);
    if (i + width < cells_.size()) visit(i + width);
  }
  void part(float y) {
    for (size_t start = 0; start < cells_.size(); ++start) {
      if (cells_[start] != kOpen) continue;
      std::vector<size_t> open = {start};
      cells_[start] = areas_;
      while (!open.empty()) {
        const size_t i = open.back();
        open.pop_back();
        neighbours(i, [&](size_t n) {
          if (cells_[n] == kOpen && linked(i, n, y)) cells_[n] = areas_, open.push_back(n);
        });
      }
      ++areas_;
    }
  }
  // What hangs on a wall up there cuts cells off that belong to the room on the work plane.
  void joinSmall() {
    const std::vector<double> m2 = sizes();
    for (bool changed = true; changed;) {
      changed = false;
      for (size_t i = 0; i < cells_.size(); ++i) {
        if (cells_[i] < 0 || m2[static_cast<size_t>(cells_[i])] >= kLeastAreaM2) continue;
        neighbours(i, [&](size_t n) {
          if (changed && cells_[i] >= 0 && m2[static_cast<size_t>(cells_[i])] >= kLeastAreaM2) return;
          if (cells_[n] >= 0 && m2[static_cast<size_t>(cells_[n])] >= kLeastAreaM2 && linked(i, n, levelM_ + planeM_))
            cells_[i] = cells_[n], changed = true;
        });
      }
    }
  }

  const Search& s_;
  const float levelM_, planeM_;
  std::vector<int> cells_;
  int areas_ = 0;
};

MeterGrid latticeOf(const Storey& storey, int area, const Bounds3& b, const GridSettings& settings) {
  const Vec3 size = b.size();
  MeterGrid lattice = rectangleLattice(b.lo, {size.x, 0, 0}, {0, 0, size.z}, {0, 1, 0}, settings);
  const double border =
      std::min(settings.borderM, settings.borderShare * static_cast<double>(std::min(size.x, size.z)));
  parallelFor(lattice.used.size(), 16, [&](size_t i) {
    const int column = static_cast<int>(i) % lattice.columns, row = static_cast<int>(i) / lattice.columns;
    lattice.used[i] = storey.belongs(lattice.centre(column, row), area, static_cast<float>(border));
  });
  return lattice;
}

}  // namespace

bool insideThing(const RayScene& rays, Vec3 p) {
  int others = 0;
  for (const Vec3 d : {Vec3{0, 1, 0}, {1, 0, 0}, {-1, 0, 0}, {0, 0, 1}, {0, 0, -1}, {0, -1, 0}}) {
    const Hit hit = look(rays, p, d);
    bool back = hit.valid() && seesBack(hit, d);
    if (back) {
      const Vec3 size = instanceBounds(rays.scene(), rays.scene().instances[hit.instance]).size();
      back = size.x * size.z <= kThingM2;
    }
    if (!back && ++others > 1) return false;
  }
  return true;
}

size_t leaveOutThings(const RayScene& rays, MeterGrid& lattice) {
  size_t out = 0;
  for (int row = 0; row < lattice.rows; ++row) {
    for (int column = 0; column < lattice.columns; ++column) {
      uint8_t& used = lattice.used[lattice.index(column, row)];
      if (used && insideThing(rays, lattice.centre(column, row))) used = 0, ++out;
    }
  }
  return out;
}

std::vector<Area> findAreas(const RayScene& rays, double workPlaneM, const GridSettings& settings) {
  std::vector<std::vector<float>> floors;
  const Search search = searchIndoors(rays, floors);
  std::vector<Area> areas;
  for (const float level : levelsOf(search, floors)) {
    const Storey storey(search, level, static_cast<float>(workPlaneM));
    const std::vector<double> sizes = storey.sizes();
    for (size_t k = 0; k < sizes.size(); ++k) {
      if (sizes[k] < kLeastAreaM2 || !storey.holdsAPerson(static_cast<int>(k))) continue;
      const Bounds3 b = storey.boundsOf(static_cast<int>(k));
      Area area{"", level, sizes[k], latticeOf(storey, static_cast<int>(k), b, settings), {}};
      const double longer = static_cast<double>(std::max(b.size().x, b.size().z));
      area.map = latticeOf(storey, static_cast<int>(k), b, {std::max(longer / kMapCells, 0.1), 0, 0});
      if (area.points.count() > 0) areas.push_back(std::move(area));
    }
  }
  std::stable_sort(areas.begin(), areas.end(), [](const Area& a, const Area& b) { return a.areaM2 > b.areaM2; });
  for (size_t i = 0; i < areas.size(); ++i) areas[i].name = fmt::format("Area {}", i + 1);
  return areas;
}

}  // namespace roomlight
