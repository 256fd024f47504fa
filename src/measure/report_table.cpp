#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "measure/report.h"
#include "measure/report_tables.h"
#include "report/page.h"

namespace roomlight {
namespace {

using report::fixed, report::kNoColumn, report::Table;

// A name, with the place beside it where no meter belongs.
std::string nameOn(Medium medium, std::string name, MeterPlace place = MeterPlace::Free) {
  if (medium == Medium::Page)
    name = report::escaped(name);
  else  // line breaks in names must not break the table
    std::replace_if(
        name.begin(), name.end(), [](unsigned char c) { return c < 0x20 || c == 0x7f; }, ' ');
  if (place == MeterPlace::Free) return name;
  const std::string beside = fmt::format("({})", placeName(place));
  return name + " " + (medium == Medium::Page ? "<span class=\"soft\">" + beside + "</span>" : beside);
}

const char* noneOn(Medium medium) { return medium == Medium::Page ? "–" : "-"; }

std::string evOn(Medium medium, double ev) { return std::isfinite(ev) ? fixed(ev, 1) : noneOn(medium); }

// A column of a page alone, which has more room.
const char* onPage(Medium medium, const char* head) { return medium == Medium::Page ? head : kNoColumn; }

std::string where(Vec3 p) { return fmt::format("{:.2f}, {:.2f}, {:.2f}", p.x, p.y, p.z); }

}  // namespace

Table gridTable(const Measurements& m, Medium medium) {
  const bool daylight = std::any_of(m.grids.begin(), m.grids.end(),
                                    [](const GridReading& g) { return !g.points.daylightPercent.empty(); });
  Table table({medium == Medium::Page ? "surface" : "grid", "points", "mean lx", "min lx", "max lx", "U0", "U1",
               daylight ? "mean DF %" : kNoColumn, daylight ? "min DF %" : kNoColumn});
  for (const GridReading& g : m.grids) {
    const Statistics l = g.lux(), d = statisticsOf(g.points.daylightPercent);
    std::string points = std::to_string(l.points);
    if (medium == Medium::Page && !g.leftOut.empty())
      points += fmt::format(" <span class=\"soft\">of {}</span>", l.points + g.leftOut.size());
    table.row({nameOn(medium, g.name, g.outdoors ? MeterPlace::Outdoors : MeterPlace::Free), points,
               threeDigits(l.mean), threeDigits(l.least), threeDigits(l.most), fixed(l.u0(), 2), fixed(l.u1(), 2),
               threeDigits(d.mean), threeDigits(d.least)});
  }
  return table;
}

Table pointTable(const Measurements& m, Medium medium) {
  const bool isPage = medium == Medium::Page;
  const bool daylight = std::any_of(m.points.begin(), m.points.end(),
                                    [](const PointReading& p) { return p.daylightPercent.has_value(); });
  Table table({"point", onPage(medium, "x, y, z in m"), isPage ? kNoColumn : "x m", isPage ? kNoColumn : "y m",
               isPage ? kNoColumn : "z m", "lx", "EV100", isPage || daylight ? "DF %" : kNoColumn});
  for (const PointReading& p : m.points) {
    const Vec3 at = p.plan.place.position;
    table.row({nameOn(medium, p.plan.name, p.place), where(at), fixed(at.x, 2), fixed(at.y, 2), fixed(at.z, 2),
               threeDigits(p.lux), evOn(medium, incidentEv100(p.lux)),
               p.daylightPercent ? threeDigits(*p.daylightPercent)
               : isPage          ? "–"
                                 : ""});
  }
  return table;
}

Table spotTable(const Measurements& m, Medium medium) {
  Table table({"spot", onPage(medium, "from x, y, z in m"), "field", "cd/m²", "EV100"});
  for (const SpotReading& s : m.spots)
    table.row({nameOn(medium, s.plan.name, s.place), where(s.plan.position), fmt::format("{:g}°", s.plan.angleDeg),
               threeDigits(s.luminanceCdM2), evOn(medium, reflectedEv100(s.luminanceCdM2))});
  return table;
}

Table glareTable(const Measurements& m, Medium medium) {
  Table table({"eye", onPage(medium, "x, y, z in m"), "UGR", "background cd/m²",
               medium == Medium::Page ? "luminaires seen" : "lamps seen", "at the eye lx"});
  for (const GlareReading& g : m.glares)
    table.row({nameOn(medium, g.plan.name, g.place), where(g.plan.position), g.ugr ? fixed(*g.ugr, 1) : noneOn(medium),
               threeDigits(g.backgroundCdM2), g.sources, threeDigits(g.eyeLux)});
  return table;
}

Table powerTable(const Measurements& m, Medium medium) {
  Table table({"room", "m²", "lamps", "W", "W/m²"});
  if (std::none_of(m.rooms.begin(), m.rooms.end(), [](const RoomReading& r) { return r.lamps > 0 || r.wattsW > 0; }))
    return table;
  for (const RoomReading& r : m.rooms) {
    const std::string none = r.lamps > 0 ? "not stated" : noneOn(medium);
    table.row({nameOn(medium, r.room.name), fixed(r.areaM2, 1), r.lamps, r.wattsKnown() ? threeDigits(r.wattsW) : none,
               r.wattsKnown() ? threeDigits(r.wattsW / r.areaM2) : none});
  }
  return table;
}

Table targetTable(const std::vector<Verdict>& verdicts, Medium medium) {
  const bool isPage = medium == Medium::Page;
  Table table({isPage ? "where" : "target", onPage(medium, "what"), "wanted", "found", isPage ? kNoColumn : "<", "<",
               isPage ? "<source" : "<"});
  for (const Verdict& v : verdicts) {
    const std::string unit = v.unit.empty() ? "" : " " + v.unit;
    const char* sign = v.atMost ? (isPage ? "≤" : "<=") : isPage ? "≥" : ">=";
    table.row({nameOn(medium, v.where), v.what, fmt::format("{} {}{}", sign, threeDigits(v.wanted), unit),
               threeDigits(v.got) + unit, v.what,
               isPage    ? report::verdict(v.met())
               : v.met() ? "met"
                         : "MISSED",
               nameOn(medium, v.source)});
  }
  return table;
}

std::string reportTable(const Measurements& m) {
  constexpr auto kHere = Medium::Terminal;
  std::string text;
  const auto add = [&](const report::Table& table, const std::string& below = {}) {
    if (!table.isEmpty()) text += (text.empty() ? "" : "\n") + table.text() + below;
  };
  const std::optional<HomeMeans> means = homeMeans(m);
  add(gridTable(m, kHere),
      !means || means->rooms < 2
          ? ""
          : fmt::format("mean of {} rooms {} lx, of their {:.1f} m² {} lx\n", means->rooms,
                        threeDigits(means->ofRoomsLux), means->areaM2, threeDigits(means->ofAreaLux)));
  add(pointTable(m, kHere));
  add(spotTable(m, kHere));
  add(glareTable(m, kHere));
  add(powerTable(m, kHere));
  add(targetTable(verdictsOf(m), kHere),
      m.maintenanceFactor < 1
          ? fmt::format("\nIlluminances of targets are {:g} of the readings (maintenance factor).\n",
                        m.maintenanceFactor)
          : "");
  return text;
}

}  // namespace roomlight
