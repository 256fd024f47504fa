#include "compare/perceived_error.h"

namespace roomlight {
namespace {

Plane product(const Plane& a, const Plane& b) {
  Plane out(a.width, a.height);
  for (size_t i = 0; i < out.values.size(); ++i) out.values[i] = a.values[i] * b.values[i];
  return out;
}

}  // namespace

double structuralSimilarity(const Plane& a, const Plane& b) {
  constexpr double kC1 = 0.01 * 0.01, kC2 = 0.03 * 0.03;  // for a dynamic range of 1
  const Kernel window = gaussianKernel(1.5, 5);
  const Plane meanA = convolve(a, window, window), meanB = convolve(b, window, window);
  const Plane squareA = convolve(product(a, a), window, window), squareB = convolve(product(b, b), window, window);
  const Plane both = convolve(product(a, b), window, window);
  double sum = 0;
  for (size_t i = 0; i < a.values.size(); ++i) {
    const double ma = meanA.values[i], mb = meanB.values[i];
    const double varianceA = squareA.values[i] - ma * ma, varianceB = squareB.values[i] - mb * mb;
    const double covariance = both.values[i] - ma * mb;
    sum += (2 * ma * mb + kC1) * (2 * covariance + kC2) / ((ma * ma + mb * mb + kC1) * (varianceA + varianceB + kC2));
  }
  return sum / static_cast<double>(a.values.size());
}

}  // namespace roomlight
