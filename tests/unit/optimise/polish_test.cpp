#include "optimise/polish.h"

#include <cmath>

#include "optimise/evaluate.h"
#include "unit/optimise/small_study.h"

namespace roomlight::optimise {
namespace {

using testing::kStudy;
using testing::replaced;
using testing::SmallProblem;

search::Genomes allLamps(const Model& m, double dimming) {
  search::Genomes out;
  out.integersEach = m.places(), out.realsEach = m.places() * m.levels();
  out.resize(1);
  for (size_t p = 0; p < m.places(); ++p) out[0].integers[p] = 1;
  for (double& d : out[0].reals) d = dimming;
  return out;
}

// One zone with one target: the exact optimum is that of the fractional knapsack, lamps in the order of lux a watt.
TEST(Polish, LeastWattsAreThoseOfTheMostEfficientLamps) {
  const SmallProblem p(replaced(kStudy, "mean = \"100 lx\"\nuniformity = 0.4", "mean = \"60 lx\""));
  const Model& m = p.model;
  const search::Genomes design = allLamps(m, 1);
  std::vector<std::pair<double, double>> lamps;  // lux a watt, watts
  for (size_t place = 0; place < m.places(); ++place) {
    const size_t o = m.firstOption[place];
    lamps.emplace_back(m.means[o] / m.options[o].wattsW, m.options[o].wattsW);
  }
  std::sort(lamps.rbegin(), lamps.rend());
  double left = 60 - m.baseMeans[0], watts = 0;
  for (const auto& [perWatt, w] : lamps) {
    const double part = std::min(1.0, left / (perWatt * w));
    watts += part * w, left -= part * perWatt * w;
    if (left <= 1e-12) break;
  }
  ASSERT_LE(left, 1e-9);
  const auto found = leastWatts(m, design[0], 0);
  ASSERT_TRUE(found) << found.error();
  EXPECT_NEAR(found.value().wattsW, watts, 1e-6 * watts);

  // Polished with all weight on the target, the design is as frugal.
  search::Genomes polished = allLamps(m, 0.7);
  const std::vector<double> weights = {1, 1e-4, 0}, objectives = {0, 0, 0};
  EXPECT_GT(polish(m, polished[0], {weights, objectives}), 0u);
  const DesignResult r = resultOf(m, polished[0]);
  EXPECT_NEAR(r.conditions[0].wattsW, watts, 0.01 * watts);
  EXPECT_GE(r.conditions[0].zones[0].meanLux, 60 * 0.9999);
}

TEST(Polish, SaysWhatCannotBeReached) {
  const SmallProblem p(replaced(kStudy, "mean = \"100 lx\"", "mean = \"9000 lx\""));
  EXPECT_FALSE(leastWatts(p.model, allLamps(p.model, 1)[0], 0));
}

TEST(Polish, NeverMakesTheWeightedSumWorseWhereGoalsAreMeans) {
  const SmallProblem p(replaced(kStudy, "mean = \"100 lx\"\nuniformity = 0.4", "mean = \"100 lx\""));
  const Model& m = p.model;
  for (const double miss : {1.0, 0.3, 0.01}) {
    for (const double dimming : {0.05, 0.4, 1.0}) {
      search::Genomes design = allLamps(m, dimming);
      const DesignResult before = resultOf(m, design[0]);
      const std::vector<double> weights = {miss / 100, (1 - miss) / 50 + 1e-6, 0}, objectives = {before.missPercent, before.kWhPerYear, before.cost};
      polish(m, design[0], {weights, objectives});
      const DesignResult after = resultOf(m, design[0]);
      EXPECT_LE(weights[0] * after.missPercent + weights[1] * after.kWhPerYear, weights[0] * before.missPercent + weights[1] * before.kWhPerYear + 1e-9);
      for (const double d : design[0].reals) EXPECT_TRUE(d >= 0 && d <= 1);
    }
  }
}

TEST(Polish, KeepsGlareWhereItIsOrBelowItsLimit) {
  const SmallProblem p;
  const Model& m = p.model;
  search::Genomes design = allLamps(m, 0.2);
  const double before = resultOf(m, design[0]).conditions[0].ugr[0];
  const std::vector<double> weights = {1, 1e-6, 0}, objectives = {0, 0, 0};
  polish(m, design[0], {weights, objectives});
  EXPECT_LE(resultOf(m, design[0]).conditions[0].ugr[0], std::max(before, 19.0) + 1e-6);
}

}  // namespace
}  // namespace roomlight::optimise
