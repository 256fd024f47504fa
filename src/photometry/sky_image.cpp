#include "photometry/sky_image.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "photometry/colour_temperature.h"

namespace roomlight {
namespace {

constexpr int kWidth = 512, kHeight = 256;

// `bearing` clockwise seen from above, from -z.
Vec3 direction(double sinAltitude, double cosAltitude, double bearingRad) {
  return {static_cast<float>(std::sin(bearingRad) * cosAltitude), static_cast<float>(sinAltitude),
          static_cast<float>(-std::cos(bearingRad) * cosAltitude)};
}

// Of a row's middle.
double altitudeRad(const Image& sky, double row) { return std::numbers::pi * (0.5 - (row + 0.5) / sky.height); }

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

Vec3 sunInSky(Vec3 toSun) {
  const Vec3 level{toSun.x, 0, toSun.z};
  if (toSun.y >= 0) return toSun;
  return length(level) > 0 ? normalize(level) : Vec3{0, 0, -1};
}

Image skyImage(const SkyFunction& skyLuminance, double horizontalLux, const SkyColour& colour) {
  const double now = horizontalIlluminance(skyLuminance), scale = now > 0 ? horizontalLux / now : 0;
  const double mean = horizontalLux / std::numbers::pi, meanK = nearestWhiteK(colour.mean);
  Image image(kWidth, kHeight);
  for (int x = 0; x < kWidth; ++x) {
    const double bearing = 2 * std::numbers::pi * ((x + 0.5) / kWidth - 0.5);
    for (int y = 0; 2 * y < kHeight; ++y) {
      const double altitude = altitudeRad(image, y);
      const double cdM2 = scale * skyLuminance(direction(std::sin(altitude), std::cos(altitude), bearing));
      image.at(x, y) = colourAt(colour, meanK, mean > 0 ? cdM2 / mean : 0) * static_cast<float>(cdM2);
    }
  }
  return image;
}

Vec3 horizontalLux(const Image& sky) {
  Vec3 sum;
  for (int y = 0; 2 * y < sky.height; ++y) {
    const double s0 = std::sin(altitudeRad(sky, y - 0.5)), s1 = std::sin(altitudeRad(sky, y + 0.5));
    Vec3 row;
    for (int x = 0; x < sky.width; ++x) row += sky.at(x, y);
    sum += row * static_cast<float>((s0 * s0 - s1 * s1) * std::numbers::pi / sky.width);
  }
  return sum;
}

void paintGround(Image& sky, Vec3 reflectance, Vec3 sunLux, float hazeRad) {
  const Vec3 ground = (horizontalLux(sky) + sunLux) * reflectance / kPi;
  for (int y = sky.height / 2; y < sky.height; ++y) {
    const float haze = hazeRad > 0 ? std::exp(static_cast<float>(altitudeRad(sky, y)) / hazeRad) : 0;
    for (int x = 0; x < sky.width; ++x) sky.at(x, y) = lerp(ground, sky.at(x, sky.height / 2 - 1), haze);
  }
}

}  // namespace roomlight
