#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "base/html.h"
#include "measure/exposure.h"
#include "measure/light_map.h"
#include "measure/report.h"

namespace roomlight {
namespace {

constexpr const char* kStyle = R"(
main{max-width:980px}
p.about{color:var(--soft);margin:0 0 8px}
table{width:100%}
.summary{display:flex;gap:36px;flex-wrap:wrap;margin:22px 0 6px}
.summary div b{color:var(--ink);display:block;font-size:26px;font-weight:600;line-height:1.2}
.summary div{color:var(--soft);font-size:13px}
.figure{display:flex;gap:26px;align-items:flex-start;margin:12px 0 6px}
.map{flex:none}
.legend .tick{stroke:var(--ink)}
.notes{color:var(--soft);font-size:13px;padding-left:18px}
@media print{section{break-inside:avoid}}
)";

std::string fileName(const std::string& path) { return htmlEscaped(std::filesystem::path(path).filename().string()); }

std::string cell(const std::string& text, const char* kind = "") { return fmt::format("<td{}{}{}>{}</td>", *kind ? " class=\"" : "", kind, *kind ? "\"" : "", text); }

std::string head(std::initializer_list<const char*> names, size_t leftFrom = 99) {
  std::string row = "<tr>";
  size_t i = 0;
  for (const char* name : names) row += fmt::format("<th{}>{}</th>", i++ >= leftFrom ? " class=\"l\"" : "", name);
  return row + "</tr>\n";
}

std::string summary(const Measurements& m, const std::vector<Verdict>& verdicts) {
  double area = 0;
  for (const RoomReading& r : m.rooms) area += r.areaM2;
  std::string s = "<div class=\"summary\">";
  const auto item = [&](const std::string& number, const char* words) { s += fmt::format("<div><b>{}</b>{}</div>", number, words); };
  if (!m.rooms.empty()) item(fmt::format("{}", m.rooms.size()), m.rooms.size() == 1 ? "room" : "rooms");
  if (area > 0) item(fmt::format("{:.0f} m²", area), "floor area");
  double sum = 0, weight = 0;
  for (const GridReading& g : m.grids) {
    const Statistics l = g.lux();
    if (g.kind == SurfaceKind::WorkPlane) sum += l.mean * static_cast<double>(l.points), weight += static_cast<double>(l.points);
  }
  if (weight > 0) item(threeDigits(sum / weight) + " lx", "mean of all points on work planes");
  if (!verdicts.empty()) {
    const auto met = std::count_if(verdicts.begin(), verdicts.end(), [](const Verdict& v) { return v.met(); });
    item(fmt::format("{} of {}", met, verdicts.size()), "targets met");
  }
  return s + "</div>\n";
}

std::string targets(const std::vector<Verdict>& verdicts) {
  if (verdicts.empty()) return {};
  std::string s = "<section><h2>Targets</h2>\n<table>" + head({"where", "what", "wanted", "found", "", "source"}, 4);
  for (const Verdict& v : verdicts) {
    const std::string unit = v.unit.empty() ? "" : " " + v.unit;
    s += "<tr>" + cell(htmlEscaped(v.where)) + cell(v.what) + cell(fmt::format("{} {}{}", v.atMost ? "≤" : "≥", threeDigits(v.wanted), unit)) + cell(threeDigits(v.got) + unit) +
         cell(v.met() ? "✓ met" : "✗ missed", v.met() ? "l met" : "l missed") + cell(htmlEscaped(v.source), "l") + "</tr>\n";
  }
  return s + "</table></section>\n";
}

std::string overview(const Measurements& m) {
  if (m.grids.empty()) return {};
  const bool daylight = std::any_of(m.grids.begin(), m.grids.end(), [](const GridReading& g) { return !g.points.daylightPercent.empty(); });
  std::string s = "<section><h2>Illuminance</h2>\n<table>" + (daylight ? head({"surface", "points", "mean lx", "min lx", "max lx", "U0", "U1", "mean DF %", "min DF %"}) : head({"surface", "points", "mean lx", "min lx", "max lx", "U0", "U1"}));
  for (const GridReading& g : m.grids) {
    const Statistics l = g.lux(), d = statisticsOf(g.points.daylightPercent);
    s += "<tr>" + cell(htmlEscaped(g.name)) + cell(fmt::format("{}", l.points)) + cell(threeDigits(l.mean)) + cell(threeDigits(l.least)) + cell(threeDigits(l.most)) + cell(fmt::format("{:.2f}", l.u0())) + cell(fmt::format("{:.2f}", l.u1()));
    if (daylight) s += cell(threeDigits(d.mean)) + cell(threeDigits(d.least));
    s += "</tr>\n";
  }
  return s + "</table></section>\n";
}

std::string meters(const Measurements& m) {
  std::string s;
  const auto ev = [](double v) { return std::isfinite(v) ? fmt::format("{:.1f}", v) : std::string("–"); };
  const auto where = [](Vec3 p) { return fmt::format("{:.2f}, {:.2f}, {:.2f}", p.x, p.y, p.z); };
  if (!m.points.empty()) {
    s += "<section><h2>Incident meters</h2>\n<table>" + head({"point", "x, y, z in m", "lx", "EV100", "DF %"});
    for (const PointReading& p : m.points) {
      s += "<tr>" + cell(htmlEscaped(p.plan.name)) + cell(where(p.plan.place.position)) + cell(threeDigits(p.lux)) + cell(ev(incidentEv100(p.lux))) + cell(p.daylightPercent ? threeDigits(*p.daylightPercent) : "–") + "</tr>\n";
    }
    s += "</table></section>\n";
  }
  if (!m.spots.empty()) {
    s += "<section><h2>Spot meters</h2>\n<table>" + head({"spot", "from x, y, z in m", "field", "cd/m²", "EV100"});
    for (const SpotReading& p : m.spots) {
      s += "<tr>" + cell(htmlEscaped(p.plan.name)) + cell(where(p.plan.position)) + cell(fmt::format("{:g}°", p.plan.angleDeg)) + cell(threeDigits(p.luminanceCdM2)) + cell(ev(reflectedEv100(p.luminanceCdM2))) + "</tr>\n";
    }
    s += "</table></section>\n";
  }
  if (!m.glares.empty()) {
    s += "<section><h2>Glare</h2>\n<table>" + head({"eye", "x, y, z in m", "UGR", "background cd/m²", "luminaires seen", "at the eye lx"});
    for (const GlareReading& g : m.glares) {
      s += "<tr>" + cell(htmlEscaped(g.plan.name)) + cell(where(g.plan.position)) + cell(g.ugr ? fmt::format("{:.1f}", *g.ugr) : "–") + cell(threeDigits(g.backgroundCdM2)) + cell(fmt::format("{}", g.sources)) + cell(threeDigits(g.eyeLux)) + "</tr>\n";
    }
    s += "</table></section>\n";
  }
  return s;
}

std::string power(const Measurements& m) {
  if (std::none_of(m.rooms.begin(), m.rooms.end(), [](const RoomReading& r) { return r.lamps > 0 || r.wattsW > 0; })) return {};
  std::string s = "<section><h2>Installed power</h2>\n<table>" + head({"room", "m²", "lamps", "W", "W/m²"});
  for (const RoomReading& r : m.rooms) {
    const std::string none = r.lamps > 0 ? "not stated" : "–";
    s += "<tr>" + cell(htmlEscaped(r.room.name)) + cell(fmt::format("{:.1f}", r.areaM2)) + cell(fmt::format("{}", r.lamps)) + cell(r.wattsKnown() ? threeDigits(r.wattsW) : none) + cell(r.wattsKnown() ? threeDigits(r.wattsW / r.areaM2) : none) + "</tr>\n";
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
    s += fmt::format("<section><h2>{}</h2>\n<p class=\"about\">mean {} lx, lowest {} lx, highest {} lx, U0 {:.2f}; {} points, {:.2f} × {:.2f} m apart{}</p>\n", htmlEscaped(g.name), threeDigits(l.mean),
                     threeDigits(l.least), threeDigits(l.most), l.u0(), l.points, g.points.lattice.stepUM, g.points.lattice.stepVM, g.leftOut ? fmt::format("; {} in furniture left out", g.leftOut) : "");
    s += "<div class=\"figure\">" + lightMapSvg(g, scene, scale, number++) + legendSvg(scale, "lx") + "</div></section>\n";
  }
  return s;
}

std::string notes(const ReportHeader& h, const Measurements& m) {
  std::string s = "<section><h2>How this was found</h2>\n<ul class=\"notes\">";
  const auto note = [&](const std::string& text) { s += "<li>" + text + "</li>\n"; };
  note(fmt::format("Technique {}, quality {}; every reading is taken to a relative standard error of {:g} %.", htmlEscaped(h.technique), htmlEscaped(h.quality), 100 * h.tolerance));
  note("Points lie as EN 12464-1 lays them: p = 0.2 · 5<sup>log d</sup> apart, without a band along the walls of 0.5 m or 15 % of the shorter side. U0 is the lowest over the mean, U1 the lowest over the highest reading.");
  note(m.maintenanceFactor < 1 ? fmt::format("Readings are those of new lamps; targets are judged at {:g} of them (maintenance factor).", m.maintenanceFactor) : "Readings are those of new lamps in clean rooms; no maintenance factor is applied.");
  note("On the maps, dots are the points of the statistics, crossed circles are lamps; white lines join places of equal illuminance, in lux. Surfaces are drawn where they are cut at the height of the plane.");
  if (!m.glares.empty()) note("UGR after CIE 117; lamps of less than 0.005 m², and lamps without a size, after CIE 147.");
  for (const std::string& w : m.warnings) note(htmlEscaped(w));
  return s + "</ul></section>\n";
}

}  // namespace

std::string reportHtml(const ReportHeader& h, const Measurements& m, const Scene& scene) {
  const std::vector<Verdict> verdicts = verdictsOf(m);
  std::string s = fmt::format("<h1>Lighting report</h1>\n<p class=\"about\">{}{}{}</p>\n", fileName(h.scene), h.lighting.empty() ? "" : ", lit by " + fileName(h.lighting), h.meters.empty() ? "" : ", measured after " + fileName(h.meters));
  s += summary(m, verdicts) + targets(verdicts) + overview(m) + figures(m, scene) + meters(m) + power(m) + notes(h, m);
  s += fmt::format("<footer>roomlight {}</footer>\n", htmlEscaped(h.version));
  return htmlPage("Lighting report: " + std::filesystem::path(h.scene).filename().string(), kLightMapStyle + std::string(kStyle), s);
}

}  // namespace roomlight
