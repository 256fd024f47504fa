#include <fmt/format.h>

#include <algorithm>

#include "measure/measurements.h"
#include "measure/report.h"

namespace roomlight {
namespace {

using Row = std::vector<std::string>;

// Bytes that begin a character: what a column's width counts.
size_t width(const std::string& s) {
  return static_cast<size_t>(
      std::count_if(s.begin(), s.end(), [](char c) { return (static_cast<unsigned char>(c) & 0xc0) != 0x80; }));
}

// The first column to the left, the others to the right; those from `leftFrom` on to the left again.
std::string aligned(const std::vector<Row>& rows, size_t leftFrom = 99) {
  std::vector<size_t> widths;
  for (const Row& row : rows) {
    widths.resize(std::max(widths.size(), row.size()));
    for (size_t i = 0; i < row.size(); ++i) widths[i] = std::max(widths[i], width(row[i]));
  }
  std::string text;
  for (const Row& row : rows) {
    std::string line;
    for (size_t i = 0; i < row.size(); ++i) {
      const std::string gap(widths[i] - width(row[i]), ' ');
      line += (i ? "  " : "") + (i == 0 || i >= leftFrom ? row[i] + gap : gap + row[i]);
    }
    text += line.substr(0, line.find_last_not_of(' ') + 1) + "\n";
  }
  return text;
}

// Names come from files; line breaks in them must not break the table.
std::string shown(std::string name) {
  std::replace_if(
      name.begin(), name.end(), [](unsigned char c) { return c < 0x20 || c == 0x7f; }, ' ');
  return name;
}

std::string ev(double v) { return std::isfinite(v) ? fmt::format("{:.1f}", v) : "-"; }

// Of several rooms together.
std::string home(const Measurements& m) {
  const std::optional<HomeMeans> means = homeMeans(m);
  if (!means || means->rooms < 2) return {};
  return fmt::format("mean of {} rooms {} lx, of their {:.1f} m² {} lx\n", means->rooms, threeDigits(means->ofRoomsLux),
                     means->areaM2, threeDigits(means->ofAreaLux));
}

// Beside the name of a meter that stands where none belongs.
std::string marked(const std::string& name, MeterPlace place) {
  return place == MeterPlace::Free ? shown(name) : fmt::format("{} ({})", shown(name), placeName(place));
}

std::string grids(const Measurements& m) {
  const bool daylight = std::any_of(m.grids.begin(), m.grids.end(),
                                    [](const GridReading& g) { return !g.points.daylightPercent.empty(); });
  std::vector<Row> rows = {{"grid", "points", "mean lx", "min lx", "max lx", "U0", "U1"}};
  if (daylight) rows[0].insert(rows[0].end(), {"mean DF %", "min DF %"});
  for (const GridReading& g : m.grids) {
    const Statistics s = g.lux();
    rows.push_back({marked(g.name, g.outdoors ? MeterPlace::Outdoors : MeterPlace::Free), fmt::format("{}", s.points),
                    threeDigits(s.mean), threeDigits(s.least), threeDigits(s.most), fmt::format("{:.2f}", s.u0()),
                    fmt::format("{:.2f}", s.u1())});
    const Statistics d = statisticsOf(g.points.daylightPercent);
    if (daylight) rows.back().insert(rows.back().end(), {threeDigits(d.mean), threeDigits(d.least)});
  }
  return aligned(rows) + home(m);
}

std::string points(const Measurements& m) {
  std::vector<Row> rows = {{"point", "x m", "y m", "z m", "lx", "EV100", "DF %"}};
  for (const PointReading& p : m.points) {
    const Vec3 at = p.plan.place.position;
    rows.push_back({marked(p.plan.name, p.place), fmt::format("{:.2f}", at.x), fmt::format("{:.2f}", at.y),
                    fmt::format("{:.2f}", at.z), threeDigits(p.lux), ev(incidentEv100(p.lux)),
                    p.daylightPercent ? threeDigits(*p.daylightPercent) : ""});
  }
  if (std::none_of(m.points.begin(), m.points.end(),
                   [](const PointReading& p) { return p.daylightPercent.has_value(); })) {
    for (Row& row : rows) row.pop_back();
  }
  return aligned(rows);
}

std::string power(const Measurements& m) {
  std::vector<Row> rows = {{"room", "m²", "lamps", "W", "W/m²"}};
  for (const RoomReading& r : m.rooms) {
    const std::string none = r.lamps > 0 ? "not stated" : "-";
    rows.push_back({shown(r.room.name), fmt::format("{:.1f}", r.areaM2), fmt::format("{}", r.lamps),
                    r.wattsKnown() ? threeDigits(r.wattsW) : none,
                    r.wattsKnown() ? threeDigits(r.wattsW / r.areaM2) : none});
  }
  return aligned(rows);
}

std::string targets(const std::vector<Verdict>& verdicts) {
  std::vector<Row> rows = {{"target", "wanted", "found", "", "", ""}};
  for (const Verdict& v : verdicts) {
    const std::string unit = v.unit.empty() ? "" : " " + v.unit;
    rows.push_back({shown(v.where), fmt::format("{} {}{}", v.atMost ? "<=" : ">=", threeDigits(v.wanted), unit),
                    threeDigits(v.got) + unit, v.what, v.met() ? "met" : "MISSED", v.source});
  }
  return aligned(rows, 3);
}

}  // namespace

std::string reportTable(const Measurements& m) {
  std::vector<std::string> parts;
  if (!m.grids.empty()) parts.push_back(grids(m));
  if (!m.points.empty()) parts.push_back(points(m));
  if (!m.spots.empty()) {
    std::vector<Row> rows = {{"spot", "field", "cd/m²", "EV100"}};
    for (const SpotReading& s : m.spots)
      rows.push_back({marked(s.plan.name, s.place), fmt::format("{:g}°", s.plan.angleDeg), threeDigits(s.luminanceCdM2),
                      ev(reflectedEv100(s.luminanceCdM2))});
    parts.push_back(aligned(rows));
  }
  if (!m.glares.empty()) {
    std::vector<Row> rows = {{"eye", "UGR", "background cd/m²", "lamps seen", "at the eye lx"}};
    for (const GlareReading& g : m.glares) {
      rows.push_back({marked(g.plan.name, g.place), g.ugr ? fmt::format("{:.1f}", *g.ugr) : "-",
                      threeDigits(g.backgroundCdM2), fmt::format("{}", g.sources), threeDigits(g.eyeLux)});
    }
    parts.push_back(aligned(rows));
  }
  if (std::any_of(m.rooms.begin(), m.rooms.end(), [](const RoomReading& r) { return r.lamps > 0 || r.wattsW > 0; }))
    parts.push_back(power(m));
  const std::vector<Verdict> verdicts = verdictsOf(m);
  if (!verdicts.empty()) parts.push_back(targets(verdicts));
  if (!verdicts.empty() && m.maintenanceFactor < 1)
    parts.push_back(
        fmt::format("Illuminances of targets are {:g} of the readings (maintenance factor).\n", m.maintenanceFactor));
  std::string text;
  for (const std::string& part : parts) text += (text.empty() ? "" : "\n") + part;
  return text;
}

}  // namespace roomlight
