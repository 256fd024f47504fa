#include <fmt/format.h>

#include <cmath>
#include <string_view>

#include "measure/report.h"

namespace roomlight {
namespace {

// RFC 4180.
std::string quoted(std::string_view text) {
  if (text.find_first_of(",\"\r\n") == std::string_view::npos) return std::string(text);
  std::string out = "\"";
  for (const char c : text) out += c == '"' ? std::string("\"\"") : std::string(1, c);
  return out + "\"";
}

// The meter that a line is of.
struct LineMeter {
  const char* kind;  // "grid", "point", "spot" or "glare"
  std::string_view name, room;
  Vec3 positionM, direction;  // direction: the normal of what light falls on, or where the meter looks
  MeterPlace place;
};

// What it shows.
struct LineValue {
  const char *quantity, *unit;
  std::optional<double> value;  // empty: not measured there
};

std::string line(const LineMeter& m, const LineValue& v) {
  const Vec3 p = m.positionM, n = m.direction;
  return fmt::format("{},{},{},{:.4f},{:.4f},{:.4f},{:.4f},{:.4f},{:.4f},{},{},{},{}\r\n", m.kind, quoted(m.name),
                     quoted(m.room), p.x, p.y, p.z, n.x, n.y, n.z, v.quantity, v.unit,
                     v.value ? fmt::format("{:.6g}", *v.value) : "", placeName(m.place));
}

std::string gridLines(const GridReading& g) {
  std::string text;
  const MeterGrid& l = g.points.lattice;
  const auto meterAt = [&](int column, int row, MeterPlace place) {
    return LineMeter{"grid", g.name, g.room, l.centre(column, row), l.normal, place};
  };
  for (int row = 0; row < l.rows; ++row) {
    for (int column = 0; column < l.columns; ++column) {
      const size_t i = l.index(column, row);
      if (!l.used[i]) continue;
      const LineMeter meter = meterAt(column, row, g.outdoors ? MeterPlace::Outdoors : MeterPlace::Free);
      if (i < g.points.lux.size()) text += line(meter, {"illuminance", "lx", static_cast<double>(g.points.lux[i])});
      if (i < g.points.daylightPercent.size())
        text += line(meter, {"daylight factor", "%", static_cast<double>(g.points.daylightPercent[i])});
    }
  }
  for (const LeftOutCell& c : g.leftOut) {
    const int column = static_cast<int>(c.cell) % l.columns, row = static_cast<int>(c.cell) / l.columns;
    text += line(meterAt(column, row, c.place), {"illuminance", "lx", std::nullopt});
  }
  return text;
}

}  // namespace

std::string reportCsv(const Measurements& m) {
  std::string text = "kind,name,room,x,y,z,nx,ny,nz,quantity,unit,value,place\r\n";
  for (const GridReading& g : m.grids) text += gridLines(g);
  for (const PointReading& p : m.points) {
    const LineMeter meter{"point", p.plan.name, "", p.plan.place.position, p.plan.place.normal, p.place};
    text += line(meter, {"illuminance", "lx", p.lux});
    if (p.daylightPercent) text += line(meter, {"daylight factor", "%", *p.daylightPercent});
  }
  for (const SpotReading& s : m.spots)
    text += line({"spot", s.plan.name, "", s.plan.position, s.plan.direction, s.place},
                 {"luminance", "cd/m2", s.luminanceCdM2});
  for (const GlareReading& g : m.glares) {
    if (g.ugr)
      text += line({"glare", g.plan.name, "", g.plan.position, g.plan.direction, g.place}, {"UGR", "", *g.ugr});
  }
  return text;
}

}  // namespace roomlight
