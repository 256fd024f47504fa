#include "radiance/lamp_glow.h"

#include <array>
#include <cmath>

namespace roomlight {
namespace {

constexpr size_t kCandidates = 8;
constexpr float kTries = 16;  // samples that a choice among candidates is worth, where points and cones share

}  // namespace

LampGlow::LampGlow(std::vector<GlowPoint> points, float voxelSizeM)
    : points_(std::move(points)), voxelSizeM_(voxelSizeM) {
  double flux = 0;
  for (const GlowPoint& g : points_) flux += static_cast<double>(luminance(g.fluxLm));
  // Chosen by flux, a direction towards luminance L at distance d is found with a density of pi L d² / (flux cos) per
  // steradian.
  perRadiance_ = flux > 0 ? kTries * kPi / static_cast<float>(flux) : 0;
}

// Cones read glow on the base level only, and leave that where they are two voxels wide. That distance varies by a
// factor of two (see marchCone's levelShift).
float LampGlow::shareAt(const GlowPoint& g, float distance, float cosLight, const GlowCone& cone) const {
  const float onBase =
      cone.tanHalf <= 0 ? 1 : std::clamp(std::log2(voxelSizeM_ / std::max(cone.tanHalf * distance, 1e-9f)), 0.0f, 1.0f);
  return 1 - onBase * coneShare(g.radianceCdM2, distance, cosLight, cone.pdf);
}

float LampGlow::pointShare(size_t point, Vec3 p, const GlowCone& cone) const {
  const GlowPoint& g = points_[point];
  const Vec3 d = p - g.p;
  const float distance = length(d);
  return shareAt(g, distance, dot(d, g.n) / std::max(distance, 1e-12f), cone);
}

GlowSample LampGlow::sample(Vec3 p, Vec3 n, float diffuseCones, float tanHalf, Sampler& sampler) const {
  std::array<size_t, kCandidates> candidate;
  std::array<float, kCandidates> upTo;
  float sum = 0;
  const float first = sampler.next1();
  for (size_t i = 0; i < kCandidates; ++i) {
    // One in each part of the list, which is sorted by lamp.
    const float u = (static_cast<float>(i) + (i == 0 ? first : sampler.fast1())) / static_cast<float>(kCandidates);
    candidate[i] = std::min(points_.size() - 1, static_cast<size_t>(u * static_cast<float>(points_.size())));
    __builtin_prefetch(&points_[candidate[i]]);
  }
  for (size_t i = 0; i < kCandidates; ++i) {
    const GlowPoint& g = points_[candidate[i]];
    const Vec3 d = g.p - p;
    const float d2 = lengthSquared(d), distance = std::sqrt(d2), cosSurface = dot(d, n) / std::max(distance, 1e-12f),
                cosLight = -dot(d, g.n) / std::max(distance, 1e-12f);
    if (cosSurface > 0 && cosLight > 0) {
      const GlowCone cone{diffuseCones * cosSurface / kPi, std::min(tanHalf, cosSurface)};
      sum += cosSurface * cosLight / d2 * shareAt(g, distance, cosLight, cone);
    }
    upTo[i] = sum;
  }
  if (!(sum > 0)) return {};
  const float pick = sampler.next1() * sum;
  size_t k = 0;
  while (k + 1 < kCandidates && upTo[k] <= pick) ++k;
  const float value = upTo[k] - (k > 0 ? upTo[k - 1] : 0);
  if (!(value > 0)) return {};
  const GlowPoint& g = points_[candidate[k]];
  const Vec3 d = g.p - p;
  const float d2 = lengthSquared(d), distance = std::sqrt(d2), cosLight = -dot(d, g.n) / distance;
  const float inverseChance = sum / (static_cast<float>(kCandidates) * value) * static_cast<float>(points_.size());
  GlowSample out;
  out.point = candidate[k];
  out.light = {d / distance, distance, g.fluxLm * (cosLight / (kPi * d2) * inverseChance), 0};
  return out;
}

}  // namespace roomlight
