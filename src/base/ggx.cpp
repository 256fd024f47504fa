#include "base/ggx.h"

#include <memory>

namespace roomlight {
namespace {

constexpr int kCosines = 32, kRoughnesses = 32, kQuadrature = 24;

// Albedo at one direction by midpoint quadrature over the square that drives the visible-normal sampling: the mean of
// F G2 / G1 is the albedo. A perfect mirror is its Fresnel term.
AlbedoTerms integrateAlbedo(float cosTheta, float alpha) {
  if (alpha < kMirrorAlpha) {
    const float w = schlickWeight(cosTheta);
    return {1 - w, w};
  }
  const Vec3 wo{std::sqrt(std::max(0.0f, 1 - cosTheta * cosTheta)), 0, cosTheta};
  double scale = 0, bias = 0;
  for (int i = 0; i < kQuadrature; ++i) {
    for (int j = 0; j < kQuadrature; ++j) {
      const Vec2 u{(static_cast<float>(i) + 0.5f) / kQuadrature, (static_cast<float>(j) + 0.5f) / kQuadrature};
      const Vec3 h = sampleVisibleNormal(wo, alpha, u);
      const float voH = dot(wo, h);
      const Vec3 wi = h * (2 * voH) - wo;
      if (wi.z <= 0) continue;
      const double g = ggxG2(wo.z, wi.z, alpha) / ggxG1(wo.z, alpha);
      const double w = schlickWeight(voH);
      scale += g * (1 - w);
      bias += g * w;
    }
  }
  const double n = kQuadrature * kQuadrature;
  return {static_cast<float>(scale / n), static_cast<float>(bias / n)};
}

// Rows over roughness, columns over the cosine, nodes at both ends of [0, 1].
struct AlbedoTable {
  AlbedoTerms directional[kRoughnesses][kCosines];
  AlbedoTerms hemispherical[kRoughnesses];

  AlbedoTable() {
    for (int r = 0; r < kRoughnesses; ++r) {
      const float alpha = ggxAlpha(static_cast<float>(r) / (kRoughnesses - 1));
      double scale = 0, bias = 0, weight = 0;
      for (int c = 0; c < kCosines; ++c) {
        const float mu = std::max(1e-3f, static_cast<float>(c) / (kCosines - 1));
        directional[r][c] = integrateAlbedo(mu, alpha);
        const double w = (c == 0 || c == kCosines - 1 ? 0.5 : 1.0) * mu;  // trapezoid of 2 mu dmu
        scale += w * directional[r][c].scale;
        bias += w * directional[r][c].bias;
        weight += w;
      }
      hemispherical[r] = {static_cast<float>(scale / weight), static_cast<float>(bias / weight)};
    }
  }
};

const AlbedoTable& albedoTable() {
  static const AlbedoTable table;
  return table;
}

AlbedoTerms mix(AlbedoTerms a, AlbedoTerms b, float t) { return {lerp(a.scale, b.scale, t), lerp(a.bias, b.bias, t)}; }

struct Node {
  int index;
  float fraction;
};
Node tableNode(float v, int count) {
  const float x = std::clamp(v, 0.0f, 1.0f) * static_cast<float>(count - 1);
  const int i = std::min(static_cast<int>(x), count - 2);
  return {i, x - static_cast<float>(i)};
}

}  // namespace

Vec3 sampleVisibleNormal(Vec3 wo, float alpha, Vec2 u) {
  // Stretch to the unit-roughness hemisphere, sample the spherical cap of reflected directions there, stretch back.
  const Vec3 w = normalize(Vec3{wo.x * alpha, wo.y * alpha, wo.z});
  const float phi = 2 * kPi * u.x;
  const float z = (1 - u.y) * (1 + w.z) - w.z;
  const float r = std::sqrt(std::clamp(1 - z * z, 0.0f, 1.0f));
  const Vec3 h = Vec3{r * std::cos(phi), r * std::sin(phi), z} + w;
  return normalize(Vec3{h.x * alpha, h.y * alpha, std::max(h.z, 1e-7f)});
}

AlbedoTerms ggxDirectionalAlbedo(float cosTheta, float roughness) {
  const AlbedoTable& table = albedoTable();
  const Node r = tableNode(roughness, kRoughnesses), c = tableNode(cosTheta, kCosines);
  const AlbedoTerms* low = table.directional[r.index];
  const AlbedoTerms* high = table.directional[r.index + 1];
  return mix(mix(low[c.index], low[c.index + 1], c.fraction), mix(high[c.index], high[c.index + 1], c.fraction),
             r.fraction);
}

AlbedoTerms ggxHemisphericalAlbedo(float roughness) {
  const AlbedoTable& table = albedoTable();
  const Node r = tableNode(roughness, kRoughnesses);
  return mix(table.hemispherical[r.index], table.hemispherical[r.index + 1], r.fraction);
}

}  // namespace roomlight
