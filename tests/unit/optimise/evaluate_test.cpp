#include "optimise/evaluate.h"

#include <cmath>

#include "base/parallel.h"
#include "base/random.h"
#include "optimise/improve.h"
#include "photometry/colour_temperature.h"
#include "search/search.h"
#include "unit/optimise/small_study.h"

namespace roomlight::optimise {
namespace {

using testing::kStudy;
using testing::replaced;
using testing::SmallProblem;

// Any designs at all, most of which break something.
search::Genomes anyDesigns(const Model& m, size_t count) {
  search::Genomes out = testing::darkDesigns(m, count);
  Rng random(1, 2, 3);
  for (size_t i = 0; i < count; ++i) {
    for (size_t p = 0; p < m.places(); ++p)
      out[i].integers[p] =
          static_cast<int32_t>(random.uniform() * static_cast<float>(m.firstOption[p + 1] - m.firstOption[p] + 1));
    for (double& d : out[i].reals) d = static_cast<double>(random.uniform());
  }
  return out;
}

const std::string kTwoConditions =
    replaced(kStudy, "hours = 1000\n",
             "hours = 1000\n[[condition]]\nname = \"day\"\nweight = 3\nhours = 500\ndaylight = { sky = \"overcast\", "
             "horizontalIlluminance = \"8 klx\" }\n");

// By the definitions, in the plainest way, from the response itself.
TEST(Evaluate, IsWhatTheDefinitionsSay) {
  const SmallProblem p(kTwoConditions);
  const Model& m = p.model;
  const search::Genomes designs = anyDesigns(m, 20);
  std::vector<double> objectives(designs.count * 3);
  evaluateAll(m, designs, objectives);
  for (size_t i = 0; i < designs.count; ++i) {
    double miss = 0, weights = 0, kWh = 0, cost = 0;
    for (const size_t c : {0u, 1u}) {
      const double weight = c ? 3 : 1;
      std::vector<double> lux(p.meters.elements.size());
      for (size_t e = 0; e < lux.size(); ++e) lux[e] = static_cast<double>(luminance(p.response.base[c].lux[e]));
      double glare = 0, direct = 0;
      for (size_t place = 0; place < m.places(); ++place) {
        const int32_t choice = designs[i].integers[place];
        const double d = designs[i].reals[place * 2 + c] < 0.005 ? 0 : designs[i].reals[place * 2 + c];
        if (choice == 0) continue;
        const LampOption& o = p.candidates.options[p.candidates.firstOption[place] + static_cast<size_t>(choice) - 1];
        const Luminaire& l = p.file.study().catalogue.luminaires[p.candidates.candidates[o.candidate].luminaire];
        for (size_t e = 0; e < lux.size(); ++e)
          lux[e] += d * static_cast<double>(luminance(p.response.of(o.candidate)[e] * blackBodyColour(o.kelvin)));
        glare += d * d * p.response.glareOf(o.candidate)[0].term,
            direct += d * p.response.glareOf(o.candidate)[0].directLux;
        kWh += d * l.wattsW * (c ? 500 : 1000) / 1000;
        if (c == 0) cost += l.price;
      }
      double sum = 0, least = 1e30;
      for (size_t e = 0; e < p.meters.points(); ++e) sum += lux[e], least = std::min(least, lux[e]);
      const double mean = sum / static_cast<double>(p.meters.points()),
                   background = (lux[p.meters.firstEye] - direct) / 3.14159265;
      const double ugr = glare > 0 ? std::max(0.0, 8 * std::log10(0.25 * glare / background)) : 0;
      for (const double term : {1 - mean / 100, 1 - least / mean / 0.4, ugr / 19 - 1})
        miss += weight * std::clamp(term, 0.0, 1.0), weights += weight;
    }
    EXPECT_NEAR(objectives[3 * i], 100 * miss / weights, 1e-3) << i;
    EXPECT_NEAR(objectives[3 * i + 1], kWh, 1e-6) << i;
    EXPECT_NEAR(objectives[3 * i + 2], cost, 1e-9) << i;
    const DesignResult r = resultOf(m, designs[i]);
    EXPECT_DOUBLE_EQ(r.missPercent, objectives[3 * i]);
    EXPECT_DOUBLE_EQ(r.kWhPerYear, objectives[3 * i + 1]);
  }
}

TEST(Evaluate, ALampThatIsNeverLitIsNotBought) {
  const SmallProblem p;
  search::Genomes designs = anyDesigns(p.model, 1);
  for (int32_t& i : designs.integers) i = 1;
  for (double& d : designs.reals) d = 0.5;
  const size_t all = resultOf(p.model, designs[0]).fittings;
  designs[0].reals[2] = 0;
  EXPECT_EQ(resultOf(p.model, designs[0]).fittings, all - 1);
}

TEST(Evaluate, StandbyCountsForTheHoursOff) {
  testing::SmallStudy s;
  const SmallProblem p;
  Model m = p.model;
  for (ModelOption& o : m.options) o.standbyW = 1;
  search::Genomes designs = anyDesigns(m, 1);
  for (int32_t& i : designs.integers) i = 0;
  designs[0].integers[0] = 1, designs[0].reals[0] = 1;
  EXPECT_NEAR(resultOf(m, designs[0]).kWhPerYear, m.options[0].wattsW * 1000 / 1000 + 7.76, 1e-9);
}

TEST(Evaluate, DoesNotDependOnTheNumberOfThreads) {
  const SmallProblem p(kTwoConditions);
  const search::Genomes designs = anyDesigns(p.model, 200);
  std::vector<double> one(designs.count * 3), many(designs.count * 3);
  withThreads(1, [&] { evaluateAll(p.model, designs, one); });
  withThreads(4, [&] { evaluateAll(p.model, designs, many); });
  EXPECT_EQ(one, many);
}

TEST(Repair, LeavesNothingBrokenAndGoodDesignsAlone) {
  const SmallProblem p(replaced(
      replaced(kStudy, "apart = 0.5", "apart = 1.8\nmost = 3") + "[limits]\nwatts = 26\ncost = 120\nfittings = 4\n",
      "spacing = 1.5", "spacing = 0.7"));
  search::Genomes designs = anyDesigns(p.model, 300);
  size_t broken = 0;
  for (size_t i = 0; i < designs.count; ++i) {
    broken += !brokenBy(p.model, designs[i]).empty();
    repair(p.model, designs[i]);
    EXPECT_EQ(brokenBy(p.model, designs[i]), "");
    const std::vector<int32_t> once(designs[i].integers.begin(), designs[i].integers.end());
    repair(p.model, designs[i]);
    EXPECT_EQ(std::vector<int32_t>(designs[i].integers.begin(), designs[i].integers.end()), once);
    EXPECT_FALSE(chosenLamps(p.model, designs[i]).empty());
  }
  EXPECT_GT(broken, 250u);
}

// Dimming helps targets alone: without them there is nothing to polish, and no evaluation is spent on it.
TEST(Search, WithoutTargetsNothingIsPolished) {
  const SmallProblem p(replaced(kStudy, "\"targetMiss\", \"energy\"", "\"uniformity\", \"energy\""));
  const search::Problem problem = problemOf(p.model);
  EXPECT_FALSE(problem.polish);
  search::State state = search::start(problem, {.evaluations = 400, .population = 40});
  search::run(problem, state);
  EXPECT_EQ(state.polished, 0u);
}

TEST(Search, DesignsByChanceHaveFewLampsTooAndAreOthersInEachGeneration) {
  const SmallProblem p;
  const search::Problem problem = problemOf(p.model);
  const search::Genomes one = problem.draw(40, 1, 0), again = problem.draw(40, 1, 0), next = problem.draw(40, 1, 1);
  EXPECT_EQ(one.integers, again.integers);
  EXPECT_NE(one.integers, next.integers);
  const auto lamps = [&](size_t i) { return chosenLamps(p.model, one[i]).size(); };
  EXPECT_LE(lamps(0), 2u);
  EXPECT_EQ(lamps(39), p.model.places());
}

// The table of objectives, the results of designs and the box know the same ones.
TEST(Box, EveryObjectiveHasAResultAndAWorst) {
  SmallProblem p;
  DesignResult result;
  result.missPercent = 1, result.unevenness = 2, result.glare = 3, result.kWhPerYear = 4, result.cost = 5,
  result.fittings = 6;
  double sum = 0;
  for (const ObjectiveInfo& o : objectiveTable()) {
    p.model.objectives = {o.objective};
    EXPECT_GT(boxOf(p.model).reference.at(0), 0.1) << o.name;
    EXPECT_GT(result.of(o.objective), 0) << o.name;
    sum += result.of(o.objective);
  }
  EXPECT_EQ(sum, 1 + 2 + 3 + 4 + 5 + 6);
}

// Designs on a limit still count.
TEST(Box, ReachesBeyondLimitsAndHoldsStandby) {
  const SmallProblem p(std::string(kStudy) + "[limits]\nwatts = 30\ncost = 200\n");
  Model m = p.model;
  const ObjectiveBox without = boxOf(m);
  EXPECT_NEAR(without.reference[1], 1.1 * 30 * 1000 / 1000, 1e-9);
  EXPECT_NEAR(without.reference[2], 1.1 * 200, 1e-9);
  for (ModelOption& o : m.options) o.standbyW = 1;
  EXPECT_NEAR(boxOf(m).reference[1], without.reference[1] + 1.1 * 8.76 * static_cast<double>(m.places()), 1e-9);
}

TEST(Box, OfFourObjectivesManyPointsAreThinned) {
  SmallProblem p;
  p.model.objectives = {Objective::TargetMiss, Objective::Energy, Objective::Cost, Objective::Fittings};
  const ObjectiveBox box = boxOf(p.model);
  search::Archive front;
  front.objectivesEach = 4, front.designs.count = kHypervolumePoints + 50;
  for (size_t i = 0; i < front.size(); ++i) {
    const double x = static_cast<double>(i) / static_cast<double>(front.size());
    for (const double share : {x, 1 - x, 0.5, 0.5})
      front.objectives.push_back(share * box.reference[front.objectives.size() % 4]);
  }
  // Steps below the line x + y = 1: a half of two objectives, a half of each other.
  EXPECT_NEAR(hypervolumeOf(p.model, front), 0.125, 0.005);
}

TEST(Search, TheSameSeedGivesTheSameFrontAndAnotherAnother) {
  const SmallProblem p;
  const search::Problem problem = problemOf(p.model);
  const auto front = [&](uint64_t seed, int threads) {
    search::State state;
    withThreads(threads, [&] {
      state = search::start(problem, {.seed = seed, .evaluations = 2000, .population = 40},
                            sparseDesigns(p.model, 40, seed));
      search::run(problem, state);
    });
    return state.archive.objectives;
  };
  const auto one = front(1, 1);
  EXPECT_EQ(one, front(1, 3));
  EXPECT_NE(one, front(2, 1));
  EXPECT_GT(one.size(), 20u);
}

}  // namespace
}  // namespace roomlight::optimise
