#include "measure/lattice.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "scene/outline.h"

namespace roomlight {
namespace {

constexpr double kMostCellsASide = 2000;
constexpr float kShortestWallM = 0.3f, kBeforeWallM = 0.01f;

// The nearest whole number of cells for the first side; cells as long as those, as near as whole numbers allow, on the
// other.
void divide(MeterGrid& lattice, double sideU, double sideV, double spacingM) {
  const double p = spacingM > 0 ? spacingM : gridSpacingM(sideU, sideV);
  const auto cells = [&](double side) {
    return std::clamp(spacingM > 0 ? std::ceil(side / p - 1e-6) : std::round(side / p), 1.0, kMostCellsASide);
  };
  lattice.columns = static_cast<int>(cells(sideU));
  lattice.rows = static_cast<int>(cells(sideV));
  lattice.stepUM = static_cast<float>(sideU / lattice.columns);
  lattice.stepVM = static_cast<float>(sideV / lattice.rows);
  lattice.used.assign(static_cast<size_t>(lattice.columns) * static_cast<size_t>(lattice.rows), 1);
}

double borderOf(const GridSettings& s, double sideU, double sideV) {
  return std::min(s.borderM, s.borderShare * std::min(sideU, sideV));
}

}  // namespace

size_t MeterGrid::count() const { return static_cast<size_t>(std::count(used.begin(), used.end(), 1)); }

std::vector<SurfaceElement> MeterGrid::elements() const {
  std::vector<SurfaceElement> list;
  for (int row = 0; row < rows; ++row) {
    for (int column = 0; column < columns; ++column) {
      if (used[index(column, row)]) list.push_back({centre(column, row), normal});
    }
  }
  return list;
}

std::vector<float> MeterGrid::spread(std::span<const float> ofUsed) const {
  std::vector<float> all(used.size(), std::numeric_limits<float>::quiet_NaN());
  size_t next = 0;
  for (size_t i = 0; i < used.size(); ++i) {
    if (used[i]) all[i] = ofUsed[next++];
  }
  return all;
}

double gridSpacingM(double sideM, double otherSideM) {
  const double longer = std::max(sideM, otherSideM), shorter = std::min(sideM, otherSideM);
  const double d = std::max(1e-3, longer >= 2 * shorter ? shorter : longer);
  return std::min(10.0, 0.2 * std::pow(5.0, std::log10(d)));
}

MeterGrid rectangleLattice(Vec3 corner, Vec3 alongU, Vec3 alongV, Vec3 normal, const GridSettings& settings) {
  const double sideU = static_cast<double>(length(alongU)), sideV = static_cast<double>(length(alongV)),
               border = borderOf(settings, sideU, sideV);
  MeterGrid lattice;
  lattice.u = normalize(alongU), lattice.v = normalize(alongV), lattice.normal = normal;
  lattice.corner = corner + (lattice.u + lattice.v) * static_cast<float>(border);
  divide(lattice, sideU - 2 * border, sideV - 2 * border, settings.spacingM);
  return lattice;
}

MeterGrid floorLattice(std::span<const Vec2> floor, float yM, const GridSettings& settings) {
  Vec2 u = longestSide(floor);
  // Of the four ways to lay a rectangle along it, the one most like the world's axes.
  if (std::abs(u.x) < std::abs(u.y)) u = {-u.y, u.x};
  if (u.x < 0) u = u * -1;
  const Vec2 v{-u.y, u.x};
  Vec2 low{kInfinity, kInfinity}, high{-kInfinity, -kInfinity};
  for (const Vec2 p : floor) {
    const float a = p.x * u.x + p.y * u.y, b = p.x * v.x + p.y * v.y;
    low = {std::min(low.x, a), std::min(low.y, b)}, high = {std::max(high.x, a), std::max(high.y, b)};
  }
  const Vec2 size = high - low, corner = u * low.x + v * low.y;
  MeterGrid lattice = rectangleLattice({corner.x, yM, corner.y}, Vec3{u.x, 0, u.y} * size.x, Vec3{v.x, 0, v.y} * size.y,
                                       {0, 1, 0}, settings);
  const double border = borderOf(settings, static_cast<double>(size.x), static_cast<double>(size.y));
  for (int row = 0; row < lattice.rows; ++row) {
    for (int column = 0; column < lattice.columns; ++column) {
      const Vec3 p = lattice.centre(column, row);
      lattice.used[lattice.index(column, row)] =
          contains(floor, {p.x, p.z}) && distanceToEdgeM(floor, {p.x, p.z}) >= border;
    }
  }
  return lattice;
}

std::vector<MeterGrid> wallLattices(std::span<const Vec2> floor, float elevationM, float heightM,
                                    const GridSettings& settings) {
  std::vector<MeterGrid> walls;
  const float turn = signedAreaM2(floor) > 0 ? 1.0f : -1.0f;
  for (size_t i = 0; i < floor.size(); ++i) {
    const Vec2 a = floor[i], side = floor[(i + 1) % floor.size()] - a;
    const float l = std::hypot(side.x, side.y);
    if (l < kShortestWallM) continue;
    const Vec3 inwards = Vec3{side.y, 0, -side.x} * (turn / l);
    walls.push_back(rectangleLattice(Vec3{a.x, elevationM, a.y} + inwards * kBeforeWallM, {side.x, 0, side.y},
                                     {0, heightM, 0}, inwards, settings));
  }
  return walls;
}

Statistics statisticsOf(std::span<const float> values) {
  Statistics s;
  for (const float f : values) {
    const double x = static_cast<double>(f);
    if (std::isnan(x)) continue;
    s.least = s.points ? std::min(s.least, x) : x;
    s.most = s.points ? std::max(s.most, x) : x;
    s.mean += x;
    ++s.points;
  }
  if (s.points) s.mean /= static_cast<double>(s.points);
  return s;
}

}  // namespace roomlight
