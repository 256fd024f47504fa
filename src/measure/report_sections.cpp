#include "measure/report_sections.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <string_view>

#include "base/html.h"
#include "engine/settings.h"
#include "engine/technique.h"
#include "measure/drawings.h"
#include "measure/measurements.h"

namespace roomlight::report {
namespace {

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
        htmlEscaped(technique), technique::kHybrid, technique::kPath);
  return fmt::format(
      "Measured error: at {} places where the light is known (closed forms, the set-ups of CIE 171:2006) technique {} "
      "was off by at most {:.1f} %.",
      known->meters.places, known->name, known->meters.worstPercent);
}

}  // namespace

std::string cell(const std::string& text, const char* kind) {
  return fmt::format("<td{}{}{}>{}</td>", *kind ? " class=\"" : "", kind, *kind ? "\"" : "", text);
}

std::string head(std::initializer_list<const char*> names, size_t leftFrom) {
  std::string row = "<thead><tr>";
  size_t i = 0;
  for (const std::string_view name : names) {
    const bool left = name.starts_with('<') || i++ >= leftFrom;
    row += fmt::format("<th{}>{}</th>", left ? " class=\"l\"" : "", name.substr(name.starts_with('<') ? 1 : 0));
  }
  return row + "</tr></thead>\n";
}

std::string verdictCell(bool met) { return cell(met ? "✓ met" : "✗ missed", met ? "l met" : "l missed"); }

std::string fileName(const std::string& path) { return htmlEscaped(std::filesystem::path(path).filename().string()); }

std::string titleBlock(const ReportHeader& h) {
  std::string s = fmt::format("<header><div><h1>Lighting report</h1>\n<p class=\"project\">{}</p></div>\n<dl>",
                              htmlEscaped(std::filesystem::path(h.scene).stem().string()));
  const auto row = [&](const char* name, const std::string& value) {
    if (!value.empty()) s += fmt::format("<dt>{}</dt><dd>{}</dd>", name, value);
  };
  row("Date", htmlEscaped(h.date));
  row("Home", fileName(h.scene));
  row("Lighting", !h.lighting.empty()    ? fileName(h.lighting)
                  : h.addedLight.empty() ? std::string("of the home itself")
                                         : std::string("assumed, since the file has little or none: " + h.addedLight));
  row("Meters", h.meters.empty() ? "every room's work plane" : fileName(h.meters));
  row("Computed by",
      fmt::format("roomlight {}, {}, {}", htmlEscaped(h.version), htmlEscaped(h.technique), htmlEscaped(h.quality)));
  return s + "</dl></header>\n";
}

std::string picture(const ReportHeader& h) {
  if (h.pictureJpeg.empty()) return {};
  return fmt::format(
      "<figure class=\"shot\"><img alt=\"the home\" "
      "src=\"data:image/jpeg;base64,{}\"><figcaption>{}</figcaption></figure>\n",
      base64(h.pictureJpeg), htmlEscaped(h.pictureOf));
}

std::string plans(const Measurements& m, const Scene& scene, const Schedule& schedule) {
  const std::vector<OverviewPlan> storeys = overviewPlans(m, scene, schedule);
  if (storeys.empty()) return {};
  std::string s =
      "<section class=\"whole\"><h2>Plan</h2>\n<p class=\"about\">Mean illuminance on work planes; ✓ and ✗: beside the "
      "target of each room's use, below. Numbers are those of the luminaire schedule.</p>\n";
  for (const OverviewPlan& p : storeys) {
    if (storeys.size() > 1) s += fmt::format("<h3>Floor at {:.2f} m</h3>\n", static_cast<double>(p.elevationM) + 0.0);
    s += p.svg;
  }
  return s + "</section>\n";
}

std::string roomTargetTable(const Measurements& m) {
  const std::vector<RoomTarget> list = roomTargets(m);
  if (list.empty()) return {};
  std::string s = "<section><h2>Targets by room</h2>\n<table>" +
                  head({"room", "<use", "<use known", "target", "found", "", "source"}, 5);
  bool assumed = false;
  for (const RoomTarget& t : list) {
    assumed = assumed || t.origin == "assumed";
    s += "<tr>" + cell(htmlEscaped(t.room)) + cell(orDash(htmlEscaped(t.use)), "l") +
         cell(originWords(t.origin), t.origin == "assumed" ? "l soft" : "l") +
         cell(fmt::format("≥ {} lx", threeDigits(t.wantedLux))) +
         cell(t.foundLux ? threeDigits(*t.foundLux) + " lx" : "not measured") +
         (t.foundLux ? verdictCell(t.met()) : cell("", "l")) + cell(htmlEscaped(t.source), "l") + "</tr>\n";
  }
  s += "</table>\n";
  if (m.maintenanceFactor < 1)
    s += fmt::format("<p class=\"about\">Found: {:g} of the readings (maintenance factor).</p>\n", m.maintenanceFactor);
  if (assumed)
    s += fmt::format(
        "<p class=\"about\">Assumed: neither the home nor the meter file says what these rooms are for; they are "
        "judged as {} rooms. State the use in the meter file.</p>\n",
        kAssumedUse);
  return s + "</section>\n";
}

std::string luminaireSchedule(const Schedule& schedule) {
  if (schedule.rows.empty()) return {};
  std::string s = "<section><h2>Luminaire schedule</h2>\n<table>" +
                  head({"no.", "<luminaire", "<room", "<kind", "count", "lm each", "W each", "lm/W", "K"});
  size_t number = 0, count = 0;
  double flux = 0, watts = 0;
  bool allStated = true;
  for (const Luminaire& l : schedule.rows) {
    const auto n = static_cast<double>(l.count);
    count += l.count, flux += n * l.fluxLm, watts += n * l.wattsW, allStated = allStated && l.wattsW > 0;
    s += "<tr>" + cell(fmt::format("{}", ++number)) + cell(orDash(htmlEscaped(l.name)), "l") +
         cell(orDash(htmlEscaped(l.room)), "l") + cell(l.kind, "l") + cell(fmt::format("{}", l.count)) +
         cell(threeDigits(l.fluxLm)) + cell(l.wattsW > 0 ? threeDigits(l.wattsW) : "–") +
         cell(l.wattsW > 0 ? fmt::format("{:.0f}", l.fluxLm / l.wattsW) : "–") +
         cell(l.kelvin ? fmt::format("{:.0f}", std::round(*l.kelvin / 50) * 50) : "–") + "</tr>\n";
  }
  s += "<tr class=\"sum\">" + cell("") + cell("together", "l") + cell("", "l") + cell("", "l") +
       cell(fmt::format("{}", count)) + cell(fmt::format("{} lm", threeDigits(flux))) +
       cell(allStated ? fmt::format("{} W", threeDigits(watts)) : "not all stated") +
       cell(allStated ? fmt::format("{:.0f}", flux / watts) : "") + cell("") + "</tr>\n</table>\n";
  return s +
         "<p class=\"about\">lm: as it shines here, dimmed and with its light loss factor. K: nearest temperature of "
         "its light; –: plain white or coloured. W: as stated by the lighting file or the luminaire's own "
         "file.</p></section>\n";
}

std::string worth(const ReportHeader& h, const Measurements& m) {
  std::string s = "<section><h2>What these figures are worth</h2>\n<ul class=\"notes\">";
  const auto note = [&](const std::string& text) { s += "<li>" + text + "</li>\n"; };
  note(fmt::format("Technique <b>{}</b>, quality {}. Asked was a relative standard error of {:g} % a reading{}",
                   htmlEscaped(h.technique), htmlEscaped(h.quality), 100 * h.tolerance,
                   m.certainty.meters == 0
                       ? "."
                       : fmt::format("; reached were {:.1g} % by half of the {} readings, {:.2g} % by the worst of "
                                     "them (dark places are read to a hundredth of the mean).",
                                     100 * m.certainty.median, m.certainty.meters, 100 * m.certainty.worst)));
  note(accuracyWords(h.technique));
  const Technique* used = findTechnique(h.technique);
  if (used && used->meters.furnishedWithinPercent > 0) {
    note(fmt::format(
        "In a furnished flat 95 of 100 readings of {0} were within {1:g} % of the reference technique {3}, their mean "
        "within {2:g} %; close to lamps in shades it may read up to 20 % high. Where a limit is close, measure again "
        "with <b>--technique {3}</b>.",
        used->name, used->meters.furnishedWithinPercent, used->meters.furnishedMeanPercent, technique::kPath));
  }
  const auto measured = std::count_if(m.luminaires.begin(), m.luminaires.end(),
                                      [](const Luminaire& l) { return l.kind == "photometric"; });
  if (!m.luminaires.empty()) {
    note(
        fmt::format("{} of {} luminaires shine as their photometric file says (IES, EULUMDAT); others evenly from a "
                    "point, a cone or a surface.",
                    measured, m.luminaires.size()));
  }
  note(
      "Materials are those of the file: no reflectance was measured in the home. Light is reckoned in three colours, "
      "not by spectra.");
  note(fmt::format(
      "Not modelled: {}furniture, blinds and people that the file does not hold, and daylight of other days than the "
      "one lit.",
      m.maintenanceFactor < 1 ? "" : "ageing and dirt of lamps and rooms (no maintenance factor is given), "));
  return s + "</ul></section>\n";
}

}  // namespace roomlight::report
