// Exact answers to the convex part of a design: how far to dim given lamps. Light is linear, so what points receive is
 // A x.
#pragma once

#include <limits>
#include <span>
#include <vector>

#include "base/result.h"

namespace roomlight::search {

constexpr double kUnbounded = std::numeric_limits<double>::infinity();

// Dense, row after row.
struct DenseMatrix {
  size_t rows = 0, columns = 0;
  std::vector<double> values;  // rows × columns
  std::span<const double> row(size_t i) const { return std::span(values).subspan(i * columns, columns); }
  std::span<double> row(size_t i) { return std::span(values).subspan(i * columns, columns); }
};

// Minimise cost · x subject to atLeast <= A x <= atMost, 0 <= x <= upper.
struct LinearProgram {
  DenseMatrix a;
  std::vector<double> atLeast;  // one a row; -kUnbounded: none. Empty: none anywhere
  std::vector<double> atMost;   // one a row; kUnbounded: none. Empty: none anywhere
  std::vector<double> cost;     // one a column
  std::vector<double> upper;    // one a column, kUnbounded: none. Empty: 1 everywhere
};

struct LinearSolution {
  std::vector<double> x;
  std::vector<double>
      price;  // one a row: how much the cost rises when what is asked of the row rises by one; 0 where it does not bind
  double cost = 0;
};

// Exact (simplex, Clp). Errors: infeasible (names the row that is missed most when all misses together are least),
// unbounded, sizes that do not match. Several threads may call it at once.
Result<LinearSolution> minimise(const LinearProgram& program);

// The nearest to feasible: least sum of misses over all rows, whatever it costs. Errors: sizes that do not match.
struct LeastMiss {
  std::vector<double> x;
  std::vector<double> miss;  // one a row: how far below atLeast (positive) or above atMost (negative)
  double sum = 0;  // of their sizes
};
Result<LeastMiss> leastMiss(const LinearProgram& program);

// The least-squares problem min |W^½ (A x − b)|² as its normal equations: what is needed for many bounds and starts.
struct NormalEquations {
  size_t columns = 0;
  std::vector<double> g;  // AᵀWA, columns × columns
  std::vector<double> h;  // AᵀWb
  double constant = 0;  // bᵀWb, so that the miss is xᵀGx − 2 hᵀx + constant
};

// weights: one a row, >= 0; empty: 1 everywhere. Costs rows × columns².
NormalEquations normalEquations(const DenseMatrix& a, std::span<const double> b, std::span<const double> weights = {});

// Σ (A x − b)² weights at x.
double missOf(const NormalEquations& equations, std::span<const double> x);

// Minimises xᵀGx − 2 hᵀx over 0 <= x <= upper (empty: 1 everywhere), from x (clamped) to x; G may be singular.
// Coordinate descent finds which bounds hold, Cholesky on the free ones makes it exact. Returns the largest violation
// of the optimality conditions, relative to the largest |h|: 1e-9 or less unless G is not positive semidefinite.
double minimiseSquares(const NormalEquations& equations, std::span<const double> upper, std::span<double> x);

}  // namespace roomlight::search
