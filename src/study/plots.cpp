#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>

#include "engine/settings.h"
#include "report/page.h"
#include "report/table.h"
#include "study/report.h"

namespace roomlight {
namespace {

using nlohmann::json, report::escaped, report::fixed, report::Table;

// Okabe & Ito 2008 and Tol 2021, told apart by people with any colour vision.
constexpr std::array<const char*, 8> kColours = {"#0072b2", "#d55e00", "#e69f00", "#009e73",
                                                 "#cc79a7", "#56b4e9", "#882255", "#999933"};

}  // namespace

std::string colourOf(const std::vector<StudyCurve>& curves, size_t i) {
  if (curves[i].kind == "judge") return "#777777";
  size_t n = 0;
  for (size_t k = 0; k < i; ++k) n += curves[k].kind != "judge";
  return kColours[n % kColours.size()];
}

std::string curvesPlot(const std::vector<StudyCase>& cases) {
  Table table({"scene, light", "<technique", "samples", "seconds", "mse beyond noise"});
  json list = json::array();
  for (const StudyCase& c : cases) {
    const std::string title = c.scene + ", " + c.light;
    json curves = json::array(), others = json::array();
    for (size_t i = 0; i < c.curves.size(); ++i) {
      const StudyCurve& curve = c.curves[i];
      if (curve.points.empty()) continue;
      json points = json::array();
      for (const StudyPoint& p : curve.points) {
        points.push_back({p.samples, p.seconds, p.mseBeyondNoise});
        table.row(
            {escaped(title), escaped(curve.technique), p.samples, fixed(p.seconds, 2), fixed(p.mseBeyondNoise, 5)});
      }
      curves.push_back({{"name", curve.technique},
                        {"colour", colourOf(c.curves, i)},
                        {"settled", &settledPoint(curve) - curve.points.data()},
                        {"points", points}});
    }
    for (const StudyExternal& e : c.externals) {
      others.push_back({{"name", e.name}, {"seconds", e.seconds}, {"mse", e.mseBeyondNoise}});
      table.row({escaped(title), escaped(e.name), "", fixed(e.seconds, 2), fixed(e.mseBeyondNoise, 5)});
    }
    list.push_back({{"title", title}, {"curves", curves}, {"others", others}});
  }
  const json data = {{"cases", list}};
  return report::plot("curves", "Error over time", data.dump(-1, ' ', true, json::error_handler_t::replace)) +
         "<details><summary>Every point</summary>" + table.wideHtml() + "</details>\n";
}

std::string barsHtml(const std::vector<Bar>& bars, const std::string& unit) {
  const auto cone = std::find_if(bars.begin(), bars.end(), [](const Bar& b) {
    return b.name == technique::kCone && b.value > 0 && b.published > 0;
  });
  const double scale = cone == bars.end() ? 0 : cone->value / cone->published;
  double most = 1e-9;
  for (const Bar& b : bars) most = std::max({most, b.value, b.published * scale});
  Table table({"", "<", ""});
  for (const Bar& b : bars) {
    std::string bar = fmt::format("<div style=\"width:{:.1f}%;background:{}\"></div>", 100 * b.value / most, b.colour);
    if (b.published * scale > 0)
      bar += fmt::format("<i style=\"left:{:.1f}%\" title=\"published, in ratio: {:g}\"></i>",
                         100 * b.published * scale / most, b.published);
    table.row({escaped(b.name), {bar, "bar"}, fmt::format("{:.3g} {}", b.value, unit)});
  }
  return "<div class=\"bars\">" + table.html() + "</div>\n";
}

}  // namespace roomlight
