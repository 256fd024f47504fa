#include <fmt/format.h>

#include "optimise/report.h"

namespace roomlight::optimise {
namespace {

std::string csvText(const std::string& text) {
  std::string out = "\"";
  for (const char c : text) out += c == '"' ? "\"\"" : std::string(1, c);
  return out + "\"";
}

}  // namespace

std::string frontCsv(const Report& r) {
  std::string s = "number,proposed";
  for (const ObjectiveInfo& o : objectiveTable()) s += fmt::format(",{}{}{}", o.name, *o.unit ? " " : "", o.unit);
  s += ",installed W,kWh/(m2 a),lamps\n";
  for (size_t i = 0; i < r.front.size(); ++i) {
    const DesignResult d = resultOf(r.model, r.front.designs[i]);
    std::string proposed;
    for (size_t k = 0; k < r.designs.size(); ++k)
      proposed = r.designs[k].index == i ? fmt::format("{}", k + 1) : proposed;
    s += fmt::format("{},{}", i + 1, proposed);
    for (const ObjectiveInfo& o : objectiveTable()) s += fmt::format(",{:.6g}", d.of(o.objective));
    std::string lamps;
    for (const BillLine& line : billOf({r.study, r.candidates, r.model, r.front.designs[i]})) {
      std::string levels;
      for (const double level : line.dimming) levels += fmt::format("{}{:.0f}", levels.empty() ? "" : "/", 100 * level);
      lamps +=
          fmt::format("{}{}: {} {:g} K {} %", lamps.empty() ? "" : "; ", line.place, line.name, line.kelvin, levels);
    }
    s += fmt::format(",{:.6g},{:.6g},{}\n", d.installedW, r.model.areaM2 > 0 ? d.kWhPerYear / r.model.areaM2 : 0,
                     csvText(lamps));
  }
  return s;
}

std::string pointsCsv(const Report& r) {
  std::string s = "design,condition,zone,x,y,z,predicted lx,full lx,difference %,standard error of full lx\n";
  for (size_t d = 0; d < r.designs.size(); ++d) {
    if (!r.designs[d].certificate) continue;
    for (size_t c = 0; c < r.study.conditions.size(); ++c) {
      const Certificate::OfCondition& k = r.designs[d].certificate->conditions[c];
      for (size_t z = 0; z < r.study.zones.size(); ++z) {
        for (size_t i = r.meters.zones[z].first; i < r.meters.zones[z].first + r.meters.zones[z].count; ++i) {
          const Vec3 p = r.meters.elements[i].position;
          s += fmt::format("{},{},{},{:.3f},{:.3f},{:.3f},{:.5g},{:.5g},{:.2f},{:.3g}\n", d + 1,
                           csvText(r.study.conditions[c].name), csvText(r.study.zones[z].name), p.x, p.y, p.z,
                           k.predictedLux[i], k.fullLux[i],
                           k.fullLux[i] > 0 ? 100 * (k.predictedLux[i] / k.fullLux[i] - 1) : 0, k.fullErrorLux[i]);
        }
      }
    }
  }
  return s;
}

}  // namespace roomlight::optimise
