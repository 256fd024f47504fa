#include "photometry/photometric_web.h"

#include <algorithm>

#include "base/fast_math.h"

namespace roomlight {
namespace {

constexpr float kTwoPi = 2 * kPi;

// The interval of ascending edges that holds v, and how far into it. Most files have even steps: there the first guess
// is right.
std::pair<size_t, float> interval(const std::vector<float>& edges, float v) {
  const size_t last = edges.size() - 2;
  const float steps = (v - edges.front()) / (edges.back() - edges.front()) * static_cast<float>(edges.size() - 1);
  size_t i = std::min(static_cast<size_t>(std::max(0.0f, steps)), last);
  if ((i > 0 && v < edges[i]) || (i < last && v >= edges[i + 1]))
    i = static_cast<size_t>(std::upper_bound(edges.begin() + 1, edges.end() - 1, v) - edges.begin()) - 1;
  return {i, std::clamp((v - edges[i]) / (edges[i + 1] - edges[i]), 0.0f, 1.0f)};
}

}  // namespace

WebPlace placeInWeb(const PhotometricWeb& web, Vec3 d) {
  // By the sine as well: the cosine alone loses directions close to the nadir.
  const float gamma = fastAtan2(std::sqrt(d.x * d.x + d.y * d.y), -d.z);
  const auto [row, inRow] = interval(web.gammaRad, gamma);
  constexpr float kRounding = 1e-6f;
  const bool dark = gamma < web.gammaRad.front() - kRounding || gamma > web.gammaRad.back() + kRounding;
  if (dark || web.cRad.size() == 2) return {0, row, 0, inRow, dark};  // one plane stands for all
  float c = fastAtan2(d.y, d.x);
  if (c < 0) c += kTwoPi;
  const auto [plane, inPlane] = interval(web.cRad, c);
  return {plane, row, inPlane, inRow, dark};
}

float intensityCd(const PhotometricWeb& web, Vec3 direction) {
  const WebPlace at = placeInWeb(web, direction);
  if (at.dark) return 0;
  const auto along = [&](size_t plane) { return lerp(web.at(plane, at.gamma), web.at(plane, at.gamma + 1), at.g); };
  return lerp(along(at.plane), along(at.plane + 1), at.c);
}

double cellFluxLm(const PhotometricWeb& web, size_t plane, size_t gamma) {
  const double a = static_cast<double>(web.gammaRad[gamma]), b = static_cast<double>(web.gammaRad[gamma + 1]);
  const double width = static_cast<double>(web.cRad[plane + 1]) - static_cast<double>(web.cRad[plane]);
  // Integrals of sin over [a, b], times what falls from 1 to 0 and what rises from 0 to 1: half of that of sin alone,
  // less and plus what the slope makes of it; by the middle and half the width, which loses nothing in narrow cells.
  const double middle = (a + b) / 2, h = (b - a) / 2;
  const double even = std::sin(middle) * std::sin(h),
               slope = std::cos(middle) * (h < 1e-3 ? h * h / 3 : std::sin(h) / h - std::cos(h));
  const double falling = std::max(0.0, even - slope), rising = std::max(0.0, even + slope);
  const auto mean = [&](size_t g) {
    return 0.5 * (static_cast<double>(web.at(plane, g)) + static_cast<double>(web.at(plane + 1, g)));
  };
  return width * (mean(gamma) * falling + mean(gamma + 1) * rising);
}

void sumUp(PhotometricWeb& web) {
  web.peakCd = *std::max_element(web.candela.begin(), web.candela.end());
  web.fluxLm = 0;
  for (size_t c = 0; c + 1 < web.cRad.size(); ++c) {
    for (size_t g = 0; g + 1 < web.gammas(); ++g) web.fluxLm += cellFluxLm(web, c, g);
  }
}

float tiltFactor(const PhotometricWeb& web, float tiltRad) {
  if (web.tiltRad.empty()) return 1;
  if (web.tiltRad.size() == 1) return web.tiltFactor[0];
  const auto [i, t] = interval(web.tiltRad, tiltRad);
  return lerp(web.tiltFactor[i], web.tiltFactor[i + 1], t);
}

bool shinesUp(const PhotometricWeb& web) {
  constexpr float kHorizontal = kPi / 2 + 1e-4f;
  for (size_t i = 0; i < web.candela.size(); ++i) {
    // A value above the plane, or one on it whose neighbour above lies within the web, lights what is above.
    if (web.gammaRad[i % web.gammas()] > kHorizontal && web.candela[i] > 0) return true;
    if (i % web.gammas() + 1 < web.gammas() && web.gammaRad[i % web.gammas() + 1] > kHorizontal && web.candela[i] > 0)
      return true;
  }
  return false;
}

float beamHalfAngleRad(const PhotometricWeb& web) {
  float widest = 0;
  for (size_t i = 0; i < web.candela.size(); ++i) {
    if (web.candela[i] < 0.1f * web.peakCd) continue;
    widest = std::max(widest, web.gammaRad[std::min(i % web.gammas() + 1, web.gammas() - 1)]);
  }
  return widest;
}

}  // namespace roomlight
