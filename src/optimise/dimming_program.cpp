#include "optimise/dimming_program.h"

#include <algorithm>

namespace roomlight::optimise {
namespace {

constexpr size_t kDarkPoints = 6;      // of a zone, whose uniformity is asked for
constexpr double kLeastWeight = 1e-6;  // of energy that was not asked for: among equals, less of it is better
constexpr double kLeastKWh = 1e-12;

// What solving takes, in evaluations of a design, measured (docs/measured/optimise.md): so much, and one more for so
// many entries of the matrix.
constexpr size_t kEvaluationsAProgram = 8, kEntriesAnEvaluation = 75;

double weightOf(const Model& m, const search::Wish& wish, Objective objective) {
  for (size_t k = 0; k < m.objectives.size(); ++k) {
    if (m.objectives[k] == objective) return wish.weights[k];
  }
  return 0;
}

}  // namespace

LinearWeights linearWeights(const Model& m, const search::Wish& wish) {
  LinearWeights w{weightOf(m, wish, Objective::TargetMiss), weightOf(m, wish, Objective::Energy),
                  weightOf(m, wish, Objective::Cost), weightOf(m, wish, Objective::Fittings)};
  w.energy = std::max(w.energy, kLeastWeight * w.miss);
  return w;
}

double weightOfGoals(const Model& m) {
  double sum = 0;
  for (const ModelCondition& c : m.conditions) {
    for (const uint32_t z : c.zones)
      sum += c.weight * m.zones[z].weight * ((m.zones[z].meanLux > 0) + (m.zones[z].u0 > 0));
    sum += c.weight * static_cast<double>(c.eyes.size() + c.ratios.size());
  }
  return sum;
}

DimmingProgram::DimmingProgram(const Model& model, std::vector<ChosenLamp> lamps, Scope scope)
    : m_(model), lamps_(std::move(lamps)), scope_(scope) {
  const size_t n = lamps_.size(), levels = scope.alike ? 1 : scope.end - scope.first;
  costs_.assign(n * levels, 0);
  if (levels == 1) return;
  firstBought_ = costs_.size();
  costs_.resize(firstBought_ + n, 0);
  for (size_t c = scope.first; c < scope.end; ++c) {
    for (size_t i = 0; i < n; ++i) {
      Row row;
      row.terms.emplace_back(level(i, c), 1.0), row.terms.emplace_back(bought(i), -1.0);
      row.most = 0;
      rows_.push_back(std::move(row));
    }
  }
}

void DimmingProgram::addCosts(const LinearWeights& weights, double share) {
  for (size_t i = 0; i < lamps_.size(); ++i) {
    const ModelOption& o = m_.options[lamps_[i].option];
    for (size_t c = scope_.first; c < scope_.end; ++c)
      costs_[level(i, c)] += weights.energy * std::max(m_.conditions[c].hours * o.wattsW / 1000, kLeastKWh);
    costs_[bought(i)] += share * (weights.cost * o.price + weights.fittings);
  }
}

void DimmingProgram::addGoals(const LinearWeights& weights) {
  const double goals = weightOfGoals(m_);
  for (size_t c = scope_.first; c < scope_.end; ++c) {
    for (const uint32_t z : m_.conditions[c].zones) {
      const ModelZone& zone = m_.zones[z];
      const double costOfMiss = weights.miss * 100 * m_.conditions[c].weight * zone.weight / goals;
      if (zone.meanLux > 0) addMean(c, z, costOfMiss);
      if (zone.meanLux > 0 && zone.u0 > 0) addDarkPoints(c, zone, costOfMiss);
    }
  }
}

void DimmingProgram::addRatios() {
  for (size_t c = scope_.first; c < scope_.end; ++c) {
    for (const uint32_t q : m_.conditions[c].ratios) {
      const size_t task = m_.firstSeen + 2 * q, surround = task + 1;
      const double k = m_.ratios[q].most;
      Row row = lampsRow(c, [&](uint32_t o) {
        return static_cast<double>(m_.column(o)[task]) - k * static_cast<double>(m_.column(o)[surround]);
      });
      row.most = k * static_cast<double>(m_.baseOf(c)[surround]) - static_cast<double>(m_.baseOf(c)[task]);
      if (row.most >= 0) rows_.push_back(std::move(row));
    }
  }
}

void DimmingProgram::addLimits() {
  if (m_.mostCost > 0) addLimit(m_.mostCost, [&](ChosenLamp l) { return m_.options[l.option].price; });
  if (m_.mostWatts > 0) addLimit(m_.mostWatts, [&](ChosenLamp l) { return m_.options[l.option].wattsW; });
  if (m_.mostFittings > 0) addLimit(m_.mostFittings, [](ChosenLamp) { return 1.0; });
  for (uint32_t rule = 0; rule < m_.mostOfRule.size(); ++rule) {
    const auto places = std::count(m_.ruleOfPlace.begin(), m_.ruleOfPlace.end(), rule);
    if (places > m_.mostOfRule[rule])
      addLimit(m_.mostOfRule[rule], [&](ChosenLamp l) { return m_.ruleOfPlace[l.place] == rule ? 1.0 : 0.0; });
  }
  for (uint32_t a = 0; a < m_.places(); ++a) {
    if (m_.firstOption[a + 1] > m_.firstOption[a] + 1)
      addLimit(1, [&](ChosenLamp l) { return l.place == a ? 1.0 : 0.0; });
    for (const uint32_t b : m_.conflicts[a]) {
      if (a < b) addLimit(1, [&](ChosenLamp l) { return l.place == a || l.place == b ? 1.0 : 0.0; });
    }
  }
}

void DimmingProgram::fix(size_t lamp, bool on) {
  for (size_t c = scope_.first; c < (scope_.alike ? scope_.first + 1 : scope_.end); ++c) {
    Row row;
    row.terms.emplace_back(level(lamp, c), 1.0);
    (on ? row.least : row.most) = on ? 1 : 0;
    rows_.push_back(std::move(row));
  }
}

// With f(d) = G + Σ g d² - most (B + Σ b d), G and B without lamps: f(d0) + Σ (2 g d0 - most b) (d - d0) <= 0.
void DimmingProgram::addGlareCut(size_t c, size_t e, double most, std::span<const double> levels) {
  Row row;
  row.most = most * static_cast<double>(m_.baseOf(c)[m_.firstEye + e]) - m_.baseGlare[c * m_.eyes.size() + e];
  for (size_t i = 0; i < lamps_.size(); ++i) {
    const uint32_t o = lamps_[i].option;
    const double glare = m_.glare[o * m_.eyes.size() + e];
    row.terms.emplace_back(level(i, c),
                           2 * glare * levels[i] - most * static_cast<double>(m_.column(o)[m_.firstEye + e]));
    row.most += glare * levels[i] * levels[i];
  }
  rows_.push_back(std::move(row));
}

Result<std::vector<double>> DimmingProgram::solve() const {
  search::LinearProgram p;
  p.cost = costs_;
  p.a.rows = rows_.size(), p.a.columns = costs_.size();
  p.a.values.assign(entries(), 0);
  for (size_t r = 0; r < rows_.size(); ++r) {
    for (const auto& [column, factor] : rows_[r].terms) p.a.row(r)[column] = factor;
    p.atLeast.push_back(rows_[r].least), p.atMost.push_back(rows_[r].most);
  }
  const auto solution = search::minimise(p);
  if (!solution) return Error{solution.error()};
  const size_t levels = lamps_.size() * (scope_.alike ? 1 : scope_.end - scope_.first);
  const std::vector<double>& x = solution.value().x;
  return std::vector<double>(x.begin(), x.begin() + static_cast<std::ptrdiff_t>(levels));
}

size_t DimmingProgram::costOfSolving() const { return kEvaluationsAProgram + entries() / kEntriesAnEvaluation; }

size_t DimmingProgram::addColumn(double cost) {
  costs_.push_back(cost);
  return costs_.size() - 1;
}

template <class Value>
DimmingProgram::Row DimmingProgram::lampsRow(size_t c, const Value& value) const {
  Row row;
  for (size_t i = 0; i < lamps_.size(); ++i) row.terms.emplace_back(level(i, c), value(lamps_[i].option));
  return row;
}

template <class Value>
void DimmingProgram::addLimit(double most, const Value& value) {
  Row row;
  row.most = most;
  for (size_t i = 0; i < lamps_.size(); ++i) {
    if (const double v = value(lamps_[i]); v > 0) row.terms.emplace_back(bought(i), v);
  }
  rows_.push_back(std::move(row));
}

void DimmingProgram::addMean(size_t c, size_t z, double costOfMiss) {
  const double wanted = m_.zones[z].meanLux, missing = wanted - m_.baseMeans[c * m_.zones.size() + z];
  if (missing <= 0) return;  // met without any lamp
  Row row = lampsRow(c, [&](uint32_t o) { return m_.means[o * m_.zones.size() + z]; });
  row.least = missing;
  row.terms.emplace_back(addColumn(costOfMiss), wanted);
  rows_.push_back(std::move(row));
}

// The points that are darkest with all lamps full; what the worst of them misses counts.
void DimmingProgram::addDarkPoints(size_t c, const ModelZone& zone, double costOfMiss) {
  std::vector<std::pair<float, size_t>> points;
  for (size_t r = zone.first; r < zone.first + zone.count; ++r) {
    float lux = m_.baseOf(c)[r];
    for (const ChosenLamp& l : lamps_) lux += m_.column(l.option)[r];
    points.emplace_back(lux, r);
  }
  const size_t n = std::min(kDarkPoints, points.size());
  std::partial_sort(points.begin(), points.begin() + static_cast<std::ptrdiff_t>(n), points.end());
  const double wanted = zone.u0 * zone.meanLux;
  const size_t miss = addColumn(costOfMiss);
  for (size_t k = 0; k < n; ++k) {
    const size_t r = points[k].second;
    const double missing = wanted - static_cast<double>(m_.baseOf(c)[r]);
    if (missing <= 0) continue;
    Row row = lampsRow(c, [&](uint32_t o) { return static_cast<double>(m_.column(o)[r]); });
    row.least = missing;
    row.terms.emplace_back(miss, wanted);
    rows_.push_back(std::move(row));
  }
}

}  // namespace roomlight::optimise
