#include "measure/false_colour.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/tone.h"

namespace roomlight {
namespace {

constexpr double kDark = 0.25, kLight = 0.94;             // lightness of the ends
constexpr double kFirstHueDeg = 295, kLastHueDeg = 105;   // violet-blue, yellow
constexpr double kMostChroma = 0.17;
constexpr double kSteps[] = {1, 1.5, 2, 3, 5, 7.5};
constexpr double kLeastContrast = 3, kMostContrast = 100;

// Linear Rec.709 of Oklab (Ottosson 2020, "A perceptual color space for image processing").
Vec3 fromOklab(double lightness, double a, double b) {
  const double l = std::pow(lightness + 0.3963377774 * a + 0.2158037573 * b, 3),
               m = std::pow(lightness - 0.1055613458 * a - 0.0638541728 * b, 3),
               s = std::pow(lightness - 0.0894841775 * a - 1.2914855480 * b, 3);
  return {static_cast<float>(4.0767416621 * l - 3.3077115913 * m + 0.2309699292 * s),
          static_cast<float>(-1.2684380046 * l + 2.6097574011 * m - 0.3413193965 * s),
          static_cast<float>(-0.0041960863 * l - 0.7034186147 * m + 1.7076147010 * s)};
}

bool displayable(Vec3 c) { return minComponent(c) >= 0 && maxComponent(c) <= 1; }

}  // namespace

Vec3 falseColour(double t) {
  t = std::clamp(t, 0.0, 1.0);
  const double lightness = kDark + (kLight - kDark) * t,
               hue = (kFirstHueDeg + (kLastHueDeg - kFirstHueDeg) * t) * static_cast<double>(kPi) / 180;
  const auto colour = [&](double chroma) {
    return fromOklab(lightness, chroma * std::cos(hue), chroma * std::sin(hue));
  };
  double low = 0, high = kMostChroma;  // the most chroma that can be shown
  for (int i = 0; i < 20; ++i) {
    const double middle = (low + high) / 2;
    (displayable(colour(middle)) ? low : high) = middle;
  }
  const Vec3 c = colour(low);
  return {srgbEncode(c.x), srgbEncode(c.y), srgbEncode(c.z)};
}

std::string hexColour(Vec3 c) {
  const auto byte = [](float v) { return static_cast<int>(std::lround(std::clamp(v, 0.0f, 1.0f) * 255)); };
  return fmt::format("#{:02x}{:02x}{:02x}", byte(c.x), byte(c.y), byte(c.z));
}

double LightScale::position(double value) const {
  return std::clamp(std::log(std::max(value, 1e-30) / low) / std::log(high / low), 0.0, 1.0);
}

std::vector<double> roundSteps(double low, double high) {
  std::vector<double> steps;
  const int first = static_cast<int>(std::floor(std::log10(low))), last = static_cast<int>(std::ceil(std::log10(high)));
  for (int decade = first; decade <= last; ++decade) {
    for (const double step : kSteps) {
      const double value = step * std::pow(10.0, decade);
      if (value >= low * (1 - 1e-9) && value <= high * (1 + 1e-9)) steps.push_back(value);
    }
  }
  return steps;
}

LightScale scaleOf(std::span<const float> values) {
  std::vector<double> lit;
  for (const float v : values) {
    if (v > 0 && std::isfinite(v)) lit.push_back(static_cast<double>(v));
  }
  if (lit.empty()) return {};
  std::sort(lit.begin(), lit.end());
  const double high = lit[lit.size() - 1 - lit.size() / 100],
               low = std::max(lit[lit.size() / 20], high / kMostContrast);
  LightScale scale{roundSteps(low / 2, low).back(), roundSteps(high, 2 * high).front()};
  if (scale.high < kLeastContrast * scale.low)
    scale.low = roundSteps(scale.high / kLeastContrast / 2, scale.high / kLeastContrast).back();
  return scale;
}

}  // namespace roomlight
