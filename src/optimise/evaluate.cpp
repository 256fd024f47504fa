#include "optimise/evaluate.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/parallel.h"
#include "base/random.h"
#include "optimise/improve.h"

namespace roomlight::optimise {
namespace {

// What judging a design needs, kept from one to the next.
struct Workspace {
  std::vector<ChosenLamp> lamps;
  std::vector<double> levels;  // of the lamps in a condition
  std::vector<float> rows;     // the light in it
};

void addColumn(const float* column, float by, size_t rows, float* sum) {
  for (size_t r = 0; r < rows; ++r) sum[r] += by * column[r];
}

// Levels of the lamps and light on all rows in a condition.
void sumUp(const Model& m, search::ConstGenome design, size_t condition, Workspace& w) {
  levelsOf(m, w.lamps, design, condition, w.levels);
  w.rows.resize(m.rows);
  std::copy_n(m.baseOf(condition), m.rows, w.rows.data());
  for (size_t i = 0; i < w.lamps.size(); ++i) {
    if (w.levels[i] > 0) addColumn(m.column(w.lamps[i].option), static_cast<float>(w.levels[i]), m.rows, w.rows.data());
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
    out.leastLux = std::min(out.leastLux, static_cast<double>(least[k])),
    out.mostLux = std::max(out.mostLux, static_cast<double>(most[k]));
  }
  // What pads the rows are copies of the last point.
  total -= static_cast<double>(whole - z.count) * static_cast<double>(p[z.count - 1]);
  out.meanLux = total / static_cast<double>(z.count);
  return out;
}

double ugrAt(const Model& m, const Workspace& w, size_t condition, size_t eye) {
  return ugrOf(glareAt(m, w.lamps, w.levels, condition, eye), static_cast<double>(w.rows[m.firstEye + eye]));
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
  const auto task = static_cast<double>(rows[m.firstSeen + 2 * q]),
             surround = static_cast<double>(rows[m.firstSeen + 2 * q + 1]);
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

// Everything that can be said of the condition that was summed up.
ConditionResult allOf(const Model& m, const Workspace& w, size_t c) {
  ConditionResult r;
  for (const ModelZone& z : m.zones) r.zones.push_back(statistics(z, w.rows.data()));
  for (size_t e = 0; e < m.eyes.size(); ++e) r.ugr.push_back(ugrAt(m, w, c, e));
  for (size_t q = 0; q < m.ratios.size(); ++q) r.ratios.push_back(ratioOf(m, w.rows.data(), q));
  for (size_t i = 0; i < w.lamps.size(); ++i) r.wattsW += w.levels[i] * m.options[w.lamps[i].option].wattsW;
  return r;
}

// With `whole` also what objectives do not ask for.
DesignResult judged(const Model& m, search::ConstGenome design, Workspace& w, bool whole) {
  w.lamps = chosenLamps(m, design);
  DesignResult out;
  Judge judge(m);
  for (size_t c = 0; c < m.conditions.size(); ++c) {
    const ModelCondition& condition = m.conditions[c];
    const bool asked = !condition.zones.empty() || !condition.eyes.empty() || !condition.ratios.empty();
    if (!asked && !whole) continue;
    sumUp(m, design, c, w);
    if (whole) out.conditions.push_back(allOf(m, w, c));
    if (!asked) continue;
    for (const uint32_t z : condition.zones) judge.zone(z, statistics(m.zones[z], w.rows.data()), condition.weight);
    for (const uint32_t e : condition.eyes) judge.eye(e, ugrAt(m, w, c, e), condition.weight);
    for (const uint32_t q : condition.ratios) judge.ratio(q, ratioOf(m, w.rows.data(), q), condition.weight);
    judge.endCondition(condition.weight);
  }
  addCosts(m, w.lamps, design, out);
  out.missPercent = judge.missPercent(), out.unevenness = judge.unevenness(), out.glare = judge.glare();
  return out;
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
  Workspace w;
  w.lamps = chosenLamps(m, design);
  sumUp(m, design, condition, w);
  return w.rows;
}

DesignResult resultOf(const Model& m, search::ConstGenome design) {
  Workspace w;
  return judged(m, design, w, true);
}

void evaluateAll(const Model& m, const search::Genomes& designs, std::span<double> objectives) {
  const size_t each = m.objectives.size();
  parallelRanges(designs.count, 16, [&](size_t begin, size_t end) {
    Workspace w;
    for (size_t i = begin; i < end; ++i) {
      const DesignResult r = judged(m, designs[i], w, false);
      for (size_t k = 0; k < each; ++k) objectives[i * each + k] = r.of(m.objectives[k]);
    }
  });
}

search::Problem problemOf(const Model& m) {
  search::Problem problem;
  for (size_t p = 0; p < m.places(); ++p) {
    const auto group = static_cast<int32_t>(p);
    problem.integers.push_back({static_cast<int32_t>(m.firstOption[p + 1] - m.firstOption[p]) + 1, false, group});
    for (size_t l = 0; l < m.levels(); ++l) problem.reals.push_back({group});
  }
  problem.blockOfGroup.assign(m.ruleOfPlace.begin(), m.ruleOfPlace.end());
  problem.objectives = m.objectives.size();
  problem.evaluate = [&m](const search::Genomes& designs, std::span<double> objectives) {
    evaluateAll(m, designs, objectives);
  };
  problem.repair = [&m](search::Genome design) { repair(m, design); };
  problem.draw = [&m](size_t count, uint64_t seed, size_t generation) {
    return sparseDesigns(m, count, seed, generation);
  };
  // Dimming helps targets only.
  const bool targets = std::find(m.objectives.begin(), m.objectives.end(), Objective::TargetMiss) != m.objectives.end();
  if (m.levels() > 0 && targets)
    problem.polish = [&m](search::Genome design, const search::Wish& wish) { return polish(m, design, wish); };
  return problem;
}

search::Genomes sparseDesigns(const Model& m, size_t count, uint64_t seed, size_t generation) {
  search::Genomes out;
  out.integersEach = m.places(), out.realsEach = m.places() * m.levels();
  out.resize(count);
  for (size_t i = 0; i < count; ++i) {
    Rng random(i, generation, seed);
    const double share = (static_cast<double>(i) + 1) / static_cast<double>(count);
    for (size_t p = 0; p < m.places(); ++p) {
      const uint32_t options = m.firstOption[p + 1] - m.firstOption[p];
      const bool taken = static_cast<double>(random.uniform()) < share;
      const auto option = static_cast<int32_t>(
          std::min<uint32_t>(options - 1, static_cast<uint32_t>(random.uniform() * static_cast<float>(options))));
      out[i].integers[p] = taken ? 1 + option : 0;
    }
    for (double& d : out[i].reals) d = 0.3 + 0.7 * static_cast<double>(random.uniform());
  }
  return out;
}

}  // namespace roomlight::optimise
