#include "study/curves.h"

#include <algorithm>
#include <cmath>

namespace roomlight {

double medianOf(std::vector<double> values) {
  if (values.empty()) return 0;
  std::sort(values.begin(), values.end());
  const size_t n = values.size();
  return n % 2 ? values[n / 2] : (values[n / 2 - 1] + values[n / 2]) / 2;
}

double errorOf(const StudyPoint& point) { return std::max(point.mseBeyondNoise, kLeastMse); }

bool hasSettled(const StudyCurve& curve) {
  const auto flat = [&](size_t i) {
    return errorOf(curve.points[i]) > (1 - kSettledChange) * errorOf(curve.points[i - 1]);
  };
  const size_t n = curve.points.size();
  return n >= 3 && flat(n - 1) && flat(n - 2);
}

const StudyPoint& settledPoint(const StudyCurve& curve) {
  size_t best = curve.points.size() - 1;
  while (best > 0 && errorOf(curve.points[best - 1]) * (1 - kSettledChange) < errorOf(curve.points[best])) --best;
  return curve.points[best];
}

std::optional<double> secondsTo(const StudyCurve& curve, double error) {
  const StudyPoint* before = nullptr;
  for (const StudyPoint& p : curve.points) {
    if (errorOf(p) <= error) {
      if (!before) return p.seconds;
      const double high = std::log(errorOf(*before)), low = std::log(errorOf(p)),
                   share = high > low ? (high - std::log(error)) / (high - low) : 1;
      return std::exp(std::log(before->seconds) + share * (std::log(p.seconds) - std::log(before->seconds)));
    }
    before = &p;
  }
  return std::nullopt;
}

std::optional<double> timeRatioAtEqualError(const StudyCurve& a, const StudyCurve& b) {
  if (a.points.empty() || b.points.empty()) return std::nullopt;
  const auto least = [](const StudyCurve& c) {
    double e = errorOf(c.points.front());
    for (const StudyPoint& p : c.points) e = std::min(e, errorOf(p));
    return e;
  };
  const double both = std::max(least(a), least(b));
  return *secondsTo(a, both) / *secondsTo(b, both);
}

}  // namespace roomlight
