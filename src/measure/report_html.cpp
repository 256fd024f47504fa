#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "base/html.h"
#include "measure/drawings.h"
#include "measure/measurements.h"
#include "measure/report.h"
#include "measure/report_sections.h"

namespace roomlight {
namespace {

using report::cell, report::head, report::verdictCell;

constexpr const char* kStyle = R"(
main{max-width:980px}
header{display:flex;justify-content:space-between;gap:40px;align-items:flex-end;border-bottom:3px solid var(--ink);padding-bottom:16px}
header h1{margin:0}
p.project{font-size:19px;color:var(--soft);margin:2px 0 0}
dl{display:grid;grid-template-columns:auto auto;gap:1px 14px;margin:0;font-size:12.5px}
dt{color:var(--soft)}dd{margin:0;overflow-wrap:anywhere}
p.about{color:var(--soft);margin:0 0 8px;font-size:13.5px}
table{width:100%}
.sum td{border-top:1px solid var(--ink);border-bottom:none;font-weight:600}
.summary{display:flex;gap:36px;flex-wrap:wrap;margin:22px 0 18px}
.summary div b{color:var(--ink);display:block;font-size:26px;font-weight:600;line-height:1.2}
.summary div{color:var(--soft);font-size:13px}
.shot{margin:0}
.shot img{display:block;width:100%;height:auto}
figcaption{color:var(--soft);font-size:12.5px;margin-top:4px}
.figure{display:flex;gap:26px;align-items:flex-start;margin:12px 0 6px}
.map{flex:none;max-width:calc(100% - 104px);height:auto}
.legend .tick{stroke:var(--ink)}
.notes{color:var(--soft);font-size:13px;padding-left:18px}
@page{size:A4;margin:15mm 14mm}
@media print{
body{font-size:12.5px;-webkit-print-color-adjust:exact;print-color-adjust:exact}
h2{font-size:17px;margin-top:22px;padding-top:10px;break-after:avoid}
table{font-size:11.5px}th{font-size:10.5px}td{padding:3px 7px}
tr,figure,.figure,.plan,.map{break-inside:avoid}thead{display:table-header-group}
.legend{transform:scale(.85);transform-origin:top left}
p.about{break-after:avoid}
}
)";

std::string summary(const Measurements& m, const std::vector<Verdict>& verdicts) {
  double area = 0;
  for (const RoomReading& r : m.rooms) area += r.areaM2;
  std::string s = "<div class=\"summary\">";
  const auto item = [&](const std::string& number, const char* words) {
    s += fmt::format("<div><b>{}</b>{}</div>", number, words);
  };
  if (!m.rooms.empty()) item(fmt::format("{}", m.rooms.size()), m.rooms.size() == 1 ? "room" : "rooms");
  if (area > 0) item(fmt::format("{:.0f} m²", area), "floor area");
  if (const std::optional<HomeMeans> means = homeMeans(m)) {
    item(threeDigits(means->ofAreaLux) + " lx",
         means->rooms == 1 ? "mean on the work plane" : "mean on work planes, by area");
    if (means->rooms > 1) item(threeDigits(means->ofRoomsLux) + " lx", "mean of rooms, each alike");
  }
  if (!m.luminaires.empty())
    item(fmt::format("{}", m.luminaires.size()), m.luminaires.size() == 1 ? "luminaire" : "luminaires");
  if (!verdicts.empty()) {
    const auto met = std::count_if(verdicts.begin(), verdicts.end(), [](const Verdict& v) { return v.met(); });
    item(fmt::format("{} of {}", met, verdicts.size()), "stated targets met");
  }
  return s + "</div>\n";
}

std::string targets(const std::vector<Verdict>& verdicts) {
  if (verdicts.empty()) return {};
  std::string s =
      "<section><h2>Stated targets</h2>\n<table>" + head({"where", "what", "wanted", "found", "", "source"}, 4);
  for (const Verdict& v : verdicts) {
    const std::string unit = v.unit.empty() ? "" : " " + v.unit;
    s += "<tr>" + cell(htmlEscaped(v.where)) + cell(v.what) +
         cell(fmt::format("{} {}{}", v.atMost ? "≤" : "≥", threeDigits(v.wanted), unit)) +
         cell(threeDigits(v.got) + unit) + verdictCell(v.met()) + cell(htmlEscaped(v.source), "l") + "</tr>\n";
  }
  return s + "</table></section>\n";
}

// A name as HTML, with the place beside it where no meter belongs.
std::string marked(const std::string& name, MeterPlace place) {
  return place == MeterPlace::Free
             ? htmlEscaped(name)
             : fmt::format("{} <span class=\"soft\">({})</span>", htmlEscaped(name), placeName(place));
}

std::string overview(const Measurements& m) {
  if (m.grids.empty()) return {};
  const bool daylight = std::any_of(m.grids.begin(), m.grids.end(),
                                    [](const GridReading& g) { return !g.points.daylightPercent.empty(); });
  std::string s =
      "<section><h2>Illuminance</h2>\n<table>" +
      (daylight ? head({"surface", "points", "mean lx", "min lx", "max lx", "U0", "U1", "mean DF %", "min DF %"})
                : head({"surface", "points", "mean lx", "min lx", "max lx", "U0", "U1"}));
  for (const GridReading& g : m.grids) {
    const Statistics l = g.lux(), d = statisticsOf(g.points.daylightPercent);
    s += "<tr>" + cell(marked(g.name, g.outdoors ? MeterPlace::Outdoors : MeterPlace::Free)) +
         cell(g.leftOut.empty()
                  ? fmt::format("{}", l.points)
                  : fmt::format("{} <span class=\"soft\">of {}</span>", l.points, l.points + g.leftOut.size())) +
         cell(threeDigits(l.mean)) + cell(threeDigits(l.least)) + cell(threeDigits(l.most)) +
         cell(fmt::format("{:.2f}", l.u0())) + cell(fmt::format("{:.2f}", l.u1()));
    if (daylight) s += cell(threeDigits(d.mean)) + cell(threeDigits(d.least));
    s += "</tr>\n";
  }
  s += "</table>\n";
  for (const std::string& line : misplaced(m)) s += "<p class=\"about\">" + htmlEscaped(line) + "</p>\n";
  return s + "</section>\n";
}

std::string meters(const Measurements& m) {
  std::string s;
  const auto ev = [](double v) { return std::isfinite(v) ? fmt::format("{:.1f}", v) : std::string("–"); };
  const auto where = [](Vec3 p) { return fmt::format("{:.2f}, {:.2f}, {:.2f}", p.x, p.y, p.z); };
  if (!m.points.empty()) {
    s += "<section><h2>Incident meters</h2>\n<table>" + head({"point", "x, y, z in m", "lx", "EV100", "DF %"});
    for (const PointReading& p : m.points) {
      s += "<tr>" + cell(marked(p.plan.name, p.place)) + cell(where(p.plan.place.position)) + cell(threeDigits(p.lux)) +
           cell(ev(incidentEv100(p.lux))) + cell(p.daylightPercent ? threeDigits(*p.daylightPercent) : "–") + "</tr>\n";
    }
    s += "</table></section>\n";
  }
  if (!m.spots.empty()) {
    s += "<section><h2>Spot meters</h2>\n<table>" + head({"spot", "from x, y, z in m", "field", "cd/m²", "EV100"});
    for (const SpotReading& p : m.spots) {
      s += "<tr>" + cell(marked(p.plan.name, p.place)) + cell(where(p.plan.position)) +
           cell(fmt::format("{:g}°", p.plan.angleDeg)) + cell(threeDigits(p.luminanceCdM2)) +
           cell(ev(reflectedEv100(p.luminanceCdM2))) + "</tr>\n";
    }
    s += "</table></section>\n";
  }
  if (!m.glares.empty()) {
    s += "<section><h2>Glare</h2>\n<table>" +
         head({"eye", "x, y, z in m", "UGR", "background cd/m²", "luminaires seen", "at the eye lx"});
    for (const GlareReading& g : m.glares) {
      s += "<tr>" + cell(marked(g.plan.name, g.place)) + cell(where(g.plan.position)) +
           cell(g.ugr ? fmt::format("{:.1f}", *g.ugr) : "–") + cell(threeDigits(g.backgroundCdM2)) +
           cell(fmt::format("{}", g.sources)) + cell(threeDigits(g.eyeLux)) + "</tr>\n";
    }
    s += "</table></section>\n";
  }
  return s;
}

std::string power(const Measurements& m) {
  if (std::none_of(m.rooms.begin(), m.rooms.end(), [](const RoomReading& r) { return r.lamps > 0 || r.wattsW > 0; }))
    return {};
  std::string s = "<section><h2>Installed power</h2>\n<table>" + head({"room", "m²", "lamps", "W", "W/m²"});
  for (const RoomReading& r : m.rooms) {
    const std::string none = r.lamps > 0 ? "not stated" : "–";
    s += "<tr>" + cell(htmlEscaped(r.room.name)) + cell(fmt::format("{:.1f}", r.areaM2)) +
         cell(fmt::format("{}", r.lamps)) + cell(r.wattsKnown() ? threeDigits(r.wattsW) : none) +
         cell(r.wattsKnown() ? threeDigits(r.wattsW / r.areaM2) : none) + "</tr>\n";
  }
  return s + "</table></section>\n";
}

std::string figures(const Measurements& m, const Scene& scene) {
  std::vector<float> all;
  for (const GridReading& g : m.grids) {
    const std::vector<float>& lux = g.map ? g.map->lux : g.points.lux;
    all.insert(all.end(), lux.begin(), lux.end());
  }
  const LightScale scale = scaleOf(all);
  std::string s;
  int number = 0;
  for (const GridReading& g : m.grids) {
    if (g.lux().points == 0) continue;
    const Statistics l = g.lux();
    s += fmt::format(
        "<section><h2>{}</h2>\n<p class=\"about\">mean {} lx, lowest {} lx, highest {} lx, U0 {:.2f}; {} points, "
        "{:.2f} × {:.2f} m apart{}</p>\n",
        htmlEscaped(g.name), threeDigits(l.mean), threeDigits(l.least), threeDigits(l.most), l.u0(), l.points,
        g.points.lattice.stepUM, g.points.lattice.stepVM,
        g.leftOut.empty() ? "" : fmt::format("; {} left out (crosses)", g.leftOut.size()));
    s += "<div class=\"figure\">" + lightMapSvg(g, scene, scale, number++) + legendSvg(scale, "lx") +
         "</div></section>\n";
  }
  return s;
}

std::string notes(const Measurements& m) {
  std::string s = "<section><h2>How this was found</h2>\n<ul class=\"notes\">";
  const auto note = [&](const std::string& text) { s += "<li>" + text + "</li>\n"; };
  note(
      "Points lie as EN 12464-1 lays them: p = 0.2 · 5<sup>log d</sup> apart, without a band along the walls of 0.5 m "
      "or 15 % of the shorter side. U0 is the lowest over the mean, U1 the lowest over the highest reading.");
  note(m.maintenanceFactor < 1
           ? fmt::format("Readings are those of new lamps; targets are judged at {:g} of them (maintenance factor).",
                         m.maintenanceFactor)
           : "Readings are those of new lamps in clean rooms; no maintenance factor is applied.");
  note(
      "On the maps, dots are the points of the statistics, crossed circles are lamps; white lines join places of equal "
      "illuminance, in lux. Surfaces are drawn where they are cut at the height of the plane.");
  if (!m.glares.empty())
    note("UGR after CIE 117; lamps of less than 0.005 m², and lamps without a size, after CIE 147.");
  const std::vector<std::string> told = m.grids.empty() ? std::vector<std::string>() : misplaced(m);  // below the table
  for (const std::string& w : m.warnings) {
    if (std::find(told.begin(), told.end(), w) == told.end()) note(htmlEscaped(w));
  }
  return s + "</ul></section>\n";
}

}  // namespace

std::string reportHtml(const ReportHeader& h, const Measurements& m, const Scene& scene) {
  const std::vector<Verdict> verdicts = verdictsOf(m);
  const Schedule schedule = scheduleOf(m.luminaires);
  std::string s = report::titleBlock(h) + summary(m, verdicts) + report::picture(h) +
                  report::plans(m, scene, schedule) + report::roomTargetTable(m);
  s += targets(verdicts) + overview(m) + figures(m, scene) + meters(m) + report::luminaireSchedule(schedule) +
       power(m) + report::worth(h, m) + notes(m);
  s += fmt::format("<footer>roomlight {}{}{}</footer>\n", htmlEscaped(h.version), h.date.empty() ? "" : ", ",
                   htmlEscaped(h.date));
  return htmlPage("Lighting report: " + std::filesystem::path(h.scene).filename().string(),
                  kLightMapStyle + std::string(kOverviewPlanStyle) + kStyle, s);
}

}  // namespace roomlight
