#include "optimise/evaluate.h"

#include <algorithm>
#include <cassert>

#include "search/front.h"

namespace roomlight::optimise {
namespace {

constexpr double kBeyond = 1.1;
constexpr double kMostMissPercent = 100, kMostUnevenness = 1, kMostGlare = 20;

// Of designs that have a lamp at every place, the one that is most in each, up to the limits.
struct Most {
  double wattsW = 0, standbyW = 0, cost = 0, fittings = 0, kWh = 0;
};

Most mostOf(const Model& m) {
  Most most;
  for (size_t p = 0; p < m.places(); ++p) {
    double watts = 0, standby = 0, cost = 0;
    for (size_t o = m.firstOption[p]; o < m.firstOption[p + 1]; ++o) {
      watts = std::max(watts, m.options[o].wattsW), standby = std::max(standby, m.options[o].standbyW),
      cost = std::max(cost, m.options[o].price);
    }
    most.wattsW += watts, most.standbyW += standby, most.cost += cost;
  }
  most.fittings = static_cast<double>(m.places());
  if (m.mostWatts > 0) most.wattsW = std::min(most.wattsW, m.mostWatts);
  if (m.mostCost > 0) most.cost = std::min(most.cost, m.mostCost);
  if (m.mostFittings > 0) most.fittings = std::min<double>(most.fittings, m.mostFittings);
  for (const ModelCondition& c : m.conditions) most.kWh += c.hours * most.wattsW / 1000;
  most.kWh += kHoursAYear * most.standbyW / 1000;
  return most;
}

}  // namespace

ObjectiveBox boxOf(const Model& m) {
  const Most most = mostOf(m);
  const auto worst = [&](Objective o) {
    switch (o) {
      case Objective::TargetMiss: return kMostMissPercent;
      case Objective::Uniformity: return kMostUnevenness;
      case Objective::Glare: return kMostGlare;
      case Objective::Energy: return most.kWh;
      case Objective::Cost: return most.cost;
      case Objective::Fittings: return most.fittings;
    }
    assert(!"an objective whose worst nobody has stated");
    return 0.0;
  };
  ObjectiveBox box;
  for (const Objective o : m.objectives)
    box.ideal.push_back(0), box.reference.push_back(kBeyond * std::max(worst(o), 1e-9));
  return box;
}

double hypervolumeOf(const Model& m, const search::Archive& front) {
  const ObjectiveBox box = boxOf(m);
  if (front.objectivesEach < 4 || front.size() <= kHypervolumePoints)
    return search::hypervolumeShare(front.objectives, box.ideal, box.reference);
  // The designs themselves are not needed.
  search::Archive points;
  points.objectivesEach = front.objectivesEach, points.objectives = front.objectives,
  points.designs.count = front.size();
  search::thin(points, kHypervolumePoints);
  return search::hypervolumeShare(points.objectives, box.ideal, box.reference);
}

}  // namespace roomlight::optimise
