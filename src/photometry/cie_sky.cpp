#include "photometry/sky_luminance.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <limits>
#include <numbers>

namespace roomlight {
namespace {

struct Gradation {
  double a, b;
};
struct Indicatrix {
  double c, d, e;
};

// Table 1 of the standard, types 1 to 15.
constexpr Gradation kGradation[] = {
    {4, -0.70},  {4, -0.70},  {1.1, -0.8}, {1.1, -0.8}, {0, -1},     {0, -1},     {0, -1},     {0, -1},
    {-1, -0.55}, {-1, -0.55}, {-1, -0.55}, {-1, -0.32}, {-1, -0.32}, {-1, -0.15}, {-1, -0.15},
};
constexpr Indicatrix kIndicatrix[] = {
    {0, -1, 0},      {2, -1.5, 0.15}, {0, -1, 0},     {2, -1.5, 0.15}, {0, -1, 0},
    {2, -1.5, 0.15}, {5, -2.5, 0.30}, {10, -3, 0.45}, {2, -1.5, 0.15}, {5, -2.5, 0.30},
    {10, -3, 0.45},  {10, -3, 0.45},  {16, -3, 0.30}, {16, -3, 0.30},  {24, -2.8, 0.15},
};

double scattering(const Indicatrix& i, double angleRad) {
  const double c = std::cos(angleRad);
  return 1 + i.c * (std::exp(i.d * angleRad) - std::exp(i.d * std::numbers::pi / 2)) + i.e * c * c;
}

// What is left of the sky's light after sunset, of that at sunset: in powers of ten at 6, 12 and 18 degrees below the
// horizon, between them linear (3.4, 0.008 and 0.00065 lx of 760 lx; Seidelmann 1992, "Explanatory Supplement to the
// Astronomical Almanac").
double twilight(double sunAltitudeRad) {
  constexpr std::array kPowers = {0.0, -2.35, -4.96, -6.07};
  const double sixes = std::clamp(-sunAltitudeRad * 180 / std::numbers::pi / 6, 0.0, 3.0);
  const auto i = static_cast<size_t>(std::min(sixes, 2.0));
  return std::pow(10, std::lerp(kPowers[i], kPowers[i + 1], sixes - static_cast<double>(i)));
}

}  // namespace

SkyCover skyCover(int cieType) {
  if (cieType <= 5 || cieType == 16) return SkyCover::Overcast;
  return cieType <= 10 ? SkyCover::Intermediate : SkyCover::Clear;
}

bool dependsOnSun(int cieType) { return cieType != 16 && kIndicatrix[cieType - 1].c > 0; }

double cieSkyLuminance(int cieType, double cosZenith, double sunAngleRad, double sunZenithRad) {
  assert(cieType >= 1 && cieType <= kCieSkyTypes);
  if (cieType == 16) return (1 + 2 * cosZenith) / 3;
  const Gradation& g = kGradation[cieType - 1];
  const Indicatrix& i = kIndicatrix[cieType - 1];
  const double gradation = (1 + g.a * std::exp(g.b / std::max(cosZenith, 1e-4))) / (1 + g.a * std::exp(g.b));
  return gradation * scattering(i, sunAngleRad) / scattering(i, sunZenithRad);
}

double skyHorizontalLux(SkyCover cover, double sunAltitudeRad) {
  if (sunAltitudeRad < 0) return std::max(kNightLux, twilight(sunAltitudeRad) * skyHorizontalLux(cover, 0));
  const double s = std::sin(sunAltitudeRad);
  switch (cover) {
    case SkyCover::Overcast: return 300 + 21'000 * s;
    case SkyCover::Intermediate: return 300 + 45'000 * s;
    case SkyCover::Clear: return 800 + 15'500 * std::sqrt(s);
  }
  return 0;
}

double sunExtinction(SkyCover cover) {
  if (cover == SkyCover::Overcast) return std::numeric_limits<double>::infinity();
  return cover == SkyCover::Clear ? 0.21 : 0.80;
}

}  // namespace roomlight
