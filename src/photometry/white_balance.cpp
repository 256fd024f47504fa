#include "photometry/colour_temperature.h"

#include <algorithm>
#include <cmath>

namespace roomlight {
namespace {

constexpr double kD65K = 6504;

// IEC 61966-2-1, D65; columns.
constexpr Affine kXyzFromRgb{{0.4124564f, 0.2126729f, 0.0193339f},
                             {0.3575761f, 0.7151522f, 0.1191920f},
                             {0.1804375f, 0.0721750f, 0.9503041f},
                             {0, 0, 0}};
Vec3 xyzOf(Vec2 xy) { return {xy.x / xy.y, 1, (1 - xy.x - xy.y) / xy.y}; }

Vec2 uvOf(Vec3 xyz) {
  const float d = xyz.x + 15 * xyz.y + 3 * xyz.z;
  return {4 * xyz.x / d, 6 * xyz.y / d};
}

// CIE 15: the daylight locus, 4000 K to 25000 K.
Vec2 daylight(double k) {
  const double t = 1000 / k;
  const double x = k <= 7000 ? ((-4.6070 * t + 2.9678) * t + 0.09911) * t + 0.244063
                             : ((-2.0064 * t + 1.9018) * t + 0.24748) * t + 0.237040;
  return {static_cast<float>(x), static_cast<float>((-3 * x + 2.870) * x - 0.275)};
}

double distance2(double kelvin, Vec2 uv) {
  const Vec2 d = uvOf(xyzOf(whiteChromaticity(kelvin))) - uv;
  return static_cast<double>(d.x * d.x + d.y * d.y);
}

}  // namespace

Vec2 whiteChromaticity(double kelvin) {
  const double k = std::clamp(kelvin, kLowestWhiteK, kHighestWhiteK);
  if (k <= 4000) return blackBodyChromaticity(k);
  if (k >= 5000) return daylight(k);
  return lerp(blackBodyChromaticity(k), daylight(k), static_cast<float>((k - 4000) / 1000));
}

double nearestWhiteK(Vec3 rgb) {
  const Vec2 uv = uvOf(kXyzFromRgb.vector(rgb));
  // Steps of 10 in reciprocal megakelvin are just noticeable; then halving.
  double best = kD65K, nearest = distance2(kD65K, uv);
  for (double mired = 1e6 / kHighestWhiteK; mired <= 1e6 / kLowestWhiteK; mired += 10) {
    const double d = distance2(1e6 / mired, uv);
    if (d < nearest) nearest = d, best = 1e6 / mired;
  }
  for (double step = 5; step > 0.05; step /= 2) {
    for (const double mired : {1e6 / best - step, 1e6 / best + step}) {
      const double d = distance2(1e6 / mired, uv);
      if (d < nearest) nearest = d, best = 1e6 / mired;
    }
  }
  return std::clamp(best, kLowestWhiteK, kHighestWhiteK);
}

double distanceFromWhite(Vec3 rgb, double kelvin) {
  return std::sqrt(distance2(kelvin, uvOf(kXyzFromRgb.vector(rgb))));
}

std::optional<double> kelvinOf(Vec3 rgb) {
  constexpr double kNearlyWhite = 0.02;
  const Vec3 xyz = kXyzFromRgb.vector(rgb);
  const auto sum = static_cast<double>(xyz.x + xyz.y + xyz.z);
  if (!(sum > 0)) return {};
  const double k = nearestWhiteK(rgb);
  const Vec2 white = whiteChromaticity(k);
  const double x = static_cast<double>(xyz.x) / sum, y = static_cast<double>(xyz.y) / sum;
  if (std::hypot(x - static_cast<double>(white.x), y - static_cast<double>(white.y)) > kNearlyWhite) return {};
  return std::round(k);
}

Vec3 whiteColour(double kelvin) { return inverse(kXyzFromRgb).vector(xyzOf(whiteChromaticity(kelvin))); }

}  // namespace roomlight
