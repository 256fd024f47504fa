#include "optimise/improve.h"

#include <algorithm>
#include <cmath>

#include "optimise/evaluate.h"
#include "unit/optimise/small_study.h"

namespace roomlight::optimise {
namespace {

using testing::kStudy;
using testing::replaced;
using testing::SmallProblem;

search::Genomes allLamps(const Model& m, double dimming) {
  search::Genomes out = testing::darkDesigns(m, 1);
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
      const std::vector<double> weights = {miss / 100, (1 - miss) / 50 + 1e-6, 0},
                                objectives = {before.missPercent, before.kWhPerYear, before.cost};
      polish(m, design[0], {weights, objectives});
      const DesignResult after = resultOf(m, design[0]);
      EXPECT_LE(weights[0] * after.missPercent + weights[1] * after.kWhPerYear,
                weights[0] * before.missPercent + weights[1] * before.kWhPerYear + 1e-9);
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

// A single lamp that would be over the limit at full light, alone at night.
class GlaringLamp : public ::testing::Test {
 protected:
  GlaringLamp() : problem_(replaced(kStudy, "uniformity = 0.4\n", "")), model_(problem_.model) {
    for (double& g : model_.glare) g *= 300;
  }
  double ugrAt(double dimming) const { return resultOf(model_, oneLamp(dimming)[0]).conditions[0].ugr[0]; }
  search::Genomes oneLamp(double dimming) const {
    search::Genomes out = testing::darkDesigns(model_, 1);
    out[0].integers[0] = 1, out[0].reals[0] = dimming;
    return out;
  }
  double polished(double dimming) const {
    search::Genomes design = oneLamp(dimming);
    const std::vector<double> weights = {1, 1e-6, 1e-6}, objectives = {0, 0, 0};
    polish(model_, design[0], {weights, objectives});
    return design[0].reals[0];
  }
  SmallProblem problem_;
  Model model_;
};

TEST_F(GlaringLamp, IsLitUpToItsLimitAndNotTurnedOff) {
  ASSERT_GT(ugrAt(1), 20);
  ASSERT_LT(ugrAt(0.02), 19);
  const double d = polished(0.02);
  EXPECT_GT(d, 0.02);
  EXPECT_NEAR(ugrAt(d), 19, 0.01);
}

TEST_F(GlaringLamp, IsDimmedToItsLimitWhereThatMissesLess) {
  const double d = polished(1);
  EXPECT_GT(d, kOff);
  EXPECT_LE(resultOf(model_, oneLamp(d)[0]).missPercent, resultOf(model_, oneLamp(1)[0]).missPercent + 1e-9);
}

TEST(Polish, LampsThatCannotBeDimmedAreOnOrOffAndTheOthersMakeUpForIt) {
  const SmallProblem p(replaced(kStudy, "mean = \"100 lx\"\nuniformity = 0.4", "mean = \"40 lx\""));
  Model m = p.model;
  for (uint32_t o = m.firstOption[0]; o < m.firstOption[1]; ++o) m.options[o].dimmable = false;
  search::Genomes design = allLamps(m, 0.7);
  const std::vector<double> weights = {1, 1e-4, 0}, objectives = {0, 0, 0};
  EXPECT_GT(polish(m, design[0], {weights, objectives}), 0u);
  EXPECT_TRUE(design[0].reals[0] < 1e-6 || design[0].reals[0] > 1 - 1e-6) << design[0].reals[0];
  EXPECT_GE(resultOf(m, design[0]).conditions[0].zones[0].meanLux, 40 * 0.999);
}

// Of as many designs by chance, repaired.
double leastMissByChance(const Model& m, size_t count) {
  search::Genomes chance = sparseDesigns(m, count, 1);
  double least = 100;
  for (size_t i = 0; i < count; ++i) repair(m, chance[i]), least = std::min(least, resultOf(m, chance[i]).missPercent);
  return least;
}

void expectGoodFirstDesigns(const Model& m) {
  constexpr size_t kDesigns = 16;
  const RelaxedDesigns relaxed = relaxedDesigns(m, kDesigns);
  ASSERT_EQ(relaxed.designs.count, kDesigns);
  EXPECT_GT(relaxed.evaluations, kDesigns);
  double least = 100;
  for (size_t i = 0; i < kDesigns; ++i) {
    EXPECT_EQ(brokenBy(m, relaxed.designs[i]), "") << i;
    least = std::min(least, resultOf(m, relaxed.designs[i]).missPercent);
  }
  EXPECT_LE(least, leastMissByChance(m, kDesigns));
}

TEST(Relaxation, GivesDesignsThatHoldAllLimitsAndMissLessThanChanceDoes) {
  const SmallProblem p(replaced(kStudy, "spacing = 1.5", "spacing = 0.6\nmost = 4") +
                       "[limits]\ncost = 200\nwatts = 50\nfittings = 5\n");
  expectGoodFirstDesigns(p.model);
}

TEST(Relaxation, BuysALampOnceForAllConditions) {
  const SmallProblem p(replaced(kStudy, "hours = 1000\n",
                                "hours = 1000\n[[condition]]\nname = \"dusk\"\ndaylight = \"none\"\nhours = 500\n") +
                       "[limits]\ncost = 200\nfittings = 5\n");
  ASSERT_EQ(p.model.levels(), 2u);
  expectGoodFirstDesigns(p.model);
}

}  // namespace
}  // namespace roomlight::optimise
