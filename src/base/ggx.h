// Isotropic GGX microfacet reflection: distribution, Smith masking, sampling of visible normals, and the directional
// albedo that the energy-conserving mix with a diffuse base needs. Directions are local, surface normal +z.
// Sources: Walter et al. 2007 (D, G), Heitz 2014 (height-correlated Smith), Dupuy & Benyoub 2023 (sampling).
#pragma once

#include "base/vec.h"

namespace roomlight {

// Below this alpha the lobe is narrower than floats resolve: treated as a perfect mirror.
constexpr float kMirrorAlpha = 1e-3f;

inline float ggxAlpha(float roughness) { return roughness * roughness; }

inline float ggxD(float cosH, float alpha) {
  const float a2 = alpha * alpha, k = cosH * cosH * (a2 - 1) + 1;
  return a2 / (kPi * k * k);
}

inline float ggxLambda(float cosTheta, float alpha) {
  const float c2 = cosTheta * cosTheta;
  const float tan2 = std::max(0.0f, 1 - c2) / std::max(c2, 1e-12f);
  return 0.5f * (std::sqrt(1 + alpha * alpha * tan2) - 1);
}

inline float ggxG1(float cosTheta, float alpha) { return 1 / (1 + ggxLambda(cosTheta, alpha)); }
inline float ggxG2(float cosO, float cosI, float alpha) {
  return 1 / (1 + ggxLambda(cosO, alpha) + ggxLambda(cosI, alpha));
}

// Microfacet normal visible from wo; density G1(wo) max(0, wo.h) D(h) / cos(wo).
Vec3 sampleVisibleNormal(Vec3 wo, float alpha, Vec2 u);

inline float schlickWeight(float cosTheta) {
  const float m = std::clamp(1 - cosTheta, 0.0f, 1.0f);
  return (m * m) * (m * m) * m;
}
inline Vec3 fresnelSchlick(Vec3 f0, Vec3 f90, float cosTheta) { return lerp(f0, f90, schlickWeight(cosTheta)); }

// Directional albedo of the lobe is f0 * scale + f90 * bias (single scattering), tabulated once per process by
// quadrature over visible normals; error below 0.003.
struct AlbedoTerms {
  float scale, bias;
};
AlbedoTerms ggxDirectionalAlbedo(float cosTheta, float roughness);
AlbedoTerms ggxHemisphericalAlbedo(float roughness);  // its cosine-weighted mean over all directions

}  // namespace roomlight
