// Linear programs over how far lamps are dimmed: what polish.cpp and relaxation.cpp are made of.
#pragma once

#include "optimise/model.h"
#include "search/dimming.h"

namespace roomlight::optimise {

// What a unit weighs of each objective that lamps move in proportion to their light.
struct LinearWeights {
  double miss = 0, energy = 0, cost = 0, fittings = 0;
};
LinearWeights linearWeights(const Model& model, const search::Wish& wish);

// All that is asked together, as the judge of evaluate.cpp weighs it.
double weightOfGoals(const Model& model);

// Columns: a level of each lamp, 0 to 1, in each condition or one for all; then, where levels are of conditions apart,
// how far each lamp is bought, which is no less than any of its levels; then how far goals are missed, as shares of
// them.
class DimmingProgram {
 public:
  struct Scope {
    size_t first = 0, end = 1;  // conditions
    bool alike = true;          // each lamp has one level in all of them
  };
  DimmingProgram(const Model& model, std::vector<ChosenLamp> lamps, Scope scope);

  // Energy, and this share of price and number, both in proportion to light: the linear relaxation of buying a lamp or
  // not.
  void addCosts(const LinearWeights& weights, double share);
  // What is missed of mean illuminance, and of uniformity at the darkest points.
  void addGoals(const LinearWeights& weights);
  // Luminance ratios stay below their limits, where they are without lamps.
  void addRatios();
  // What must hold of lamps together: cost, watts, fittings, lamps of a rule, distances; a place has the light of one
  // lamp at most.
  void addLimits();
  // A lamp is off, or on in full.
  void fix(size_t lamp, bool on);
  // Σ L² ω / p² <= most · background is convex in the levels: its tangent at these levels, which leaves out nothing
  // that keeps it.
  void addGlareCut(size_t condition, size_t eye, double most, std::span<const double> levels);

  // Levels of lamps; of conditions apart, those of the first come first.
  Result<std::vector<double>> solve() const;
  // In evaluations of a design.
  size_t costOfSolving() const;
  size_t entries() const { return rows_.size() * costs_.size(); }

 private:
  struct Row {
    std::vector<std::pair<size_t, double>> terms;  // column, factor
    double least = -search::kUnbounded, most = search::kUnbounded;
  };
  size_t level(size_t lamp, size_t condition) const {
    return scope_.alike ? lamp : (condition - scope_.first) * lamps_.size() + lamp;
  }
  size_t bought(size_t lamp) const { return firstBought_ + lamp; }
  size_t addColumn(double cost);
  template <class Value>
  Row lampsRow(size_t condition, const Value& value) const;
  template <class Value>
  void addLimit(double most, const Value& value);
  void addMean(size_t condition, size_t zone, double costOfMiss);
  void addDarkPoints(size_t condition, const ModelZone& zone, double costOfMiss);

  const Model& m_;
  std::vector<ChosenLamp> lamps_;
  Scope scope_;
  size_t firstBought_ = 0;  // the levels themselves where there is one of each lamp
  std::vector<double> costs_;
  std::vector<Row> rows_;
};

}  // namespace roomlight::optimise
