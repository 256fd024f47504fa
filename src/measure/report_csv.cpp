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

std::string line(const char* kind, const std::string& name, const std::string& room, Vec3 p, Vec3 n,
                 const char* quantity, const char* unit, std::optional<double> value, MeterPlace place) {
  return fmt::format("{},{},{},{:.4f},{:.4f},{:.4f},{:.4f},{:.4f},{:.4f},{},{},{},{}\r\n", kind, quoted(name),
                     quoted(room), p.x, p.y, p.z, n.x, n.y, n.z, quantity, unit,
                     value ? fmt::format("{:.6g}", *value) : "", placeName(place));
}

std::string gridLines(const GridReading& g) {
  std::string text;
  const Lattice& l = g.points.lattice;
  for (int row = 0; row < l.rows; ++row) {
    for (int column = 0; column < l.columns; ++column) {
      const size_t i = l.index(column, row);
      if (!l.used[i]) continue;
      const MeterPlace place = g.outdoors ? MeterPlace::Outdoors : MeterPlace::Free;
      if (i < g.points.lux.size())
        text += line("grid", g.name, g.room, l.centre(column, row), l.normal, "illuminance", "lx",
                     static_cast<double>(g.points.lux[i]), place);
      if (i < g.points.daylightPercent.size())
        text += line("grid", g.name, g.room, l.centre(column, row), l.normal, "daylight factor", "%",
                     static_cast<double>(g.points.daylightPercent[i]), place);
    }
  }
  for (const LeftOutCell& c : g.leftOut) {
    const int column = static_cast<int>(c.cell) % l.columns, row = static_cast<int>(c.cell) / l.columns;
    text += line("grid", g.name, g.room, l.centre(column, row), l.normal, "illuminance", "lx", std::nullopt, c.place);
  }
  return text;
}

}  // namespace

std::string reportCsv(const Measurements& m) {
  std::string text = "kind,name,room,x,y,z,nx,ny,nz,quantity,unit,value,place\r\n";
  for (const GridReading& g : m.grids) text += gridLines(g);
  for (const PointReading& p : m.points) {
    text +=
        line("point", p.plan.name, "", p.plan.place.position, p.plan.place.normal, "illuminance", "lx", p.lux, p.place);
    if (p.daylightPercent)
      text += line("point", p.plan.name, "", p.plan.place.position, p.plan.place.normal, "daylight factor", "%",
                   *p.daylightPercent, p.place);
  }
  for (const SpotReading& s : m.spots)
    text += line("spot", s.plan.name, "", s.plan.position, s.plan.direction, "luminance", "cd/m2", s.luminanceCdM2,
                 s.place);
  for (const GlareReading& g : m.glares) {
    if (g.ugr) text += line("glare", g.plan.name, "", g.plan.position, g.plan.direction, "UGR", "", *g.ugr, g.place);
  }
  return text;
}

}  // namespace roomlight
