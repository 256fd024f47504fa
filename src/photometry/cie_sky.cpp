#include "photometry/cie_sky.h"

#include <algorithm>
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
// clang-format off
constexpr Gradation kGradation[] = {
    {4, -0.70}, {4, -0.70}, {1.1, -0.8}, {1.1, -0.8}, {0, -1}, {0, -1}, {0, -1}, {0, -1},
    {-1, -0.55}, {-1, -0.55}, {-1, -0.55}, {-1, -0.32}, {-1, -0.32}, {-1, -0.15}, {-1, -0.15},
};
constexpr Indicatrix kIndicatrix[] = {
    {0, -1, 0}, {2, -1.5, 0.15}, {0, -1, 0}, {2, -1.5, 0.15}, {0, -1, 0}, {2, -1.5, 0.15}, {5, -2.5, 0.30}, {10, -3, 0.45},
    {2, -1.5, 0.15}, {5, -2.5, 0.30}, {10, -3, 0.45}, {10, -3, 0.45}, {16, -3, 0.30}, {16, -3, 0.30}, {24, -2.8, 0.15},
};
// clang-format on

double scattering(const Indicatrix& i, double angleRad) {
  const double c = std::cos(angleRad);
  return 1 + i.c * (std::exp(i.d * angleRad) - std::exp(i.d * std::numbers::pi / 2)) + i.e * c * c;
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
  const double s = std::sin(sunAltitudeRad);
  if (s <= 0) return 0;
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
