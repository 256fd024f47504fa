#include "measure/glare.h"

#include <cmath>

namespace roomlight {
namespace {

constexpr double kHighestIndex = 16;
constexpr double kDegree = 3.14159265358979323846 / 180;

double above(double tauDeg, double sigmaDeg) {
  const double s = sigmaDeg, t = tauDeg;
  return std::exp((35.2 - 0.31889 * t - 1.22 * std::exp(-2 * t / 9)) * 1e-3 * s +
                  (21 + 0.26667 * t - 0.002963 * t * t) * 1e-5 * s * s);
}

}  // namespace

double positionIndex(Vec3 direction, Vec3 view) {
  // The eye's own frame: right and up of a head that is not tilted to the side.
  const Vec3 upwards = std::abs(view.y) < 0.999f ? Vec3{0, 1, 0} : Vec3{0, 0, -1};
  const Vec3 right = normalize(cross(view, upwards)), up = cross(right, view);
  const double ahead = static_cast<double>(dot(direction, view)), x = static_cast<double>(dot(direction, right)),
               y = static_cast<double>(dot(direction, up));
  if (ahead <= 1e-6) return INFINITY;
  const double off = std::hypot(x, y);
  if (y >= 0)
    return std::min(kHighestIndex, above(std::atan2(std::abs(x), y) / kDegree, std::atan2(off, ahead) / kDegree));
  const double r = off / ahead;
  return std::min(kHighestIndex, 1 + (r > 0.6 ? 1.2 : 0.8) * r);
}

double ugr(std::span<const GlareSource> sources, Vec3 view, double backgroundCdM2) {
  double sum = 0;
  for (const GlareSource& s : sources) {
    const double p = positionIndex(s.direction, view);
    sum += s.luminanceCdM2 * s.luminanceCdM2 * s.solidAngleSr / (p * p);
  }
  return 8 * std::log10(0.25 / backgroundCdM2 * sum);
}

GlareSource smallSource(Vec3 direction, double intensityCd, double distanceM) {
  return {direction, intensityCd / kSmallSourceM2, kSmallSourceM2 / (distanceM * distanceM)};
}

}  // namespace roomlight
