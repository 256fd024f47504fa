#include "photometry/sky_image.h"

#include <cmath>
#include <numbers>

namespace roomlight {
namespace {

constexpr int kWidth = 512, kHeight = 256;

// `bearing` clockwise seen from above, from -z.
Vec3 direction(double sinAltitude, double cosAltitude, double bearingRad) {
  return {static_cast<float>(std::sin(bearingRad) * cosAltitude), static_cast<float>(sinAltitude), static_cast<float>(-std::cos(bearingRad) * cosAltitude)};
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

Image skyImage(const SkyFunction& luminance, double horizontalLux, Vec3 colour, Vec3 groundCdM2) {
  const double now = horizontalIlluminance(luminance), scale = now > 0 ? horizontalLux / now : 0;
  Image image(kWidth, kHeight);
  for (int y = 0; y < kHeight; ++y) {
    const double altitude = std::numbers::pi * (0.5 - (y + 0.5) / kHeight);
    for (int x = 0; x < kWidth; ++x) {
      if (altitude < 0) {
        image.at(x, y) = groundCdM2;
        continue;
      }
      const double bearing = 2 * std::numbers::pi * ((x + 0.5) / kWidth - 0.5);
      image.at(x, y) = colour * static_cast<float>(scale * luminance(direction(std::sin(altitude), std::cos(altitude), bearing)));
    }
  }
  return image;
}

}  // namespace roomlight
