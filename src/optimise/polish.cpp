#include "optimise/polish.h"

#include <algorithm>
#include <cmath>

#include "search/dimming.h"

namespace roomlight::optimise {
namespace {

constexpr size_t kDarkPoints = 6;       // of a zone, whose uniformity is asked for
constexpr double kLeastWeight = 1e-6;   // of objectives that were not asked for: among equals, less energy is better
constexpr double kSame = 1e-12;

// One linear program: dimming of lamps in some conditions at once, and how far goals are missed.
class Program {
 public:
  Program(const Model& m, search::ConstGenome design, std::vector<ChosenLamp> lamps) : m_(m), design_(design), lamps_(std::move(lamps)) {}

  // Lamps' columns come first.
  void begin(std::span<const double> costs) {
    p_.cost.assign(costs.begin(), costs.end());
    p_.upper.assign(costs.size(), 1);
  }
  // What is missing of each goal of a condition, as a share, costs this much.
  void addGoals(size_t c, double costOfMiss) {
    const ModelCondition& condition = m_.conditions[c];
    for (const uint32_t z : condition.zones) {
      const ModelZone& zone = m_.zones[z];
      if (zone.meanLux > 0) {
        Row row = lampsRow([&](uint32_t o) { return m_.means[o * m_.zones.size() + z]; });
        row.least = zone.meanLux - m_.baseMeans[c * m_.zones.size() + z];
        addSlack(row, zone.meanLux, costOfMiss * zone.weight);
      }
      if (zone.meanLux > 0 && zone.u0 > 0) addDarkPoints(c, zone, costOfMiss * zone.weight);
    }
  }
  // Glare and ratios stay where they are or below their limits. d² <= d makes this linear, on the safe side.
  void addBounds(size_t c, std::span<const double> ugrNow) {
    const ModelCondition& condition = m_.conditions[c];
    for (const uint32_t e : condition.eyes) {
      const double k = 4 * std::pow(10, std::max(m_.eyes[e].ugr, ugrNow[e]) / 8);
      Row row = lampsRow([&](uint32_t o) { return m_.glare[o * m_.eyes.size() + e] - k * static_cast<double>(m_.column(o)[m_.firstEye + e]); });
      row.most = k * static_cast<double>(m_.baseOf(c)[m_.firstEye + e]) - m_.baseGlare[c * m_.eyes.size() + e];
      if (row.most >= 0) rows_.push_back(std::move(row));
    }
    for (const uint32_t q : condition.ratios) {
      const size_t task = m_.firstSeen + 2 * q, surround = task + 1;
      const double k = m_.ratios[q].most;
      Row row = lampsRow([&](uint32_t o) { return static_cast<double>(m_.column(o)[task]) - k * static_cast<double>(m_.column(o)[surround]); });
      row.most = k * static_cast<double>(m_.baseOf(c)[surround]) - static_cast<double>(m_.baseOf(c)[task]);
      if (row.most >= 0) rows_.push_back(std::move(row));
    }
  }
  Result<search::LinearSolution> solve() {
    p_.a.rows = rows_.size(), p_.a.columns = p_.cost.size();
    p_.a.values.assign(p_.a.rows * p_.a.columns, 0);
    for (size_t r = 0; r < rows_.size(); ++r) {
      std::copy(rows_[r].lamps.begin(), rows_[r].lamps.end(), p_.a.row(r).begin());
      if (rows_[r].slack > 0) p_.a.row(r)[rows_[r].slackColumn] = rows_[r].slack;
      p_.atLeast.push_back(rows_[r].least), p_.atMost.push_back(rows_[r].most);
    }
    return search::minimise(p_);
  }

 private:
  struct Row {
    std::vector<double> lamps;
    double slack = 0, least = -search::kUnbounded, most = search::kUnbounded;
    size_t slackColumn = 0;
  };

  template <class Value>
  Row lampsRow(const Value& value) const {
    Row row;
    for (const ChosenLamp& l : lamps_) row.lamps.push_back(value(l.option));
    return row;
  }
  void addSlack(Row row, double whole, double cost) {
    if (row.least <= 0) return;  // met without any lamp
    row.slack = whole, row.slackColumn = p_.cost.size();
    p_.cost.push_back(cost), p_.upper.push_back(1);
    rows_.push_back(std::move(row));
  }
  // The points that are darkest with all lamps full share one slack.
  void addDarkPoints(size_t c, const ModelZone& zone, double cost) {
    std::vector<std::pair<float, size_t>> points;
    for (size_t r = zone.first; r < zone.first + zone.count; ++r) {
      float lux = m_.baseOf(c)[r];
      for (const ChosenLamp& l : lamps_) lux += m_.column(l.option)[r];
      points.emplace_back(lux, r);
    }
    const size_t n = std::min(kDarkPoints, points.size());
    std::partial_sort(points.begin(), points.begin() + static_cast<std::ptrdiff_t>(n), points.end());
    const size_t column = p_.cost.size();
    bool any = false;
    for (size_t k = 0; k < n; ++k) {
      const size_t r = points[k].second;
      Row row = lampsRow([&](uint32_t o) { return static_cast<double>(m_.column(o)[r]); });
      row.least = zone.u0 * zone.meanLux - static_cast<double>(m_.baseOf(c)[r]);
      if (row.least <= 0) continue;
      row.slack = zone.u0 * zone.meanLux, row.slackColumn = column, any = true;
      rows_.push_back(std::move(row));
    }
    if (any) p_.cost.push_back(cost), p_.upper.push_back(1);
  }

  const Model& m_;
  search::ConstGenome design_;
  std::vector<ChosenLamp> lamps_;
  search::LinearProgram p_;
  std::vector<Row> rows_;
};

// All that is asked weighs together, as in Judge of evaluate.cpp.
double weightOfGoals(const Model& m) {
  double sum = 0;
  for (const ModelCondition& c : m.conditions) {
    for (const uint32_t z : c.zones) sum += c.weight * m.zones[z].weight * ((m.zones[z].meanLux > 0) + (m.zones[z].u0 > 0));
    sum += c.weight * static_cast<double>(c.eyes.size() + c.ratios.size());
  }
  return sum;
}

double weightOf(const Model& m, const search::Wish& wish, Objective objective) {
  for (size_t k = 0; k < m.objectives.size(); ++k) {
    if (m.objectives[k] == objective) return wish.weights[k];
  }
  return 0;
}

std::vector<double> ugrNow(const Model& m, std::span<const ChosenLamp> lamps, search::ConstGenome design, size_t c) {
  std::vector<double> out;
  for (size_t e = 0; e < m.eyes.size(); ++e) {
    double glare = m.baseGlare[c * m.eyes.size() + e], background = static_cast<double>(m.baseOf(c)[m.firstEye + e]);
    for (const ChosenLamp& l : lamps) {
      const double d = dimmingOf(m, design, l, c);
      glare += d * d * m.glare[l.option * m.eyes.size() + e], background += d * static_cast<double>(m.column(l.option)[m.firstEye + e]);
    }
    out.push_back(glare > 0 && background > 0 ? std::max(0.0, 8 * std::log10(0.25 * glare / background)) : 0);
  }
  return out;
}

// Lamps of the design, with those that are off: dimming may light them.
std::vector<ChosenLamp> hungLamps(const Model& m, search::ConstGenome design) {
  std::vector<ChosenLamp> out;
  for (size_t p = 0; p < m.places(); ++p) {
    if (design.integers[p] > 0) out.push_back({static_cast<uint32_t>(p), m.firstOption[p] + static_cast<uint32_t>(design.integers[p]) - 1});
  }
  return out;
}

}  // namespace

size_t polish(const Model& m, search::Genome design, const search::Wish& wish) {
  const double ofMiss = weightOf(m, wish, Objective::TargetMiss), ofEnergy = weightOf(m, wish, Objective::Energy), goals = weightOfGoals(m);
  const double ofCost = weightOf(m, wish, Objective::Cost), ofFittings = weightOf(m, wish, Objective::Fittings);
  const std::vector<ChosenLamp> lamps = chosenLamps(m, design);
  if (lamps.empty() || !(ofMiss > 0) || !(goals > 0)) return 0;
  const double least = kLeastWeight * ofMiss;
  const size_t levels = m.levels(), programs = m.dimming == Dimming::Common ? 1 : m.conditions.size();
  size_t work = 0;
  std::vector<double> reals(design.reals.begin(), design.reals.end());
  for (size_t k = 0; k < programs; ++k) {
    const size_t first = programs == 1 ? 0 : k, end = programs == 1 ? m.conditions.size() : k + 1;
    Program program(m, design, lamps);
    std::vector<double> costs;
    for (const ChosenLamp& l : lamps) {
      double kWh = 0;
      for (size_t c = first; c < end; ++c) kWh += m.conditions[c].hours * m.options[l.option].wattsW / 1000;
      // A lamp costs its price once it is lit at all; the linear relaxation of that is a price in proportion to its light.
      const double bought = (ofCost * m.options[l.option].price + ofFittings) / static_cast<double>(programs);
      costs.push_back(std::max(ofEnergy, least) * std::max(kWh, kSame) + bought);
    }
    program.begin(costs);
    for (size_t c = first; c < end; ++c) {
      program.addGoals(c, ofMiss * 100 * m.conditions[c].weight / goals);
      program.addBounds(c, ugrNow(m, lamps, design, c));
    }
    const auto solution = program.solve();
    ++work;
    if (!solution) continue;
    for (size_t i = 0; i < lamps.size(); ++i) reals[lamps[i].place * levels + (levels == 1 ? 0 : k)] = std::clamp(solution.value().x[i], 0.0, 1.0);
  }
  std::copy(reals.begin(), reals.end(), design.reals.begin());
  return work * kEvaluationsAProgram;
}

Result<LeastWatts> leastWatts(const Model& m, search::ConstGenome design, size_t condition) {
  const std::vector<ChosenLamp> lamps = hungLamps(m, design);
  search::LinearProgram p;
  const ModelCondition& c = m.conditions[condition];
  for (const uint32_t z : c.zones) {
    if (m.zones[z].meanLux <= 0) continue;
    for (const ChosenLamp& l : lamps) p.a.values.push_back(m.means[l.option * m.zones.size() + z]);
    p.atLeast.push_back(m.zones[z].meanLux - m.baseMeans[condition * m.zones.size() + z]);
  }
  p.a.rows = p.atLeast.size(), p.a.columns = lamps.size();
  for (const ChosenLamp& l : lamps) p.cost.push_back(m.options[l.option].wattsW);
  const auto solution = search::minimise(p);
  if (!solution) return Error{solution.error()};
  return LeastWatts{solution.value().cost, solution.value().x};
}

}  // namespace roomlight::optimise
