#include "optimise/improve.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/parallel.h"
#include "optimise/dimming_program.h"
#include "optimise/evaluate.h"

namespace roomlight::optimise {
namespace {

constexpr size_t kMostEntries = 1 << 22;                                   // of a program's matrix: 32 MiB
constexpr double kLeastExponent = -2.5,
                 kExponents = 3;  // of what energy, price and number weigh against targets, powers of ten
constexpr double kSteps[] = {0.7548776662, 0.5698402910,
                             0.3819660113};  // R2 sequence (Roberts 2018), and the golden section

// Of trade-off i: even over the logarithms, from least weight on all but targets.
std::vector<double> weightsOf(const Model& m, size_t i) {
  const ObjectiveBox box = boxOf(m);
  std::vector<double> out;
  size_t others = 0;
  for (size_t k = 0; k < m.objectives.size(); ++k) {
    double weight = 1;
    if (m.objectives[k] != Objective::TargetMiss)
      weight =
          std::pow(10, kLeastExponent +
                           kExponents * std::fmod(kSteps[others++ % std::size(kSteps)] * static_cast<double>(i), 1));
    out.push_back(weight / box.reference[k]);
  }
  return out;
}

std::vector<ChosenLamp> everyLamp(const Model& m) {
  std::vector<ChosenLamp> out;
  for (uint32_t p = 0; p < m.places(); ++p) {
    for (uint32_t o = m.firstOption[p]; o < m.firstOption[p + 1]; ++o) out.push_back({p, o});
  }
  return out;
}

DimmingProgram programOf(const Model& m, const std::vector<ChosenLamp>& lamps, const search::Wish& wish) {
  DimmingProgram program(m, lamps, {0, m.conditions.size(), m.levels() == 1});
  const LinearWeights weights = linearWeights(m, wish);
  program.addCosts(weights, 1);
  program.addGoals(weights);
  program.addRatios();
  program.addLimits();
  return program;
}

// At each place hangs the lamp that is lit most, with the light of all that the program put there. `levels`: of every
// option, those of the first condition first.
void roundOff(const Model& m, const std::vector<double>& levels, search::Genome design) {
  const size_t conditions = m.levels(), options = m.options.size();
  for (size_t p = 0; p < m.places(); ++p) {
    size_t most = m.firstOption[p];
    double mostLit = 0;
    std::vector<double> ofPlace(conditions, 0);
    for (size_t o = m.firstOption[p]; o < m.firstOption[p + 1]; ++o) {
      double lit = 0;
      for (size_t c = 0; c < conditions; ++c) lit += levels[c * options + o], ofPlace[c] += levels[c * options + o];
      if (lit > mostLit) mostLit = lit, most = o;
    }
    if (mostLit <= kOff) continue;
    design.integers[p] = static_cast<int32_t>(most - m.firstOption[p]) + 1;
    for (size_t c = 0; c < conditions; ++c) design.reals[p * conditions + c] = std::min(1.0, ofPlace[c]);
  }
}

}  // namespace

RelaxedDesigns relaxedDesigns(const Model& m, size_t count) {
  RelaxedDesigns out;
  out.designs.integersEach = m.places(), out.designs.realsEach = m.places() * m.levels();
  const bool targets = std::find(m.objectives.begin(), m.objectives.end(), Objective::TargetMiss) != m.objectives.end();
  if (m.levels() == 0 || !targets || !(weightOfGoals(m) > 0)) return out;
  const std::vector<ChosenLamp> lamps = everyLamp(m);
  const std::vector<double> unknown(m.objectives.size(), 0), any = weightsOf(m, 0);
  if (programOf(m, lamps, {any, unknown}).entries() > kMostEntries) return out;
  out.designs.resize(count);
  std::vector<size_t> costs(count);
  parallelFor(count, 1, [&](size_t i) {
    const std::vector<double> weights = weightsOf(m, i);
    const search::Wish wish{weights, unknown};
    const DimmingProgram program = programOf(m, lamps, wish);
    const Result<std::vector<double>> levels = program.solve();
    costs[i] = program.costOfSolving();
    if (!levels) return;
    roundOff(m, levels.value(), out.designs[i]);
    repair(m, out.designs[i]);
    costs[i] += polish(m, out.designs[i], wish);
  });
  out.evaluations = std::accumulate(costs.begin(), costs.end(), size_t{0});
  return out;
}

}  // namespace roomlight::optimise
