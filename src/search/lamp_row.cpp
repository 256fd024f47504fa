// The test problem nearest to what the search is for: lamps along a line, light from a matrix, dimming by the reals.
#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <numeric>

#include "base/parallel.h"
#include "search/dimming.h"
#include "search/test_problems.h"

namespace roomlight::search {
namespace {

constexpr size_t kLamps = 8, kPlaces = 24, kKinds = 3, kAlong = 24, kAcross = 8, kPoints = kAlong * kAcross;
constexpr double kTargetLux = 100, kHeightM = 2.4, kLengthM = 12, kPi = 3.14159265358979323846;

struct Kind {
  double watts, fluxLm, beam;  // intensity falls as cos^beam
};
constexpr std::array<Kind, kKinds> kKindTable{{{8, 600, 1}, {18, 1500, 1}, {11, 1000, 6}}};

struct Row {
  DenseMatrix lux{
      kPlaces * kKinds, kPoints, {}};  // a row each candidate at full power, a column each point; shares of the target
  NormalEquations all;  // of every candidate: those of a design are picked from it
};

Row makeRow() {
  Row row;
  row.lux.values.resize(row.lux.rows * row.lux.columns);
  DenseMatrix byPoint{kPoints, row.lux.rows, std::vector<double>(row.lux.values.size())};
  for (size_t c = 0; c < row.lux.rows; ++c) {
    const Kind& kind = kKindTable[c % kKinds];
    const double xLamp = (static_cast<double>(c / kKinds) + 0.5) * kLengthM / kPlaces;
    for (size_t p = 0; p < kPoints; ++p) {
      const double dx = (static_cast<double>(p % kAlong) + 0.5) * kLengthM / kAlong - xLamp,
                   dy = (static_cast<double>(p / kAlong) - 3.5) * kLengthM / kAlong;
      const double squareM2 = dx * dx + dy * dy + kHeightM * kHeightM, cosine = kHeightM / std::sqrt(squareM2);
      const double intensityCd = kind.fluxLm * (kind.beam + 1) / (2 * kPi) * std::pow(cosine, kind.beam);
      byPoint.values[p * row.lux.rows + c] = row.lux.values[c * kPoints + p] =
          intensityCd * cosine / squareM2 / kTargetLux;
    }
  }
  row.all = normalEquations(byPoint, std::vector<double>(kPoints, 1.0));
  return row;
}

size_t candidate(ConstGenome d, size_t lamp) {
  return static_cast<size_t>(d.integers[2 * lamp]) * kKinds + static_cast<size_t>(d.integers[2 * lamp + 1]);
}

void evaluateOne(const Row& row, ConstGenome d, std::span<double> f) {
  std::array<double, kPoints> shares{};
  f[0] = 0;
  for (size_t lamp = 0; lamp < kLamps; ++lamp) {
    const size_t c = candidate(d, lamp);
    const double dim = d.reals[lamp];
    f[0] += dim * kKindTable[c % kKinds].watts;
    const double* full = &row.lux.values[c * kPoints];
    for (size_t p = 0; p < kPoints; ++p) shares[p] += dim * full[p];
  }
  double squares = 0;
  for (double share : shares) squares += (share - 1) * (share - 1);
  f[1] = std::sqrt(squares / kPoints);
}

// Lamps in order of their places; of two in one place the later moves on, and back from the end.
void repairOne(Genome d) {
  std::array<size_t, kLamps> order;
  std::iota(order.begin(), order.end(), size_t{0});
  std::array<int32_t, 2 * kLamps> integers;
  std::array<double, kLamps> dims;
  std::copy(d.integers.begin(), d.integers.end(), integers.begin());
  std::copy(d.reals.begin(), d.reals.end(), dims.begin());
  std::stable_sort(order.begin(), order.end(), [&](size_t a, size_t b) { return integers[2 * a] < integers[2 * b]; });
  for (size_t i = 0; i < kLamps; ++i) {
    d.integers[2 * i] = integers[2 * order[i]], d.integers[2 * i + 1] = integers[2 * order[i] + 1],
                   d.reals[i] = dims[order[i]];
    if (i > 0) d.integers[2 * i] = std::max(d.integers[2 * i], d.integers[2 * i - 2] + 1);
  }
  for (size_t i = kLamps; i-- > 0;)
    d.integers[2 * i] = std::min(d.integers[2 * i], static_cast<int32_t>(kPlaces - kLamps + i));
}

// w0 watts + w1 rms: a root is at most its tangent, rms <= squares / (2 rms0) + rms0 / 2, which makes it a
// least-squares problem with a price on watts.
size_t polishOne(const Row& row, Genome d, const Wish& wish) {
  NormalEquations own;
  own.columns = kLamps;
  own.g.resize(kLamps * kLamps), own.h.resize(kLamps);
  const double pricePerWatt = wish.weights[0] / wish.weights[1] * wish.objectives[1] * kPoints;
  for (size_t i = 0; i < kLamps; ++i) {
    const size_t c = candidate(d, i);
    own.h[i] = row.all.h[c] - pricePerWatt * kKindTable[c % kKinds].watts;
    for (size_t j = 0; j < kLamps; ++j) own.g[i * kLamps + j] = row.all.g[c * row.all.columns + candidate(d, j)];
  }
  minimiseSquares(own, {}, d.reals);
  return 3;  // takes about as long as three evaluations
}

}  // namespace

TestProblem lampRow() {
  const auto row = std::make_shared<const Row>(makeRow());
  Problem problem;
  for (int32_t lamp = 0; lamp < static_cast<int32_t>(kLamps); ++lamp) {
    problem.integers.push_back({.cardinality = kPlaces, .ordered = true, .group = lamp});
    problem.integers.push_back({.cardinality = kKinds, .ordered = false, .group = lamp});
    problem.reals.push_back({.group = lamp});
  }
  problem.evaluate = [row](const Genomes& designs, std::span<double> out) {
    parallelFor(designs.count, 64, [&](size_t i) { evaluateOne(*row, designs[i], out.subspan(2 * i, 2)); });
  };
  problem.repair = repairOne;
  problem.polish = [row](Genome d, const Wish& wish) { return polishOne(*row, d, wish); };
  return {"lamp row", std::move(problem), {100, 1}, 0, 0};
}

}  // namespace roomlight::search
