#include "photometry/sky_image.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "photometry/white_balance.h"

namespace roomlight {
namespace {

constexpr int kWidth = 512, kHeight = 256;

// `bearing` clockwise seen from above, from -z.
Vec3 direction(double sinAltitude, double cosAltitude, double bearingRad) {
  return {static_cast<float>(std::sin(bearingRad) * cosAltitude), static_cast<float>(sinAltitude), static_cast<float>(-std::cos(bearingRad) * cosAltitude)};
}

// The colour where the sky has `relative` times its mean luminance.
Vec3 colourAt(const SkyColour& colour, double meanK, double relative) {
  constexpr double kBluest = 40, kReddest = 400;  // mired
  if (colour.miredPerDecade == 0 || !(relative > 0)) return colour.mean;
  const double mired = std::clamp(1e6 / meanK + colour.miredPerDecade * std::log10(relative), kBluest, kReddest);
  const Vec3 shifted = max(colour.mean * whiteColour(1e6 / mired) / whiteColour(meanK), Vec3(0));
  return shifted / luminance(shifted);
}

}  // namespace

double horizontalIlluminance(const SkyFunction& luminance) {
  constexpr int kRows = 256, kColumns = 512;
  double sum = 0;
  for (int row = 0; row < kRows; ++row) {
    const double s2 = (row + 0.5) / kRows;  // sin² of the altitude: sin cos d(altitude) is half its differential
    for (int column = 0; column < kColumns; ++column) {
      sum += luminance(direction(std::sqrt(s2), std::sqrt(1 - s2), 2 * std::numbers::pi * (column + 0.5) / kColumns));
    }
  }
  return sum * std::numbers::pi / (kRows * kColumns);
}

Image skyImage(const SkyFunction& skyLuminance, double horizontalLux, const SkyColour& colour, Vec3 groundCdM2) {
  const double now = horizontalIlluminance(skyLuminance), scale = now > 0 ? horizontalLux / now : 0;
  const double mean = horizontalLux / std::numbers::pi, meanK = nearestWhiteK(colour.mean);
  Image image(kWidth, kHeight);
  for (int x = 0; x < kWidth; ++x) {
    const double bearing = 2 * std::numbers::pi * ((x + 0.5) / kWidth - 0.5);
    Vec3 horizon;
    for (int y = 0; y < kHeight; ++y) {
      const double altitude = std::numbers::pi * (0.5 - (y + 0.5) / kHeight);
      if (altitude < 0) {
        const float haze = colour.hazeRad > 0 ? std::exp(static_cast<float>(altitude) / colour.hazeRad) : 0;
        image.at(x, y) = lerp(groundCdM2, horizon, haze);
        continue;
      }
      const double cdM2 = scale * skyLuminance(direction(std::sin(altitude), std::cos(altitude), bearing));
      image.at(x, y) = horizon = colourAt(colour, meanK, mean > 0 ? cdM2 / mean : 0) * static_cast<float>(cdM2);
    }
  }
  return image;
}

}  // namespace roomlight
