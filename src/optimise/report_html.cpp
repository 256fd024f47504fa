#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "base/image_io.h"
#include "measure/drawings.h"
#include "optimise/report.h"
#include "report/page.h"
#include "report/table.h"

namespace roomlight::optimise {
namespace {

using report::Cell, report::escaped, report::figure, report::fixed, report::Table;

constexpr int kJpegQuality = 82;
constexpr float kPlanMarginM = 0.4f, kPlanPx = 500;

constexpr const char* kStyle = R"(
svg{max-width:100%;height:auto}details{margin:8px 0}summary{cursor:pointer}
.row{display:flex;flex-wrap:wrap;gap:14px 22px;align-items:flex-start;margin:8px 0}.row figure{margin:0;max-width:520px}.row img{width:100%;display:block}
figcaption{font-size:12.5px;color:var(--soft)}
.plan .wall{fill:none;stroke:#111820;stroke-width:calc(1.3*var(--px));stroke-linejoin:round;stroke-linecap:round}
.plan .lamp circle{stroke:#111820;stroke-width:calc(1.2*var(--px))}
.map{max-width:360px}
)";

// Plans and maps of designs: the home's walls are cut once.
class Drawer {
 public:
  Drawer(const Report& r, const Scene& home) : r_(r), scene_(home) {
    if (r.study.ownLamps) {
      ownLamps_ = home.lamps;
    } else {  // what no longer shines is no lamp
      for (Material& m : scene_.materials) m.emission = {};
    }
    low_ = {kInfinity, kInfinity}, high_ = {-kInfinity, -kInfinity};
    float y = kInfinity;
    const auto take = [&](const Room& room) {
      for (const Vec2 p : room.floor)
        low_ = {std::min(low_.x, p.x), std::min(low_.y, p.y)}, high_ = {std::max(high_.x, p.x), std::max(high_.y, p.y)};
      if (!room.floor.empty()) y = std::min(y, room.elevationM);
    };
    for (const Zone& z : r.study.zones) take(z.room);
    for (const PlaceRule& p : r.study.places) take(p.room);
    const Vec2 margin{kPlanMarginM, kPlanMarginM};
    const PlanFrame frame{{0, y + 1.1f, 0}, {1, 0, 0}, {0, 0, 1}, low_ - margin, high_ + margin};
    walls_ = pathOf(cutPlan(scene_, frame));
  }

  std::string walls() const {
    return fmt::format(
        "<svg width=\"0\" height=\"0\" style=\"position:absolute\"><defs><path id=\"walls\" d=\"{}\"/></defs></svg>\n",
        walls_);
  }

  // Lamps over the walls: the fuller a disc, the brighter the lamp in the first condition.
  std::string plan(const Proposed& d) const {
    const Vec2 margin{kPlanMarginM, kPlanMarginM}, size = (high_ - low_ + margin * 2) * 100;
    std::string s =
        openSvg("plan", "Plan", low_ - margin, size, size.x / kPlanPx) + "<use href=\"#walls\" class=\"wall\"/>\n";
    for (const BillLine& l : d.bill) {
      s += fmt::format(
          "<g class=\"lamp\"><title>{}, {}: {:.0f} %</title><circle cx=\"{:.0f}\" cy=\"{:.0f}\" r=\"{:.1f}\" "
          "fill=\"#ffb830\" fill-opacity=\"{:.2f}\"/></g>\n",
          escaped(l.name), escaped(l.place), 100 * l.dimming[0], 100 * l.position.x, 100 * l.position.z,
          7 * size.x / kPlanPx, 0.1 + 0.9 * l.dimming[0]);
    }
    return s + "</svg>";
  }

  // The light on every zone in a condition: by the full solution where there is one, else as predicted.
  std::string maps(const Proposed& d, search::ConstGenome design, size_t condition) {
    const std::vector<float> lux = luxOf(d, design, condition);
    const LightScale scale = scaleOf(lux);
    scene_.lamps = ownLamps_;
    for (const BillLine& l : d.bill) {
      Lamp lamp;
      lamp.name = l.name, lamp.position = l.position;
      scene_.lamps.push_back(lamp);
    }
    std::string s =
        fmt::format("<h3>{}: lx, {}{}</h3>\n<div class=\"row\">", escaped(r_.study.conditions[condition].name),
                    d.certificate ? "full solution" : "predicted",
                    r_.study.maintenance < 1 ? fmt::format(", lamps at {:g} %", 100 * r_.study.maintenance) : "");
    for (size_t z = 0; z < r_.study.zones.size(); ++z) {
      const ZonePoints& points = r_.meters.zones[z];
      GridReading g;
      g.name = r_.study.zones[z].name, g.floor = r_.study.zones[z].room.floor;
      g.points.lattice = points.lattice,
      g.points.lux = points.lattice.spread(std::span(lux).subspan(points.first, points.count));
      s += figure(lightMapSvg(g, scene_, scale, ++number_), escaped(g.name)) + "\n";
    }
    return s + legendSvg(scale, "lx") + "</div>\n";
  }

 private:
  // As goals are judged, per point of the meters.
  std::vector<float> luxOf(const Proposed& d, search::ConstGenome design, size_t condition) const {
    if (d.certificate) return maintainedLux(r_.study, r_.model, d.certificate->conditions[condition], condition);
    const std::vector<float> rows = rowsOf(r_.model, design, condition);
    std::vector<float> lux;
    for (const ModelZone& z : r_.model.zones) {
      const auto points = pointsOf(z, rows);
      lux.insert(lux.end(), points.begin(), points.end());
    }
    return lux;
  }

  const Report& r_;
  std::vector<Lamp> ownLamps_;  // of the home, where they stay lit
  Scene scene_;
  Vec2 low_, high_;
  std::string walls_;
  int number_ = 0;
};

std::string unitOf(const Report& r, Objective o) {
  return o == Objective::Cost ? r.study.catalogue.currency : infoOf(o).unit;
}

// "design" and the objectives.
Table objectivesHead(const Report& r) {
  Table table({"design"});
  for (const Objective o : r.model.objectives)
    table.column(fmt::format("{}<br>{}", infoOf(o).title, escaped(unitOf(r, o))));
  return table;
}

// Every design of the front: as a plot, and as a table for who has no scripts.
std::string front(const Report& r) {
  nlohmann::json axes = nlohmann::json::array(), points = nlohmann::json::array();
  for (const Objective o : r.model.objectives) axes.push_back({{"title", infoOf(o).title}, {"unit", unitOf(r, o)}});
  Table table = objectivesHead(r);
  for (size_t i = 0; i < r.front.size(); ++i) {
    const auto found =
        std::find_if(r.designs.begin(), r.designs.end(), [&](const Proposed& d) { return d.index == i; });
    const auto number = found - r.designs.begin() + 1;
    nlohmann::json& point = points.emplace_back();
    std::vector<Cell>& cells = table.row({found == r.designs.end() ? "" : fmt::format("{}", number)});
    if (found != r.designs.end()) point["design"] = number;
    for (const double v : r.front.objectivesOf(i)) {
      point["v"].push_back(std::stod(fmt::format("{:.5g}", v)));
      cells.emplace_back(threeDigits(v));
    }
  }
  const nlohmann::json data = {{"axes", axes}, {"points", points}};
  return report::plot("front", "The front", data.dump(-1, ' ', true, nlohmann::json::error_handler_t::replace)) +
         "<details><summary>All designs of the front</summary>" + table.wideHtml() + "</details>\n";
}

std::string objectivesTable(const Report& r) {
  Table table = objectivesHead(r);
  for (const char* head : {"lamps", "installed<br>W", "LENI<br>kWh/(m² a)", "prediction off<br>at most"})
    table.column(head);
  for (size_t d = 0; d < r.designs.size(); ++d) {
    const Proposed& p = r.designs[d];
    std::vector<Cell>& cells = table.row({fmt::format("<a href=\"#design{0}\">{0}</a>", d + 1)});
    for (const Objective o : r.model.objectives) cells.emplace_back(threeDigits(p.result.of(o)));
    cells.insert(cells.end(), {p.result.fittings, threeDigits(p.result.installedW),
                               r.model.areaM2 > 0 ? threeDigits(p.result.kWhPerYear / r.model.areaM2) : "–",
                               p.certificate ? fmt::format("{:.1f} % (± {:.1f} %)", p.certificate->worst().maxPercent,
                                                           p.certificate->worst().uncertainPercent)
                                             : "not solved"});
  }
  return table.wideHtml();
}

// A goal, what is predicted of it, and what the full solution says where there is one: then that decides.
struct GoalRow {
  std::string what, wanted;
  double predicted = 0;
  std::optional<double> full;
  bool atLeast = true;
  double limit = 0, slack = 0;  // how much less or more still counts as met
};

void add(Table& table, const GoalRow& g, const auto& text) {
  const double judged = g.full.value_or(g.predicted);
  const bool met = g.atLeast ? judged >= g.limit - g.slack : judged <= g.limit + g.slack;
  table.row({escaped(g.what), g.wanted, text(g.predicted), g.full ? text(*g.full) : "–", report::verdict(met)});
}

constexpr double kRounded = 5e-4;  // of a goal: what is shown as met counts as met

void addZoneGoals(Table& table, const Report& r, size_t z, const std::string& name, const ZoneResult& predicted,
                  std::span<const float> fullLux) {
  const ModelZone& goal = r.model.zones[z];
  std::optional<double> mean, u0;
  if (!fullLux.empty()) {
    const Statistics full = statisticsOf(fullLux.subspan(r.meters.zones[z].first, r.meters.zones[z].count));
    mean = full.mean, u0 = full.u0();
  }
  if (goal.meanLux > 0)
    add(table,
        {name + ": mean", "≥ " + threeDigits(goal.meanLux) + " lx", predicted.meanLux, mean, true, goal.meanLux,
         kRounded * goal.meanLux},
        [](double v) { return threeDigits(v) + " lx"; });
  if (goal.u0 > 0)
    add(table, {name + ": U0", fmt::format("≥ {:.2f}", goal.u0), predicted.u0(), u0, true, goal.u0, kRounded * goal.u0},
        [](double v) { return fixed(v, 2); });
}

std::string goals(const Report& r, const Proposed& d) {
  Table table({"goal", "wanted", "predicted", "full solution", ""});
  for (size_t c = 0; c < r.model.conditions.size(); ++c) {
    const ConditionResult& got = d.result.conditions[c];
    const std::string in = r.model.conditions.size() > 1 ? ", " + r.study.conditions[c].name : "";
    const std::vector<float> full =
        d.certificate ? maintainedLux(r.study, r.model, d.certificate->conditions[c], c) : std::vector<float>();
    for (const uint32_t z : r.model.conditions[c].zones)
      addZoneGoals(table, r, z, r.study.zones[z].name + in, got.zones[z], full);
    for (const uint32_t e : r.model.conditions[c].eyes) {
      std::optional<double> ugr;
      if (d.certificate && d.certificate->conditions[c].fullUgr[e] >= 0) ugr = d.certificate->conditions[c].fullUgr[e];
      add(table,
          {r.study.eyes[e].name + in + ": UGR", fmt::format("≤ {:g}", r.model.eyes[e].ugr), got.ugr[e], ugr, false,
           r.model.eyes[e].ugr, 0.005},
          [](double v) { return fixed(v, 1); });
    }
    for (const uint32_t q : r.model.conditions[c].ratios) {
      const double most = r.model.ratios[q].most;
      add(table,
          {r.study.ratios[q].name + in + ": luminance ratio", fmt::format("≤ {:g}", most), got.ratios[q], std::nullopt,
           false, most, kRounded * most},
          [](double v) { return threeDigits(v); });
    }
  }
  return table.wideHtml();
}

std::string bill(const Report& r, const Proposed& d) {
  Table table({"lamp", "<place", "x, y, z in m", "<aim", "K", "W"});
  for (const Condition& c : r.study.conditions) table.column(escaped(c.name));
  table.column(escaped(r.study.catalogue.currency));
  for (const BillLine& l : d.bill) {
    const Vec3 p = l.position;
    std::vector<Cell>& cells =
        table.row({escaped(l.name), escaped(l.place), fmt::format("{:.2f}, {:.2f}, {:.2f}", p.x, p.y, p.z), l.aim,
                   fmt::format("{:g}", l.kelvin), fmt::format("{:g}", l.wattsW)});
    for (const double level : l.dimming) cells.emplace_back(fixed(100 * level, 0) + " %");
    cells.emplace_back(fixed(l.price, 2));
  }
  std::vector<Cell>& sums = table.row({"<b>together</b>", "", "", "", "", fmt::format("{:g}", d.result.installedW)});
  for (const ConditionResult& c : d.result.conditions) sums.emplace_back(fixed(c.wattsW, 1) + " W");
  sums.emplace_back("<b>" + fixed(d.result.cost, 2) + "</b>");
  return table.wideHtml();
}

Result<std::string> pictures(const Proposed& d) {
  std::string s;
  for (const Image& shown : d.certificate->pictures) {
    const Result<std::string> jpeg = encodeJpeg(shown, kJpegQuality);
    if (!jpeg) return jpeg;
    s += figure(report::jpegPicture(d.name, jpeg.value()));
  }
  return s;
}

std::string certificateTable(const Report& r, const Certificate& c) {
  Table table({"prediction against full solution", "points", "mean difference", "largest",
               "full solution<br>uncertain there by"});
  for (size_t k = 0; k < c.conditions.size(); ++k)
    table.row({escaped(r.study.conditions[k].name), c.conditions[k].judged,
               fixed(c.conditions[k].meanPercent, 2) + " %", fixed(c.conditions[k].maxPercent, 2) + " %",
               fixed(c.conditions[k].uncertainPercent, 2) + " %"});
  return table.html() + "\n";
}

std::string methods(const Report& r) {
  Table table({"method", "evaluations", "seconds", "hypervolume"});
  for (const MethodResult& m : r.methods)
    table.row({escaped(m.name), m.evaluations, fixed(m.seconds, 1), fixed(m.hypervolume, 4)});
  return "<h2>How it was found</h2>" + table.html() + "\n" + report::factsHtml(r.facts);
}

}  // namespace

Result<std::string> reportHtml(const Report& r, const Scene& home, const std::string& plots) {
  Drawer drawer(r, home);
  std::string s = fmt::format("<h1>{}</h1>\n", escaped(r.study.title));
  s += drawer.walls();
  s += fmt::format(
      "<p>{} designs that no other betters in every goal, of {} places for lamps and {} candidates. Orange: proposed "
      "below. The wheel, buttons or a box that is dragged zoom.</p>\n",
      r.front.size(), r.candidates.places.size(), r.candidates.candidates.size());
  s += front(r) + objectivesTable(r);
  for (size_t i = 0; i < r.designs.size(); ++i) {
    const Proposed& d = r.designs[i];
    s += fmt::format("<h2 id=\"design{0}\">Design {0}</h2>\n<p class=soft>Open it:", i + 1);
    for (const std::string& file : d.lightingFiles) s += fmt::format(" <a href=\"{0}\">{0}</a>", escaped(file));
    s += "</p>\n<div class=\"row\">";
    if (d.certificate) {
      const Result<std::string> shown = pictures(d);
      if (!shown) return shown;
      s += shown.value();
    }
    s += figure(drawer.plan(d),
                fmt::format("Lamps; the fuller, the brighter in {}.", escaped(r.study.conditions[0].name))) +
         "</div>\n";
    s += goals(r, d);
    for (size_t c = 0; c < r.study.conditions.size(); ++c) s += drawer.maps(d, r.front.designs[d.index], c);
    s += bill(r, d);
    if (d.certificate) s += certificateTable(r, *d.certificate);
  }
  s += methods(r) +
       "<footer>Lux and UGR are predicted by adding up lamps' light; designs that were solved in full show both, and "
       "are judged by the full solution.</footer>\n";
  return report::page(r.study.title, kLightMapStyle + std::string(kStyle), s, plots);
}

}  // namespace roomlight::optimise
