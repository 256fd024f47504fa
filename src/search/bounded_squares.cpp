// Least squares with bounds: the idea of Stark and Parker 1995 on the normal equations, with coordinate descent in
// place of their one bound at a time.
#include <algorithm>
#include <cassert>
#include <cmath>

#include "search/dimming.h"

namespace roomlight::search {
namespace {

constexpr int kRounds = 100, kSweeps = 3;
constexpr double kTolerance = 1e-10;  // of the largest |h|
constexpr double kRidge = 1e-13;  // of the largest diagonal: lets singular matrices through; rounds take its error away

class BoundedSquares {
 public:
  BoundedSquares(const NormalEquations& equations, std::span<const double> upper, std::span<double> x)
      : n_(equations.columns), g_(equations.g), h_(equations.h), upper_(upper), x_(x), slope_(n_) {
    for (size_t i = 0; i < n_; ++i) x_[i] = std::clamp(x_[i], 0.0, top(i));
    for (double h : h_) scale_ = std::max(scale_, std::abs(h));
    for (size_t i = 0; i < n_; ++i) largest_ = std::max(largest_, at(i, i));
  }

  double solve() {
    freshSlope();
    double violation = worst();
    for (int round = 0; round < kRounds && violation > kTolerance; ++round) {
      for (int sweep = 0; sweep < kSweeps; ++sweep) descend();
      toMinimumOfFree();
      freshSlope();
      violation = worst();
    }
    return violation;
  }

 private:
  double at(size_t i, size_t j) const { return g_[i * n_ + j]; }
  double top(size_t i) const { return upper_.empty() ? 1 : upper_[i]; }

  void freshSlope() {  // half the gradient
    for (size_t i = 0; i < n_; ++i) {
      double sum = -h_[i];
      for (size_t j = 0; j < n_; ++j) sum += at(i, j) * x_[j];
      slope_[i] = sum;
    }
  }

  // How far the optimality conditions are off: the step that a coordinate would still take, in units of the slope.
  double worst() const {
    double most = 0;
    for (size_t i = 0; i < n_; ++i) {
      const double stiffness = at(i, i) > 0 ? at(i, i) : 1;
      const double step = x_[i] - std::clamp(x_[i] - slope_[i] / stiffness, 0.0, top(i));
      most = std::max(most, std::abs(step) * stiffness);
    }
    return scale_ > 0 ? most / scale_ : most;
  }

  // Every coordinate in turn to its minimum within its bounds.
  void descend() {
    for (size_t i = 0; i < n_; ++i) {
      if (!(at(i, i) > 0)) continue;
      const double to = std::clamp(x_[i] - slope_[i] / at(i, i), 0.0, top(i)), step = to - x_[i];
      if (step == 0) continue;
      x_[i] = to;
      for (size_t j = 0; j < n_; ++j) slope_[j] += at(i, j) * step;
    }
  }

  // The free coordinates together to their minimum, or as far towards it as bounds let; what meets its bound stays
  // there and the rest goes on.
  void toMinimumOfFree() {
    free_.clear();
    for (size_t i = 0; i < n_; ++i)
      if (x_[i] > 0 && x_[i] < top(i)) free_.push_back(i);
    while (!free_.empty()) {
      freshSlope();
      if (!factor()) return;
      back();
      double reach = 1;
      size_t stopped = n_;
      for (size_t k = 0; k < free_.size(); ++k) {
        const size_t i = free_[k];
        const double room = step_[k] < 0 ? x_[i] / -step_[k] : step_[k] > 0 ? (top(i) - x_[i]) / step_[k] : 2;
        if (room < reach) reach = room, stopped = k;
      }
      for (size_t k = 0; k < free_.size(); ++k)
        x_[free_[k]] = std::clamp(x_[free_[k]] + reach * step_[k], 0.0, top(free_[k]));
      if (stopped == n_) return;
      x_[free_[stopped]] = step_[stopped] < 0 ? 0 : top(free_[stopped]);
      free_.erase(free_.begin() + static_cast<ptrdiff_t>(stopped));
    }
  }

  // Cholesky of the free part of G, lower triangle.
  bool factor() {
    const size_t k = free_.size();
    l_.assign(k * k, 0);
    for (size_t i = 0; i < k; ++i)
      for (size_t j = 0; j <= i; ++j) {
        double sum = at(free_[i], free_[j]);
        for (size_t p = 0; p < j; ++p) sum -= l_[i * k + p] * l_[j * k + p];
        if (i != j) {
          l_[i * k + j] = sum / l_[j * k + j];
          continue;
        }
        sum += kRidge * largest_;
        if (!(sum > 0)) return false;
        l_[i * k + i] = std::sqrt(sum);
      }
    return true;
  }

  void back() {  // step = -G⁻¹ slope on the free ones
    const size_t k = free_.size();
    step_.resize(k);
    for (size_t i = 0; i < k; ++i) {
      double sum = -slope_[free_[i]];
      for (size_t p = 0; p < i; ++p) sum -= l_[i * k + p] * step_[p];
      step_[i] = sum / l_[i * k + i];
    }
    for (size_t i = k; i-- > 0;) {
      double sum = step_[i];
      for (size_t p = i + 1; p < k; ++p) sum -= l_[p * k + i] * step_[p];
      step_[i] = sum / l_[i * k + i];
    }
  }

  size_t n_;
  const std::vector<double>&g_, &h_;
  std::span<const double> upper_;
  std::span<double> x_;
  std::vector<double> slope_, l_, step_;
  std::vector<size_t> free_;
  double scale_ = 0, largest_ = 0;
};

}  // namespace

NormalEquations normalEquations(const DenseMatrix& a, std::span<const double> b, std::span<const double> weights) {
  assert(b.size() == a.rows && (weights.empty() || weights.size() == a.rows));
  const size_t n = a.columns;
  NormalEquations out;
  out.columns = n;
  out.g.assign(n * n, 0);
  out.h.assign(n, 0);
  for (size_t r = 0; r < a.rows; ++r) {
    const std::span<const double> row = a.row(r);
    const double w = weights.empty() ? 1 : weights[r];
    for (size_t i = 0; i < n; ++i) {
      const double wi = w * row[i];
      if (wi == 0) continue;
      for (size_t j = 0; j < n; ++j) out.g[i * n + j] += wi * row[j];
      out.h[i] += wi * b[r];
    }
    out.constant += w * b[r] * b[r];
  }
  return out;
}

double missOf(const NormalEquations& equations, std::span<const double> x) {
  const size_t n = equations.columns;
  double sum = equations.constant;
  for (size_t i = 0; i < n; ++i) {
    double gx = 0;
    for (size_t j = 0; j < n; ++j) gx += equations.g[i * n + j] * x[j];
    sum += x[i] * (gx - 2 * equations.h[i]);
  }
  return std::max(0.0, sum);
}

double minimiseSquares(const NormalEquations& equations, std::span<const double> upper, std::span<double> x) {
  assert(x.size() == equations.columns && (upper.empty() || upper.size() == x.size()));
  return BoundedSquares(equations, upper, x).solve();
}

}  // namespace roomlight::search
