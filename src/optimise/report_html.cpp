#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/html.h"
#include "base/image_io.h"
#include "base/tone.h"
#include "measure/drawings.h"
#include "optimise/report.h"

namespace roomlight::optimise {
namespace {

constexpr int kJpegQuality = 82;
constexpr float kPlanMarginM = 0.4f;

constexpr const char* kStyle = R"(
.controls{margin:10px 0 4px;font-size:13.5px;color:var(--soft)}.controls>*{margin-right:8px}
svg{max-width:100%;height:auto}
#front{width:100%;display:block;touch-action:none;border:1px solid var(--line)}#front .grid{stroke:#e4e7eb}#front .point{fill:#7b8da6}#front .proposed{fill:#d9792b;stroke:#fff;stroke-width:1.5;cursor:pointer}
#front .number{font-weight:700}#front .axis{fill:var(--soft)}
#tip{display:none;position:absolute;background:#1d2530;color:#fff;font-size:12.5px;padding:5px 9px;border-radius:4px;max-width:360px;pointer-events:none}
.row{display:flex;flex-wrap:wrap;gap:14px 22px;align-items:flex-start;margin:8px 0}.row figure{margin:0;max-width:520px}.row img{width:100%;display:block}
figcaption{font-size:12.5px;color:var(--soft)}
.plan .wall{fill:none;stroke:#111820;stroke-width:calc(1.3*var(--px));stroke-linejoin:round;stroke-linecap:round}
.plan .lamp circle{stroke:#111820;stroke-width:calc(1.2*var(--px))}
.map{max-width:360px}
)";

std::string cell(const std::string& text, const char* kind = "") {
  return fmt::format("<td{}>{}</td>", *kind ? fmt::format(" class=\"{}\"", kind) : "", text);
}

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
    const PlanFrame frame{{0, y + 1.1f, 0},
                          {1, 0, 0},
                          {0, 0, 1},
                          low_ - Vec2{kPlanMarginM, kPlanMarginM},
                          high_ + Vec2{kPlanMarginM, kPlanMarginM}};
    for (const PlanLine& line : cutPlan(scene_, frame)) {
      for (size_t i = 0; i < line.size(); ++i)
        walls_ += fmt::format("{}{:.0f} {:.0f}", i ? "L" : "M", 100 * line[i].x, 100 * line[i].y);
    }
  }

  std::string walls() const {
    return fmt::format(
        "<svg width=\"0\" height=\"0\" style=\"position:absolute\"><defs><path id=\"walls\" d=\"{}\"/></defs></svg>\n",
        walls_);
  }

  // Lamps over the walls: the fuller a disc, the brighter the lamp in the first condition.
  std::string plan(const Proposed& d) const {
    const float x = 100 * (low_.x - kPlanMarginM), y = 100 * (low_.y - kPlanMarginM),
                w = 100 * (high_.x - low_.x + 2 * kPlanMarginM), h = 100 * (high_.y - low_.y + 2 * kPlanMarginM);
    std::string s = fmt::format(
        "<svg class=\"plan\" width=\"500\" viewBox=\"{:.0f} {:.0f} {:.0f} {:.0f}\" style=\"--px:{:.2f}px\" "
        "role=\"img\" aria-label=\"Plan\"><use href=\"#walls\" class=\"wall\"/>\n",
        x, y, w, h, w / 500);
    for (const BillLine& l : d.bill) {
      s += fmt::format(
          "<g class=\"lamp\"><title>{}, {}: {:.0f} %</title><circle cx=\"{:.0f}\" cy=\"{:.0f}\" r=\"{:.1f}\" "
          "fill=\"#ffb830\" fill-opacity=\"{:.2f}\"/></g>\n",
          htmlEscaped(l.name), htmlEscaped(l.place), 100 * l.dimming[0], 100 * l.position.x, 100 * l.position.z,
          7 * w / 500, 0.1 + 0.9 * l.dimming[0]);
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
        fmt::format("<h3>{}: lx, {}{}</h3>\n<div class=\"row\">", htmlEscaped(r_.study.conditions[condition].name),
                    d.certificate ? "full solution" : "predicted",
                    r_.study.maintenance < 1 ? fmt::format(", lamps at {:g} %", 100 * r_.study.maintenance) : "");
    for (size_t z = 0; z < r_.study.zones.size(); ++z) {
      const ZonePoints& points = r_.meters.zones[z];
      GridReading g;
      g.name = r_.study.zones[z].name, g.floor = r_.study.zones[z].room.floor;
      g.points.lattice = points.lattice,
      g.points.lux = points.lattice.spread(std::span(lux).subspan(points.first, points.count));
      s += fmt::format("<figure>{}<figcaption>{}</figcaption></figure>\n", lightMapSvg(g, scene_, scale, ++number_),
                       htmlEscaped(g.name));
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

std::string objectivesTable(const Report& r) {
  std::string s = "<div class=wide><table><tr><th>design</th>";
  for (const Objective o : r.model.objectives)
    s += fmt::format("<th>{}<br>{}</th>", infoOf(o).title,
                     o == Objective::Cost ? htmlEscaped(r.study.catalogue.currency) : infoOf(o).unit);
  s += "<th>lamps</th><th>installed<br>W</th><th>LENI<br>kWh/(m² a)</th><th>prediction off<br>at most</th></tr>\n";
  for (size_t d = 0; d < r.designs.size(); ++d) {
    const Proposed& p = r.designs[d];
    s += fmt::format("<tr><td><a href=\"#design{0}\">{0}</a></td>", d + 1);
    for (const Objective o : r.model.objectives) s += cell(threeDigits(p.result.of(o)));
    s += cell(fmt::format("{}", p.result.fittings)) + cell(threeDigits(p.result.installedW)) +
         cell(r.model.areaM2 > 0 ? threeDigits(p.result.kWhPerYear / r.model.areaM2) : "–") +
         cell(p.certificate ? fmt::format("{:.1f} % (± {:.1f} %)", p.certificate->worst().maxPercent,
                                          p.certificate->worst().uncertainPercent)
                            : "not solved") +
         "</tr>\n";
  }
  return s + "</table></div>\n";
}

// A goal, what is predicted of it, and what the full solution says where there is one: then that decides.
struct GoalRow {
  std::string what, wanted;
  double predicted = 0;
  std::optional<double> full;
  bool atLeast = true;
  double limit = 0, slack = 0;  // how much less or more still counts as met
};

template <class Text>
std::string rowOf(const GoalRow& g, const Text& text) {
  const double judged = g.full.value_or(g.predicted);
  const bool met = g.atLeast ? judged >= g.limit - g.slack : judged <= g.limit + g.slack;
  return "<tr>" + cell(htmlEscaped(g.what)) + cell(g.wanted) + cell(text(g.predicted)) +
         cell(g.full ? text(*g.full) : "–") + cell(met ? "✓ met" : "✗ missed", met ? "met" : "missed") + "</tr>\n";
}

constexpr double kRounded = 5e-4;  // of a goal: what is shown as met counts as met

std::string zoneGoals(const Report& r, size_t z, const std::string& name, const ZoneResult& predicted,
                      std::span<const float> fullLux) {
  const ModelZone& goal = r.model.zones[z];
  std::optional<double> mean, u0;
  if (!fullLux.empty()) {
    const Statistics full = statisticsOf(fullLux.subspan(r.meters.zones[z].first, r.meters.zones[z].count));
    mean = full.mean, u0 = full.u0();
  }
  std::string s;
  if (goal.meanLux > 0)
    s += rowOf({name + ": mean", "≥ " + threeDigits(goal.meanLux) + " lx", predicted.meanLux, mean, true, goal.meanLux,
                kRounded * goal.meanLux},
               [](double v) { return threeDigits(v) + " lx"; });
  if (goal.u0 > 0)
    s += rowOf({name + ": U0", fmt::format("≥ {:.2f}", goal.u0), predicted.u0(), u0, true, goal.u0, kRounded * goal.u0},
               [](double v) { return fmt::format("{:.2f}", v); });
  return s;
}

std::string goals(const Report& r, const Proposed& d) {
  std::string s =
      "<div class=wide><table><tr><th>goal</th><th>wanted</th><th>predicted</th><th>full solution</th><th></th></tr>\n";
  for (size_t c = 0; c < r.model.conditions.size(); ++c) {
    const ConditionResult& got = d.result.conditions[c];
    const std::string in = r.model.conditions.size() > 1 ? ", " + r.study.conditions[c].name : "";
    const std::vector<float> full =
        d.certificate ? maintainedLux(r.study, r.model, d.certificate->conditions[c], c) : std::vector<float>();
    for (const uint32_t z : r.model.conditions[c].zones)
      s += zoneGoals(r, z, r.study.zones[z].name + in, got.zones[z], full);
    for (const uint32_t e : r.model.conditions[c].eyes) {
      std::optional<double> ugr;
      if (d.certificate && d.certificate->conditions[c].fullUgr[e] >= 0) ugr = d.certificate->conditions[c].fullUgr[e];
      s += rowOf({r.study.eyes[e].name + in + ": UGR", fmt::format("≤ {:g}", r.model.eyes[e].ugr), got.ugr[e], ugr,
                  false, r.model.eyes[e].ugr, 0.005},
                 [](double v) { return fmt::format("{:.1f}", v); });
    }
    for (const uint32_t q : r.model.conditions[c].ratios) {
      const double most = r.model.ratios[q].most;
      s += rowOf({r.study.ratios[q].name + in + ": luminance ratio",
                  fmt::format("≤ {:g}", most),
                  got.ratios[q],
                  {},
                  false,
                  most,
                  kRounded * most},
                 [](double v) { return threeDigits(v); });
    }
  }
  return s + "</table></div>\n";
}

std::string bill(const Report& r, const Proposed& d) {
  std::string s =
      "<div class=wide><table><tr><th>lamp</th><th class=l>place</th><th>x, y, z in m</th><th "
      "class=l>aim</th><th>K</th><th>W</th>";
  for (const Condition& c : r.study.conditions) s += fmt::format("<th>{}</th>", htmlEscaped(c.name));
  s += fmt::format("<th>{}</th></tr>\n", htmlEscaped(r.study.catalogue.currency));
  for (const BillLine& l : d.bill) {
    s += "<tr>" + cell(htmlEscaped(l.name)) + cell(htmlEscaped(l.place), "l") +
         cell(fmt::format("{:.2f}, {:.2f}, {:.2f}", l.position.x, l.position.y, l.position.z)) + cell(l.aim, "l") +
         cell(fmt::format("{:g}", l.kelvin)) + cell(fmt::format("{:g}", l.wattsW));
    for (const double level : l.dimming) s += cell(fmt::format("{:.0f} %", 100 * level));
    s += cell(fmt::format("{:.2f}", l.price)) + "</tr>\n";
  }
  s +=
      fmt::format("<tr><td><b>together</b></td><td></td><td></td><td></td><td></td><td>{:g}</td>", d.result.installedW);
  for (const ConditionResult& c : d.result.conditions) s += cell(fmt::format("{:.1f} W", c.wattsW));
  return s + fmt::format("<td><b>{:.2f}</b></td></tr></table></div>\n", d.result.cost);
}

Result<std::string> pictures(const Proposed& d) {
  std::string s;
  for (const Image& shown : d.certificate->pictures) {
    ByteImage bytes(shown.width, shown.height, 3);
    for (size_t i = 0; i < shown.pixels.size(); ++i) {
      for (int c = 0; c < 3; ++c)
        bytes.samples[3 * i + static_cast<size_t>(c)] =
            static_cast<uint8_t>(std::lround(255 * std::clamp(shown.pixels[i][c], 0.0f, 1.0f)));
    }
    const Result<std::string> jpeg = encodeJpeg(bytes, kJpegQuality);
    if (!jpeg) return jpeg;
    s += fmt::format("<figure><img alt=\"{}\" src=\"data:image/jpeg;base64,{}\"></figure>", htmlEscaped(d.name),
                     base64(jpeg.value()));
  }
  return s;
}

std::string certificateTable(const Report& r, const Certificate& c) {
  std::string s =
      "<table><tr><th>prediction against full solution</th><th>points</th><th>mean "
      "difference</th><th>largest</th><th>full solution<br>uncertain there by</th></tr>\n";
  for (size_t k = 0; k < c.conditions.size(); ++k) {
    s += "<tr>" + cell(htmlEscaped(r.study.conditions[k].name)) + cell(fmt::format("{}", c.conditions[k].judged)) +
         cell(fmt::format("{:.2f} %", c.conditions[k].meanPercent)) +
         cell(fmt::format("{:.2f} %", c.conditions[k].maxPercent)) +
         cell(fmt::format("{:.2f} %", c.conditions[k].uncertainPercent)) + "</tr>\n";
  }
  return s + "</table>\n";
}

std::string methods(const Report& r) {
  std::string s =
      "<h2>How it was "
      "found</h2><table><tr><th>method</th><th>evaluations</th><th>seconds</th><th>hypervolume</th></tr>\n";
  for (const MethodResult& m : r.methods)
    s += "<tr>" + cell(htmlEscaped(m.name)) + cell(fmt::format("{}", m.evaluations)) +
         cell(fmt::format("{:.1f}", m.seconds)) + cell(fmt::format("{:.4f}", m.hypervolume)) + "</tr>\n";
  s += "</table>\n<table>";
  for (const auto& [name, value] : r.facts)
    s += "<tr>" + cell(htmlEscaped(name)) + cell(htmlEscaped(value), "l") + "</tr>\n";
  return s + "</table>\n";
}

}  // namespace

Result<std::string> reportHtml(const Report& r, const Scene& home) {
  Drawer drawer(r, home);
  std::string s = fmt::format("<h1>{}</h1>\n", htmlEscaped(r.study.title));
  s += drawer.walls();
  s += fmt::format(
      "<p>{} designs that no other betters in every goal, of {} places for lamps and {} candidates. Orange: proposed "
      "below. Wheel or buttons zoom, dragging moves.</p>\n",
      r.front.size(), r.candidates.places.size(), r.candidates.candidates.size());
  s += frontPlot(r) + objectivesTable(r);
  for (size_t i = 0; i < r.designs.size(); ++i) {
    const Proposed& d = r.designs[i];
    s += fmt::format("<h2 id=\"design{0}\">Design {0}</h2>\n<p class=soft>Open it:", i + 1);
    for (const std::string& file : d.lightingFiles) s += fmt::format(" <a href=\"{0}\">{0}</a>", htmlEscaped(file));
    s += "</p>\n<div class=\"row\">";
    if (d.certificate) {
      const Result<std::string> shown = pictures(d);
      if (!shown) return shown;
      s += shown.value();
    }
    s += fmt::format("<figure>{}<figcaption>Lamps; the fuller, the brighter in {}.</figcaption></figure></div>\n",
                     drawer.plan(d), htmlEscaped(r.study.conditions[0].name));
    s += goals(r, d);
    for (size_t c = 0; c < r.study.conditions.size(); ++c) s += drawer.maps(d, r.front.designs[d.index], c);
    s += bill(r, d);
    if (d.certificate) s += certificateTable(r, *d.certificate);
  }
  s += methods(r) +
       "<footer>Lux and UGR are predicted by adding up lamps' light; designs that were solved in full show both, and "
       "are judged by the full solution.</footer>\n";
  return htmlPage(r.study.title, kLightMapStyle + std::string(kStyle), s);
}

}  // namespace roomlight::optimise
