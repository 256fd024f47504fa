#include "optimise/evaluate.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/parallel.h"
#include "base/random.h"
#include "optimise/polish.h"
#include "optimise/repair.h"

namespace roomlight::optimise {
namespace {

constexpr double kHoursAYear = 8760;

void addColumn(const float* column, float by, size_t rows, float* sum) {
  for (size_t r = 0; r < rows; ++r) sum[r] += by * column[r];
}

// Light on all rows in a condition.
void sumUp(const Model& m, std::span<const ChosenLamp> lamps, search::ConstGenome design, size_t condition, float* rows) {
  std::copy_n(m.baseOf(condition), m.rows, rows);
  for (const ChosenLamp& lamp : lamps) {
    const auto d = static_cast<float>(dimmingOf(m, design, lamp, condition));
    if (d > 0) addColumn(m.column(lamp.option), d, m.rows, rows);
  }
}

// Mean and extremes, kLanes values at a time.
ZoneResult statistics(const ModelZone& z, const float* rows) {
  const float* p = rows + z.first;
  std::array<float, kLanes> sum{}, least, most{};
  least.fill(std::numeric_limits<float>::infinity());
  const size_t whole = (z.count + kLanes - 1) / kLanes * kLanes;
  for (size_t r = 0; r < whole; r += kLanes) {
    for (size_t k = 0; k < kLanes; ++k) {
      const float x = p[r + k];
      sum[k] += x;
      least[k] = x < least[k] ? x : least[k];
      most[k] = x > most[k] ? x : most[k];
    }
  }
  double total = 0;
  ZoneResult out{0, static_cast<double>(least[0]), 0};
  for (size_t k = 0; k < kLanes; ++k) {
    total += static_cast<double>(sum[k]);
    out.leastLux = std::min(out.leastLux, static_cast<double>(least[k])), out.mostLux = std::max(out.mostLux, static_cast<double>(most[k]));
  }
  // What pads the rows are copies of the last point.
  total -= static_cast<double>(whole - z.count) * static_cast<double>(p[z.count - 1]);
  out.meanLux = total / static_cast<double>(z.count);
  return out;
}

double ugrOf(const Model& m, std::span<const ChosenLamp> lamps, search::ConstGenome design, size_t condition, size_t eye, double backgroundCdM2) {
  double sum = m.baseGlare[condition * m.eyes.size() + eye];
  for (const ChosenLamp& lamp : lamps) {
    const double d = dimmingOf(m, design, lamp, condition);
    sum += d * d * m.glare[lamp.option * m.eyes.size() + eye];
  }
  if (!(sum > 0)) return 0;
  return std::max(0.0, 8 * std::log10(0.25 * sum / std::max(backgroundCdM2, 1e-6)));
}

// Sums of what is judged, over conditions.
class Judge {
 public:
  explicit Judge(const Model& m) : m_(m) {}

  void zone(size_t z, const ZoneResult& r, double weight) {
    const ModelZone& goal = m_.zones[z];
    if (goal.meanLux > 0) term(1 - r.meanLux / goal.meanLux, weight * goal.weight);
    if (goal.u0 > 0) term(1 - r.u0() / goal.u0, weight * goal.weight);
    uneven_ += weight * goal.weight * (1 - r.u0()), unevenWeight_ += weight * goal.weight;
  }
  void eye(size_t e, double ugr, double weight) {
    term(ugr / m_.eyes[e].ugr - 1, weight);
    worst_ = std::max(worst_, ugr - m_.eyes[e].ugr);
  }
  void ratio(size_t q, double ratio, double weight) { term(ratio / m_.ratios[q].most - 1, weight); }
  void endCondition(double weight) {
    glare_ += weight * std::max(0.0, worst_), glareWeight_ += weight;
    worst_ = 0;
  }
  double missPercent() const { return weight_ > 0 ? 100 * miss_ / weight_ : 0; }
  double unevenness() const { return unevenWeight_ > 0 ? uneven_ / unevenWeight_ : 0; }
  double glare() const { return glareWeight_ > 0 ? glare_ / glareWeight_ : 0; }

 private:
  // How far a goal is missed, as a share of it; all of it at most.
  void term(double missed, double weight) { miss_ += weight * std::clamp(missed, 0.0, 1.0), weight_ += weight; }

  const Model& m_;
  double miss_ = 0, weight_ = 0, uneven_ = 0, unevenWeight_ = 0, glare_ = 0, glareWeight_ = 0, worst_ = 0;
};

double ratioOf(const Model& m, const float* rows, size_t q) {
  const auto task = static_cast<double>(rows[m.firstSeen + 2 * q]), surround = static_cast<double>(rows[m.firstSeen + 2 * q + 1]);
  return task / std::max(surround, 1e-6);
}

void addCosts(const Model& m, std::span<const ChosenLamp> lamps, search::ConstGenome design, DesignResult& out) {
  for (const ChosenLamp& lamp : lamps) {
    const ModelOption& o = m.options[lamp.option];
    out.cost += o.price, out.installedW += o.wattsW;
    double onHours = 0;
    for (size_t c = 0; c < m.conditions.size(); ++c) {
      const double d = dimmingOf(m, design, lamp, c);
      out.kWhPerYear += m.conditions[c].hours * d * o.wattsW / 1000;
      if (d > 0) onHours += m.conditions[c].hours;
    }
    out.kWhPerYear += std::max(0.0, kHoursAYear - onHours) * o.standbyW / 1000;
  }
  out.fittings = lamps.size();
}

// The same as resultOf() without what objectives do not ask for.
void objectivesOf(const Model& m, search::ConstGenome design, std::vector<float>& rows, std::span<double> out) {
  const std::vector<ChosenLamp> lamps = chosenLamps(m, design);
  DesignResult r;
  Judge judge(m);
  for (size_t c = 0; c < m.conditions.size(); ++c) {
    const ModelCondition& condition = m.conditions[c];
    if (condition.zones.empty() && condition.eyes.empty() && condition.ratios.empty()) continue;
    sumUp(m, lamps, design, c, rows.data());
    for (const uint32_t z : condition.zones) judge.zone(z, statistics(m.zones[z], rows.data()), condition.weight);
    for (const uint32_t e : condition.eyes) judge.eye(e, ugrOf(m, lamps, design, c, e, static_cast<double>(rows[m.firstEye + e])), condition.weight);
    for (const uint32_t q : condition.ratios) judge.ratio(q, ratioOf(m, rows.data(), q), condition.weight);
    judge.endCondition(condition.weight);
  }
  addCosts(m, lamps, design, r);
  r.missPercent = judge.missPercent(), r.unevenness = judge.unevenness(), r.glare = judge.glare();
  for (size_t k = 0; k < m.objectives.size(); ++k) out[k] = r.of(m.objectives[k]);
}

}  // namespace

double DesignResult::of(Objective objective) const {
  switch (objective) {
    case Objective::TargetMiss: return missPercent;
    case Objective::Uniformity: return unevenness;
    case Objective::Glare: return glare;
    case Objective::Energy: return kWhPerYear;
    case Objective::Cost: return cost;
    case Objective::Fittings: return static_cast<double>(fittings);
  }
  return 0;
}

std::vector<float> rowsOf(const Model& m, search::ConstGenome design, size_t condition) {
  std::vector<float> rows(m.rows);
  sumUp(m, chosenLamps(m, design), design, condition, rows.data());
  return rows;
}

DesignResult resultOf(const Model& m, search::ConstGenome design) {
  const std::vector<ChosenLamp> lamps = chosenLamps(m, design);
  DesignResult out;
  Judge judge(m);
  for (size_t c = 0; c < m.conditions.size(); ++c) {
    const ModelCondition& condition = m.conditions[c];
    const std::vector<float> rows = rowsOf(m, design, c);
    ConditionResult r;
    for (const ModelZone& z : m.zones) r.zones.push_back(statistics(z, rows.data()));
    for (size_t e = 0; e < m.eyes.size(); ++e) r.ugr.push_back(ugrOf(m, lamps, design, c, e, static_cast<double>(rows[m.firstEye + e])));
    for (size_t q = 0; q < m.ratios.size(); ++q) r.ratios.push_back(ratioOf(m, rows.data(), q));
    for (const ChosenLamp& lamp : lamps) r.wattsW += dimmingOf(m, design, lamp, c) * m.options[lamp.option].wattsW;
    if (!condition.zones.empty() || !condition.eyes.empty() || !condition.ratios.empty()) {
      for (const uint32_t z : condition.zones) judge.zone(z, r.zones[z], condition.weight);
      for (const uint32_t e : condition.eyes) judge.eye(e, r.ugr[e], condition.weight);
      for (const uint32_t q : condition.ratios) judge.ratio(q, r.ratios[q], condition.weight);
      judge.endCondition(condition.weight);
    }
    out.conditions.push_back(std::move(r));
  }
  addCosts(m, lamps, design, out);
  out.missPercent = judge.missPercent(), out.unevenness = judge.unevenness(), out.glare = judge.glare();
  return out;
}

void evaluateAll(const Model& m, const search::Genomes& designs, std::span<double> objectives) {
  const size_t each = m.objectives.size();
  parallelRanges(designs.count, 16, [&](size_t begin, size_t end) {
    std::vector<float> rows(m.rows);
    for (size_t i = begin; i < end; ++i) objectivesOf(m, designs[i], rows, objectives.subspan(i * each, each));
  });
}

search::Problem problemOf(const Model& m) {
  search::Problem problem;
  for (size_t p = 0; p < m.places(); ++p) {
    const auto group = static_cast<int32_t>(p);
    problem.integers.push_back({static_cast<int32_t>(m.firstOption[p + 1] - m.firstOption[p]) + 1, false, group});
    for (size_t l = 0; l < m.levels(); ++l) problem.reals.push_back({group});
  }
  problem.objectives = m.objectives.size();
  problem.evaluate = [&m](const search::Genomes& designs, std::span<double> objectives) { evaluateAll(m, designs, objectives); };
  problem.repair = [&m](search::Genome design) { repair(m, design); };
  if (m.levels() > 0) problem.polish = [&m](search::Genome design, const search::Wish& wish) { return polish(m, design, wish); };
  return problem;
}

search::Genomes sparseDesigns(const Model& m, size_t count, uint64_t seed) {
  search::Genomes out;
  out.integersEach = m.places(), out.realsEach = m.places() * m.levels();
  out.resize(count);
  for (size_t i = 0; i < count; ++i) {
    Rng random(i, 0, seed);
    const double share = (static_cast<double>(i) + 1) / static_cast<double>(count);
    for (size_t p = 0; p < m.places(); ++p) {
      const uint32_t options = m.firstOption[p + 1] - m.firstOption[p];
      const bool taken = static_cast<double>(random.uniform()) < share;
      const auto option = static_cast<int32_t>(std::min<uint32_t>(options - 1, static_cast<uint32_t>(random.uniform() * static_cast<float>(options))));
      out[i].integers[p] = taken ? 1 + option : 0;
    }
    for (double& d : out[i].reals) d = 0.3 + 0.7 * static_cast<double>(random.uniform());
  }
  return out;
}

}  // namespace roomlight::optimise
