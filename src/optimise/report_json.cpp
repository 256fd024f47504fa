#include <nlohmann/json.hpp>

#include "optimise/improve.h"
#include "optimise/report.h"

namespace roomlight::optimise {
namespace {

using nlohmann::json;

// Where dimming alone is free: a lamp at every place, in one condition, and the least watts of any design of the front
// that meets all goals.
json leastWattsOf(const Report& r) {
  const Model& m = r.model;
  if (m.conditions.size() != 1 || m.options.size() != m.places() || m.levels() != 1) return nullptr;
  search::Genomes all;
  all.integersEach = m.places(), all.realsEach = m.places();
  all.resize(1);
  for (int32_t& i : all.integers) i = 1;
  for (double& d : all.reals) d = 1;
  const auto exact = leastWatts(m, all[0], 0);
  if (!exact) return nullptr;
  double found = -1;
  for (size_t i = 0; i < r.front.size(); ++i) {
    const DesignResult d = resultOf(m, r.front.designs[i]);
    if (d.missPercent < 1e-4 && (found < 0 || d.conditions[0].wattsW < found)) found = d.conditions[0].wattsW;
  }
  return {{"exactW", exact.value().wattsW}, {"foundW", found}};
}

}  // namespace

std::string runJson(const Report& r) {
  json j = {{"candidates", r.candidates.candidates.size()},
            {"places", r.candidates.places.size()},
            {"points", r.meters.points()},
            {"eyes", r.study.eyes.size()},
            {"responseSeconds", r.responseSeconds},
            {"baseSeconds", r.baseSeconds},
            {"designsASecond", r.designsASecond},
            {"lookUpsASecond", r.lookUpsASecond},
            {"leastWatts", leastWattsOf(r)}};
  for (const MethodResult& m : r.methods) {
    json trace = json::array();
    for (const TracePoint& t : m.trace) trace.push_back({t.evaluations, t.seconds, t.hypervolume});
    j["methods"].push_back({{"name", m.name},
                            {"evaluations", m.evaluations},
                            {"polished", m.polished},
                            {"seconds", m.seconds},
                            {"hypervolume", m.hypervolume},
                            {"trace", trace}});
  }
  for (const Proposed& d : r.designs) {
    json entry = {{"name", d.name}, {"fittings", d.result.fittings}};
    for (const ObjectiveInfo& o : objectiveTable()) entry[o.name] = d.result.of(o.objective);
    if (d.certificate) {
      entry["certifySeconds"] = d.certificate->seconds;
      for (size_t c = 0; c < d.certificate->conditions.size(); ++c) {
        const Certificate::OfCondition& k = d.certificate->conditions[c];
        entry["certificates"].push_back({{"condition", r.study.conditions[c].name},
                                         {"points", k.judged},
                                         {"meanPercent", k.meanPercent},
                                         {"maxPercent", k.maxPercent},
                                         {"uncertainPercent", k.uncertainPercent}});
      }
    }
    j["designs"].push_back(std::move(entry));
  }
  return j.dump(1, ' ', false, json::error_handler_t::replace) + "\n";
}

}  // namespace roomlight::optimise
