#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "engine/settings.h"
#include "engine/technique.h"
#include "measure/drawings.h"
#include "measure/report.h"
#include "measure/report_tables.h"
#include "report/page.h"

namespace roomlight {
namespace {

using report::escaped, report::Table;
constexpr auto kHere = Medium::Page;

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

std::string fileName(const std::string& path) { return escaped(std::filesystem::path(path).filename().string()); }

std::string orDash(const std::string& text) { return text.empty() ? "–" : text; }

// How the use of a room is known.
const char* originWords(const std::string& origin) {
  if (origin == "stated") return "stated";
  if (origin == "target") return "target stated";
  return origin == "name" ? "by its name" : "assumed";
}

std::string accuracyWords(const std::string& technique) {
  const Technique* known = findTechnique(technique);
  if (!known || known->meters.places == 0)
    return fmt::format(
        "Technique {} is a method of others, kept for comparison: figures to be held to are taken with <b>{}</b> or "
        "<b>{}</b>.",
        escaped(technique), technique::kHybrid, technique::kPath);
  return fmt::format(
      "Measured error: at {} places where the light is known (closed forms, the set-ups of CIE 171:2006) technique {} "
      "was off by at most {:.1f} %.",
      known->meters.places, known->name, known->meters.worstPercent);
}

// All texts are HTML; `kind`: the section's class.
std::string section(const std::string& title, const std::string& content, const std::string& kind = {}) {
  return "<section" + report::attribute("class", kind) + "><h2>" + title + "</h2>\n" + content + "</section>\n";
}

// What is said beside a table.
std::string about(const std::string& text) { return "<p class=\"about\">" + text + "</p>\n"; }

std::string list(const std::string& title, const std::vector<std::string>& lines) {
  std::string s = "<ul class=\"notes\">";
  for (const std::string& line : lines) s += "<li>" + line + "</li>\n";
  return section(title, s + "</ul>");
}

std::string titleBlock(const ReportHeader& h) {
  std::string s = fmt::format("<header><div><h1>Lighting report</h1>\n<p class=\"project\">{}</p></div>\n<dl>",
                              escaped(std::filesystem::path(h.scene).stem().string()));
  const auto row = [&](const char* name, const std::string& value) {
    if (!value.empty()) s += fmt::format("<dt>{}</dt><dd>{}</dd>", name, value);
  };
  row("Date", escaped(h.date));
  row("Home", fileName(h.scene));
  row("Lighting", !h.lighting.empty()    ? fileName(h.lighting)
                  : h.addedLight.empty() ? std::string("of the home itself")
                                         : std::string("assumed, since the file has little or none: " + h.addedLight));
  row("Meters", h.meters.empty() ? "every room's work plane" : fileName(h.meters));
  row("Computed by", fmt::format("roomlight {}, {}, {}", escaped(h.version), escaped(h.technique), escaped(h.quality)));
  return s + "</dl></header>\n";
}

std::string picture(const ReportHeader& h) {
  if (h.pictureJpeg.empty()) return {};
  return report::figure(report::jpegPicture("the home", h.pictureJpeg), escaped(h.pictureOf), "shot") + "\n";
}

std::string plans(const Measurements& m, const Scene& scene, const Schedule& schedule) {
  const std::vector<OverviewPlan> storeys = overviewPlans(m, scene, schedule);
  if (storeys.empty()) return {};
  std::string s = about(
      "Mean illuminance on work planes; ✓ and ✗: beside the target of each room's use, below. Numbers are those of the "
      "luminaire schedule.");
  for (const OverviewPlan& p : storeys) {
    if (storeys.size() > 1) s += fmt::format("<h3>Floor at {:.2f} m</h3>\n", static_cast<double>(p.elevationM) + 0.0);
    s += p.svg;
  }
  return section("Plan", s, "whole");
}

std::string roomTargetTable(const Measurements& m) {
  const std::vector<RoomTarget> list = roomTargets(m);
  if (list.empty()) return {};
  Table table({"room", "<use", "<use known", "target", "found", "<", "<source"});
  bool assumed = false;
  for (const RoomTarget& t : list) {
    assumed = assumed || t.origin == "assumed";
    table.row({escaped(t.room), orDash(escaped(t.use)),
               report::Cell(originWords(t.origin), t.origin == "assumed" ? "soft" : ""),
               fmt::format("≥ {} lx", threeDigits(t.wantedLux)),
               t.foundLux ? threeDigits(*t.foundLux) + " lx" : "not measured",
               t.foundLux ? report::verdict(t.met()) : "", escaped(t.source)});
  }
  std::string s = table.html() + "\n";
  if (m.maintenanceFactor < 1)
    s += about(fmt::format("Found: {:g} of the readings (maintenance factor).", m.maintenanceFactor));
  if (assumed)
    s += about(
        fmt::format("Assumed: neither the home nor the meter file says what these rooms are for; they are judged as {} "
                    "rooms. State the use in the meter file.",
                    kAssumedUse));
  return section("Targets by room", s);
}

std::string luminaireSchedule(const Schedule& schedule) {
  if (schedule.rows.empty()) return {};
  Table table({"no.", "<luminaire", "<room", "<kind", "count", "lm each", "W each", "lm/W", "K"});
  size_t number = 0, count = 0;
  double flux = 0, watts = 0;
  bool allStated = true;
  for (const Luminaire& l : schedule.rows) {
    const auto n = static_cast<double>(l.count);
    count += l.count, flux += n * l.fluxLm, watts += n * l.wattsW, allStated = allStated && l.wattsW > 0;
    table.row({++number, orDash(escaped(l.name)), orDash(escaped(l.room)), l.kind, l.count, threeDigits(l.fluxLm),
               l.wattsW > 0 ? threeDigits(l.wattsW) : "–",
               l.wattsW > 0 ? fmt::format("{:.0f}", l.fluxLm / l.wattsW) : "–",
               l.kelvin ? fmt::format("{:.0f}", std::round(*l.kelvin / 50) * 50) : "–"});
  }
  table.row({"", "together", "", "", count, threeDigits(flux) + " lm",
             allStated ? threeDigits(watts) + " W" : "not all stated",
             allStated ? fmt::format("{:.0f}", flux / watts) : "", ""},
            "sum");
  return section(
      "Luminaire schedule",
      table.html() + "\n" +
          about("lm: as it shines here, dimmed and with its light loss factor. K: nearest temperature of its "
                "light; –: plain white or coloured. W: as stated by the lighting file or the luminaire's own "
                "file."));
}

// What the figures are worth: technique, certainty, measured error, what is not modelled.
std::string worth(const ReportHeader& h, const Measurements& m) {
  std::vector<std::string> lines;
  lines.push_back(
      fmt::format("Technique <b>{}</b>, quality {}. Asked was a relative standard error of {:g} % a reading{}",
                  escaped(h.technique), escaped(h.quality), 100 * h.tolerance,
                  m.certainty.meters == 0
                      ? "."
                      : fmt::format("; reached were {:.1g} % by half of the {} readings, {:.2g} % by the worst of "
                                    "them (dark places are read to a hundredth of the mean).",
                                    100 * m.certainty.median, m.certainty.meters, 100 * m.certainty.worst)));
  lines.push_back(accuracyWords(h.technique));
  const Technique* used = findTechnique(h.technique);
  if (used && used->meters.furnishedWithinPercent > 0) {
    lines.push_back(fmt::format(
        "In a furnished flat 95 of 100 readings of {0} were within {1:g} % of the reference technique {3}, their mean "
        "within {2:g} %; close to lamps in shades it may read up to 20 % high. Where a limit is close, measure again "
        "with <b>--technique {3}</b>.",
        used->name, used->meters.furnishedWithinPercent, used->meters.furnishedMeanPercent, technique::kPath));
  }
  const auto measured = std::count_if(m.luminaires.begin(), m.luminaires.end(),
                                      [](const Luminaire& l) { return l.kind == "photometric"; });
  if (!m.luminaires.empty()) {
    lines.push_back(
        fmt::format("{} of {} luminaires shine as their photometric file says (IES, EULUMDAT); others evenly from a "
                    "point, a cone or a surface.",
                    measured, m.luminaires.size()));
  }
  lines.push_back(
      "Materials are those of the file: no reflectance was measured in the home. Light is reckoned in three colours, "
      "not by spectra.");
  lines.push_back(fmt::format(
      "Not modelled: {}furniture, blinds and people that the file does not hold, and daylight of other days than the "
      "one lit.",
      m.maintenanceFactor < 1 ? "" : "ageing and dirt of lamps and rooms (no maintenance factor is given), "));
  return list("What these figures are worth", lines);
}

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

std::string tableSection(const char* title, const report::Table& table) {
  return table.isEmpty() ? "" : section(title, table.html());
}

std::string overview(const Measurements& m) {
  if (m.grids.empty()) return {};
  std::string s = gridTable(m, kHere).html() + "\n";
  for (const std::string& line : misplaced(m)) s += about(escaped(line));
  return section("Illuminance", s);
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
    s += section(escaped(g.name),
                 about(fmt::format("mean {} lx, lowest {} lx, highest {} lx, U0 {:.2f}; {} points, {:.2f} × {:.2f} m "
                                   "apart{}",
                                   threeDigits(l.mean), threeDigits(l.least), threeDigits(l.most), l.u0(), l.points,
                                   g.points.lattice.stepUM, g.points.lattice.stepVM,
                                   g.leftOut.empty() ? "" : fmt::format("; {} left out (crosses)", g.leftOut.size()))) +
                     "<div class=\"figure\">" + lightMapSvg(g, scene, scale, number++) + legendSvg(scale, "lx") +
                     "</div>");
  }
  return s;
}

std::string notes(const Measurements& m) {
  std::vector<std::string> lines;
  lines.push_back(
      "Points lie as EN 12464-1 lays them: p = 0.2 · 5<sup>log d</sup> apart, without a band along the walls of 0.5 m "
      "or 15 % of the shorter side. U0 is the lowest over the mean, U1 the lowest over the highest reading.");
  lines.push_back(
      m.maintenanceFactor < 1
          ? fmt::format("Readings are those of new lamps; targets are judged at {:g} of them (maintenance factor).",
                        m.maintenanceFactor)
          : "Readings are those of new lamps in clean rooms; no maintenance factor is applied.");
  lines.push_back(
      "On the maps, dots are the points of the statistics, crossed circles are lamps; white lines join places of equal "
      "illuminance, in lux. Surfaces are drawn where they are cut at the height of the plane.");
  if (!m.glares.empty())
    lines.push_back("UGR after CIE 117; lamps of less than 0.005 m², and lamps without a size, after CIE 147.");
  const std::vector<std::string> told = m.grids.empty() ? std::vector<std::string>() : misplaced(m);  // below the table
  for (const std::string& w : m.warnings) {
    if (std::find(told.begin(), told.end(), w) == told.end()) lines.push_back(escaped(w));
  }
  return list("How this was found", lines);
}

}  // namespace

std::string reportHtml(const ReportHeader& h, const Measurements& m, const Scene& scene) {
  const std::vector<Verdict> verdicts = verdictsOf(m);
  const Schedule schedule = scheduleOf(m.luminaires);
  std::string s = titleBlock(h) + summary(m, verdicts) + picture(h) + plans(m, scene, schedule) + roomTargetTable(m);
  s += tableSection("Stated targets", targetTable(verdicts, kHere)) + overview(m) + figures(m, scene);
  s += tableSection("Incident meters", pointTable(m, kHere)) + tableSection("Spot meters", spotTable(m, kHere)) +
       tableSection("Glare", glareTable(m, kHere));
  s += luminaireSchedule(schedule) + tableSection("Installed power", powerTable(m, kHere)) + worth(h, m) + notes(m);
  s += fmt::format("<footer>roomlight {}{}{}</footer>\n", escaped(h.version), h.date.empty() ? "" : ", ",
                   escaped(h.date));
  return report::page("Lighting report: " + std::filesystem::path(h.scene).filename().string(),
                      kLightMapStyle + std::string(kOverviewPlanStyle) + kStyle, s);
}

}  // namespace roomlight
