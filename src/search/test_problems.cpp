#include "search/test_problems.h"

#include <algorithm>
#include <cmath>

#include "base/parallel.h"

namespace roomlight::search {
namespace {

constexpr size_t kGrain = 64;
constexpr double kPi = 3.14159265358979323846;

// Of one design at a time.
using One = void (*)(ConstGenome, std::span<double>);

Problem realProblem(size_t reals, size_t objectives, One one) {
  Problem problem;
  problem.reals.resize(reals);
  problem.objectives = objectives;
  problem.evaluate = [one, objectives](const Genomes& designs, std::span<double> out) {
    parallelFor(designs.count, kGrain, [&](size_t i) { one(designs[i], out.subspan(i * objectives, objectives)); });
  };
  return problem;
}

double zdtG(std::span<const double> x) {
  double sum = 0;
  for (size_t i = 1; i < x.size(); ++i) sum += x[i];
  return 1 + 9 * sum / static_cast<double>(x.size() - 1);
}

// What the second objective is of g, with x the first.
double convex(double x, double g) { return 1 - std::sqrt(x / g); }
double concave(double x, double g) { return 1 - x / g * (x / g); }
double broken(double x, double g) { return convex(x, g) - x / g * std::sin(10 * kPi * x); }

template <double (*shape)(double x, double g)>
TestProblem zdt(const char* name, double bestHypervolume, double askedHypervolume) {
  Problem problem = realProblem(30, 2, [](ConstGenome d, std::span<double> f) {
    const double g = zdtG(d.reals);
    f[0] = d.reals[0], f[1] = g * shape(d.reals[0], g);
  });
  return {name, std::move(problem), {1.1, 1.1}, bestHypervolume, askedHypervolume};
}

constexpr int32_t kCategories = 10, kValues = 6;

int32_t rightValue(size_t category) { return static_cast<int32_t>((category * 7 + 3) % kValues); }
double rightReal(size_t real, int32_t value) {
  return (static_cast<double>((real * 3 + static_cast<size_t>(value) * 5) % 11) + 0.5) / 11;
}

double mixedG(ConstGenome d) {
  double sum = 0;
  for (size_t i = 0; i < d.integers.size(); ++i) sum += d.integers[i] != rightValue(i);
  for (size_t i = 1; i < d.reals.size(); ++i) sum += std::abs(d.reals[i] - rightReal(i, d.integers[i]));
  return 1 + 9 * sum / static_cast<double>(d.integers.size() + d.reals.size() - 1);
}

}  // namespace

TestProblem zdt1() { return zdt<convex>("ZDT1", 0.8767, 0.870); }   // 1.21 - 1/3
TestProblem zdt2() { return zdt<concave>("ZDT2", 0.5433, 0.536); }  // 1.21 - 2/3
TestProblem zdt3() { return zdt<broken>("ZDT3", 1.3318, 0); }

TestProblem dtlz2() {
  return {"DTLZ2",
          realProblem(12, 3,
                      [](ConstGenome d, std::span<double> f) {
                        double g = 1;
                        for (size_t i = 2; i < d.reals.size(); ++i) g += (d.reals[i] - 0.5) * (d.reals[i] - 0.5);
                        const double a = d.reals[0] * kPi / 2, b = d.reals[1] * kPi / 2;
                        f[0] = g * std::cos(a) * std::cos(b), f[1] = g * std::cos(a) * std::sin(b),
                        f[2] = g * std::sin(a);
                      }),
          {1.1, 1.1, 1.1},
          0.8074,
          0.78};  // 1.331 - pi/6
}

TestProblem mixedZdt1() {
  Problem problem = realProblem(kCategories, 2, [](ConstGenome d, std::span<double> f) {
    const double g = mixedG(d);
    f[0] = d.reals[0], f[1] = g * convex(d.reals[0], g);
  });
  for (int32_t i = 0; i < kCategories; ++i) {
    problem.integers.push_back({.cardinality = kValues, .ordered = false, .group = i});
    problem.reals[static_cast<size_t>(i)].group = i;
  }
  problem.polish = [](Genome d, const Wish& wish) -> size_t {
    for (size_t i = 1; i < d.reals.size(); ++i) d.reals[i] = rightReal(i, d.integers[i]);
    // w0 x + w1 (g - sqrt(g x)) is least at x = g (w1 / (2 w0))².
    const double ratio = wish.weights[1] / (2 * std::max(wish.weights[0], 1e-9));
    d.reals[0] = std::min(1.0, mixedG(d) * ratio * ratio);
    return 1;
  };
  return {"mixed ZDT1", std::move(problem), {1.1, 1.1}, 0.8767, 0};
}

}  // namespace roomlight::search
