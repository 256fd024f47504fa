#include "trace/bsdf.h"

#include "base/sampling.h"

namespace roomlight {

Bsdf::Bsdf(const MaterialSample& m, Vec3 ns, Vec3 ng, Vec3 wo)
    : frame_(ns),
      ng_(ng),
      wo_(frame_.toLocal(wo)),
      f0_(m.f0),
      f90_(m.f90),
      roughness_(m.roughness),
      alpha_(ggxAlpha(m.roughness)) {
  mirror_ = alpha_ < kMirrorAlpha;
  wo_.z = std::max(wo_.z, 1e-4f);
  lambda_ = ggxLambda(wo_.z, alpha_);
  lobeScale_ = alpha_ * alpha_ / (4 * kPi * wo_.z * (1 + lambda_));
  base_ = m.baseColor * ((1 - m.metallic) * (1 - m.transmission));
  const AlbedoTerms e =
      mirror_ ? AlbedoTerms{1 - schlickWeight(wo_.z), schlickWeight(wo_.z)} : ggxDirectionalAlbedo(wo_.z, roughness_);
  specularAlbedo_ = m.glazed ? Vec3(glazingLight(m.glazed->glazing, wo_.z).reflected) : f0_ * e.scale + f90_ * e.bias;
  const float eo = std::min(1.0f, maxComponent(specularAlbedo_));
  const AlbedoTerms mean = ggxHemisphericalAlbedo(roughness_);
  const float eMean = std::min(0.9999f, maxComponent(f0_ * mean.scale + f90_ * mean.bias));
  diffuseScale_ = (1 - eo) / (1 - eMean);
  // Exactly (1 - eo) of a white base comes back when E(cos_i) integrates to eMean.
  diffuseAlbedo_ = base_ * (1 - eo);
  const float s = luminance(specularAlbedo_), d = luminance(diffuseAlbedo_);
  specularChance_ = s + d > 0 ? s / (s + d) : 0;
}

Vec3 Bsdf::diffuse(float cosI) const {
  if (isBlack(base_)) return {};
  const AlbedoTerms e = ggxDirectionalAlbedo(cosI, roughness_);
  const float lobeAlbedo = std::min(1.0f, maxComponent(f0_ * e.scale + f90_ * e.bias));
  return base_ * (diffuseScale_ * (1 - lobeAlbedo) * cosI / kPi);
}

Vec3 Bsdf::evaluateDiffuse(Vec3 wiWorld) const {
  const float cosI = dot(wiWorld, frame_.n);
  return cosI > 0 && dot(wiWorld, ng_) > 0 ? diffuse(cosI) : Vec3(0);
}

Vec3 Bsdf::evaluateSpecular(Vec3 wiWorld) const {
  if (!hasLobe() || dot(wiWorld, ng_) <= 0) return {};
  const Vec3 wi = frame_.toLocal(wiWorld);
  return wi.z > 0 ? lobeWeight(wi) * lobePdf(wi) : Vec3(0);
}

Vec3 Bsdf::evaluate(Vec3 wi) const { return value(wi).f; }

BsdfValue Bsdf::value(Vec3 wiWorld) const {
  const Vec3 wi = frame_.toLocal(wiWorld);
  if (wi.z <= 0) return {};
  BsdfValue v;
  v.pdf = pdfLocal(wi);
  if (dot(wiWorld, ng_) <= 0) return v;
  v.f = diffuse(wi.z);
  if (hasLobe()) v.f += lobeWeight(wi) * lobePdf(wi);
  return v;
}

float Bsdf::pdfSpecular(Vec3 wiWorld) const {
  const Vec3 wi = frame_.toLocal(wiWorld);
  return mirror_ || wi.z <= 0 ? 0 : lobePdf(wi);
}

BsdfSample Bsdf::sampleSpecular(Vec2 u) const {
  BsdfSample s;
  if (mirror_) {
    s.wi = frame_.toWorld({-wo_.x, -wo_.y, wo_.z});
    s.mirror = dot(s.wi, ng_) > 0;
    s.weight = specularAlbedo_;
    return s;
  }
  const Vec3 h = sampleVisibleNormal(wo_, alpha_, u);
  const Vec3 wi = h * (2 * dot(wo_, h)) - wo_;
  s.wi = frame_.toWorld(wi);
  if (wi.z <= 0 || dot(s.wi, ng_) <= 0) return s;
  s.pdf = lobePdf(wi);
  s.weight = lobeWeight(wi);
  return s;
}

BsdfSample Bsdf::sample(Vec2 u, float choice) const {
  BsdfSample s;
  if (choice < specularChance_) {
    if (mirror_) {
      s.wi = frame_.toWorld({-wo_.x, -wo_.y, wo_.z});
      if (dot(s.wi, ng_) <= 0) return {};
      s.mirror = true;
      s.weight = specularAlbedo_ / specularChance_;
      return s;
    }
    const Vec3 h = sampleVisibleNormal(wo_, alpha_, u);
    s.wi = frame_.toWorld(h * (2 * dot(wo_, h)) - wo_);
  } else {
    s.wi = frame_.toWorld(sampleCosineHemisphere(u));
  }
  const BsdfValue v = value(s.wi);
  if (!(v.pdf > 0)) return {};
  s.pdf = v.pdf;
  s.weight = v.f / v.pdf;
  return s;
}

}  // namespace roomlight
