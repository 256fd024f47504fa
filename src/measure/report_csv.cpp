#include <fmt/format.h>

#include <cmath>

#include "measure/report.h"

namespace roomlight {
namespace {

// RFC 4180.
std::string quoted(const std::string& text) {
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  std::string out = "\"";
  for (const char c : text) out += c == '"' ? std::string("\"\"") : std::string(1, c);
  return out + "\"";
}

std::string line(const char* kind, const std::string& name, const std::string& room, Vec3 p, Vec3 n, const char* quantity, const char* unit, double value) {
  return fmt::format("{},{},{},{:.4f},{:.4f},{:.4f},{:.4f},{:.4f},{:.4f},{},{},{:.6g}\r\n", kind, quoted(name), quoted(room), p.x, p.y, p.z, n.x, n.y, n.z, quantity, unit, value);
}

std::string gridLines(const GridReading& g) {
  std::string text;
  const Lattice& l = g.points.lattice;
  for (int row = 0; row < l.rows; ++row) {
    for (int column = 0; column < l.columns; ++column) {
      const size_t i = l.index(column, row);
      if (!l.used[i]) continue;
      if (i < g.points.lux.size()) text += line("grid", g.name, g.room, l.centre(column, row), l.normal, "illuminance", "lx", static_cast<double>(g.points.lux[i]));
      if (i < g.points.daylightPercent.size()) text += line("grid", g.name, g.room, l.centre(column, row), l.normal, "daylight factor", "%", static_cast<double>(g.points.daylightPercent[i]));
    }
  }
  return text;
}

}  // namespace

std::string reportCsv(const Measurements& m) {
  std::string text = "kind,name,room,x,y,z,nx,ny,nz,quantity,unit,value\r\n";
  for (const GridReading& g : m.grids) text += gridLines(g);
  for (const PointReading& p : m.points) {
    text += line("point", p.plan.name, "", p.plan.place.position, p.plan.place.normal, "illuminance", "lx", p.lux);
    if (p.daylightPercent) text += line("point", p.plan.name, "", p.plan.place.position, p.plan.place.normal, "daylight factor", "%", *p.daylightPercent);
  }
  for (const SpotReading& s : m.spots) text += line("spot", s.plan.name, "", s.plan.position, s.plan.direction, "luminance", "cd/m2", s.luminanceCdM2);
  for (const GlareReading& g : m.glares) {
    if (g.ugr) text += line("glare", g.plan.name, "", g.plan.position, g.plan.direction, "UGR", "", *g.ugr);
  }
  return text;
}

}  // namespace roomlight
