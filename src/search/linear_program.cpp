// The one place that knows Clp (Forrest and Lougee-Heimer 2005).
#include <algorithm>
#include <cmath>
#include <string>

#include "search/dimming.h"

#include <ClpSimplex.hpp>

namespace roomlight::search {
namespace {

Status sizesMatch(const LinearProgram& p) {
  const auto wrong = [](const char* what, size_t is, size_t should) {
    return Error{std::string(what) + ": has " + std::to_string(is) + " numbers instead of " + std::to_string(should)};
  };
  if (p.a.values.size() != p.a.rows * p.a.columns) return wrong("a", p.a.values.size(), p.a.rows * p.a.columns);
  if (!p.atLeast.empty() && p.atLeast.size() != p.a.rows) return wrong("atLeast", p.atLeast.size(), p.a.rows);
  if (!p.atMost.empty() && p.atMost.size() != p.a.rows) return wrong("atMost", p.atMost.size(), p.a.rows);
  if (p.cost.size() != p.a.columns) return wrong("cost", p.cost.size(), p.a.columns);
  if (!p.upper.empty() && p.upper.size() != p.a.columns) return wrong("upper", p.upper.size(), p.a.columns);
  return Ok{};
}

double lowOf(const LinearProgram& p, size_t row) { return p.atLeast.empty() ? -kUnbounded : p.atLeast[row]; }
double highOf(const LinearProgram& p, size_t row) { return p.atMost.empty() ? kUnbounded : p.atMost[row]; }
double clpBound(double v) { return std::isfinite(v) ? v : std::copysign(COIN_DBL_MAX, v); }

// The program by columns as Clp takes it; with `soft`, two more columns a row take up what it misses, and they alone
// cost.
void load(const LinearProgram& p, bool soft, ClpSimplex& model) {
  const size_t n = p.a.columns, rows = p.a.rows, columns = n + (soft ? 2 * rows : 0);
  std::vector<CoinBigIndex> starts{0};
  std::vector<int> at;
  std::vector<double> values, lower(columns, 0), upper(columns, COIN_DBL_MAX), cost(columns, 1), low(rows), high(rows);
  for (size_t c = 0; c < n; ++c) {
    for (size_t r = 0; r < rows; ++r)
      if (const double v = p.a.values[r * n + c]; v != 0) at.push_back(static_cast<int>(r)), values.push_back(v);
    starts.push_back(static_cast<CoinBigIndex>(at.size()));
    upper[c] = p.upper.empty() ? 1 : clpBound(p.upper[c]);
    cost[c] = soft ? 0 : p.cost[c];
  }
  for (size_t c = n; c < columns; ++c) {
    at.push_back(static_cast<int>((c - n) / 2)), values.push_back((c - n) % 2 ? -1 : 1);
    starts.push_back(static_cast<CoinBigIndex>(at.size()));
  }
  for (size_t r = 0; r < rows; ++r) low[r] = clpBound(lowOf(p, r)), high[r] = clpBound(highOf(p, r));
  model.setLogLevel(0);
  model.loadProblem(static_cast<int>(columns), static_cast<int>(rows), starts.data(), at.data(), values.data(),
                    lower.data(), upper.data(), cost.data(), low.data(), high.data());
}

std::string number(double v) {
  char text[32];
  std::snprintf(text, sizeof text, "%.6g", v);
  return text;
}

Error infeasible(const LinearProgram& p) {
  const Result<LeastMiss> least = leastMiss(p);
  if (!least) return Error{"infeasible; " + least.error()};
  const auto& miss = least.value().miss;
  const size_t row = static_cast<size_t>(
      std::max_element(miss.begin(), miss.end(), [](double a, double b) { return std::abs(a) < std::abs(b); }) -
      miss.begin());
  const double asked = miss[row] > 0 ? lowOf(p, row) : highOf(p, row);
  return Error{"infeasible: row " + std::to_string(row) + " gets " + number(asked - miss[row]) + " instead of at " +
               (miss[row] > 0 ? "least " : "most ") + number(asked) +
               " when all rows together miss least; ask for less"};
}

}  // namespace

Result<LinearSolution> minimise(const LinearProgram& program) {
  if (Status bad = sizesMatch(program); !bad) return Error{bad.error()};
  ClpSimplex model;
  load(program, false, model);
  model.dual();
  // Presolve-free dual simplex may end unsure; the primal one settles it.
  if (model.status() != 0) model.primal();
  if (model.isProvenPrimalInfeasible()) return infeasible(program);
  if (model.isProvenDualInfeasible())
    return Error{"unbounded: the cost falls without end; give every column that earns an upper bound"};
  if (!model.isProvenOptimal())
    return Error{"the simplex method gave up with status " + std::to_string(model.status()) +
                 "; scale rows and columns to like sizes"};
  LinearSolution solution;
  const double *x = model.getColSolution(), *price = model.getRowPrice();
  solution.x.assign(x, x + program.a.columns);
  solution.price.assign(price, price + program.a.rows);
  for (size_t c = 0; c < program.a.columns; ++c) {
    // Clp keeps bounds to 1e-7.
    solution.x[c] = std::clamp(solution.x[c], 0.0, program.upper.empty() ? 1 : program.upper[c]);
    solution.cost += program.cost[c] * solution.x[c];
  }
  return solution;
}

Result<LeastMiss> leastMiss(const LinearProgram& program) {
  if (Status bad = sizesMatch(program); !bad) return Error{bad.error()};
  ClpSimplex model;
  load(program, true, model);
  model.primal();
  if (!model.isProvenOptimal())
    return Error{"the simplex method gave up with status " + std::to_string(model.status()) +
                 "; scale rows and columns to like sizes"};
  const size_t n = program.a.columns;
  const double* x = model.getColSolution();
  LeastMiss least;
  least.x.assign(x, x + n);
  for (size_t r = 0; r < program.a.rows; ++r) {
    least.miss.push_back(x[n + 2 * r] - x[n + 2 * r + 1]);
    least.sum += std::abs(least.miss.back());
  }
  return least;
}

}  // namespace roomlight::search
