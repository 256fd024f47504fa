#include "look/display.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/parallel.h"
#include "base/tone_curves.h"
#include "look/edges.h"
#include "look/exposure.h"
#include "photometry/colour_temperature.h"

namespace roomlight {
namespace {

constexpr double kDaylightMired = 1e6 / 6504;
// Photographers leave pictures a trace warmer than D65, by daylight too.
constexpr double kUsualMired = 9;
constexpr double kBluestWhiteK = 9000;  // bluer light stays a little blue, as at dusk
constexpr float kLeastLight = 0.02f;  // of a channel: what is not there cannot be brought back

// How far light is taken for white: in full up to what coloured walls make of it, not at all from where nobody would
// call it white.
float whiteness(Vec3 light, double kelvin) {
  constexpr double kFull = 0.015, kNone = 0.05;
  return static_cast<float>(std::clamp((kNone - distanceFromWhite(light, kelvin)) / (kNone - kFull), 0.0, 1.0));
}

// What that light shall look like: between D65 and its own temperature.
Vec3 shownWhite(const Display& display, double kelvin) {
  const double shift = 1e6 / kelvin - kDaylightMired, warmth = display.warmth.value_or(kUsualWarmth);
  return whiteColour(1e6 / (kDaylightMired + warmth * shift + (display.warmth ? 0 : kUsualMired)));
}

// The same of light of a temperature that may be too blue to be white.
Vec3 shownWhiteOf(const Display& display, double kelvin) {
  const double white = display.warmth ? kelvin : std::min(kelvin, kBluestWhiteK);
  return shownWhite(display, white) * whiteColour(kelvin) / whiteColour(white);
}

// Darker by the square of the distance from the middle.
void darkenCorners(Image& image, float by) {
  const float x0 = 0.5f * static_cast<float>(image.width), y0 = 0.5f * static_cast<float>(image.height),
              r2 = x0 * x0 + y0 * y0;
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      const float dx = static_cast<float>(x) + 0.5f - x0, dy = static_cast<float>(y) + 0.5f - y0;
      image.at(x, y) *= 1 - by * (dx * dx + dy * dy) / r2;
    }
  }
}

void dither(Image& image) {
  parallelFor(static_cast<size_t>(image.height), 16, [&](size_t y) {
    for (int x = 0; x < image.width; ++x) {
      Vec3& p = image.at(x, static_cast<int>(y));
      const float noise = (ditherAt(x, static_cast<int>(y)) - 0.5f) / 255;
      p = max(min(p + Vec3(noise), Vec3(1)), Vec3(0));
    }
  });
}

}  // namespace

std::vector<ShownWhite> shownWhites(const Display& display) {
  std::vector<ShownWhite> out;
  if (display.whiteK || !display.automaticWhite) return out;
  constexpr double kStepMired = 20;
  for (double mired = 1e6 / kLowestWhiteK; mired >= 1e6 / kHighestWhiteK - kStepMired; mired -= kStepMired) {
    const double kelvin = std::min(1e6 / mired, kHighestWhiteK);
    out.push_back({whiteColour(kelvin), max(shownWhiteOf(display, kelvin), Vec3(kLeastLight))});
  }
  return out;
}

White whiteOf(const Display& display, Vec3 lightColour) {
  if (display.whiteK) return {Vec3(1) / max(whiteColour(*display.whiteK), Vec3(kLeastLight)), *display.whiteK};
  if (!display.automaticWhite || !(luminance(lightColour) > 0)) return {};
  const double kelvin = nearestWhiteK(lightColour);
  const Vec3 light = max(lightColour / luminance(lightColour), Vec3(kLeastLight));
  const Vec3 gains = shownWhiteOf(display, kelvin) / light;
  const float share = whiteness(light, kelvin);
  return {{std::pow(gains.x, share), std::pow(gains.y, share), std::pow(gains.z, share)}, kelvin};
}

float ev100Of(const Display& display, const Image& image) {
  return display.ev100 ? *display.ev100 : lookedAtEv100(image) - display.brighterEv;
}

Affine matrixOf(const White& white) {
  return {{white.gains.x, 0, 0}, {0, white.gains.y, 0}, {0, 0, white.gains.z}, {}};
}

Retouch retouchOf(const Image& adapted, const Display& display, float ev100) {
  Retouch r{{}, display.glare, display.vignette};
  if (display.localExposure <= 0) return r;
  const float meteredEv100 =
      display.ev100 ? ev100 : ev100 + display.brighterEv;  // about the metered grey: what the look adds stays
  r.gains = display.quickLocalExposure ? quickLocalExposure(adapted, meteredEv100, display.localExposure)
                                       : localExposure(adapted, meteredEv100, display.localExposure);
  return r;
}

void retouch(Image& image, const Retouch& by) {
  parallelFor(by.gains.values.size(), 16384, [&](size_t i) { image.pixels[i] *= by.gains.values[i]; });
  if (by.glare > 0) addGlare(image, by.glare);
  if (by.vignette > 0) darkenCorners(image, by.vignette);
}

Image displayed(const Image& image, const Display& display, const White& white, float ev100) {
  Image adapted(image.width, image.height);
  parallelFor(image.pixels.size(), 16384, [&](size_t i) { adapted.pixels[i] = image.pixels[i] * white.gains; });
  const std::vector<EdgePixel> edges = edgePixels(adapted);
  const Retouch by = retouchOf(adapted, display, ev100);
  retouch(adapted, by);
  Image rests = retouchedRests(edges, by.gains, adapted);
  Image out = toneMap(std::move(adapted), ev100, display.tone);
  showEdges(out, edges, toneMap(std::move(rests), ev100, display.tone));
  dither(out);
  return out;
}

}  // namespace roomlight
