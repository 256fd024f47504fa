#include "measure/measurements.h"

#include <fmt/format.h>

#include <cmath>

namespace roomlight {

std::string threeDigits(double value) {
  if (value == 0 || !std::isfinite(value)) return fmt::format("{}", value);
  const int before = static_cast<int>(std::floor(std::log10(std::abs(value)))) + 1;
  const double unit = std::pow(10.0, before - 3), rounded = std::round(value / unit) * unit;
  // What rounds up to the next power of ten has one digit more before the point.
  const int digits = static_cast<int>(std::floor(std::log10(std::abs(rounded)) + 1e-9)) + 1;
  return fmt::format("{:.{}f}", rounded, std::clamp(3 - digits, 0, 6));
}

std::vector<Verdict> verdictsOf(const Measurements& m) {
  std::vector<Verdict> list;
  const auto judge = [&](const std::string& where, const char* what, const char* unit, const Targets& t, std::optional<double> wanted, double got, bool atMost) {
    if (wanted) list.push_back({where, what, unit, t.source, *wanted, got, atMost});
  };
  for (const GridReading& g : m.grids) {
    if (g.kind != SurfaceKind::WorkPlane && g.kind != SurfaceKind::Rectangle) continue;
    const Statistics s = g.lux();
    if (s.points == 0) continue;
    judge(g.name, "mean illuminance", "lx", g.targets, g.targets.lux, s.mean * m.maintenanceFactor, false);
    judge(g.name, "uniformity U0", "", g.targets, g.targets.uniformity, s.u0(), false);
  }
  for (const PointReading& p : m.points) judge(p.plan.name, "illuminance", "lx", p.plan.targets, p.plan.targets.lux, p.lux * m.maintenanceFactor, false);
  for (const GlareReading& g : m.glares) {
    if (g.ugr) judge(g.plan.name, "glare UGR", "", g.plan.targets, g.plan.targets.ugr, *g.ugr, true);
  }
  for (const RoomReading& r : m.rooms) {
    if (r.wattsKnown() && r.areaM2 > 0) judge(r.room.name, "power density", "W/m²", r.targets, r.targets.wattsPerM2, r.wattsW / r.areaM2, true);
  }
  return list;
}

}  // namespace roomlight
