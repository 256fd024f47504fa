// glTF metallic-roughness as a BSDF: GGX over an energy-conserving Lambertian base. Straight transmission through thin
// walls is not in it; see straightTransmittance() in scene/surface.h.
//   f = D G F / (4 cos_i cos_o)  +  rho/pi (1 - E(cos_o)) (1 - E(cos_i)) / (1 - E_mean)
// E is the directional albedo of the specular lobe (largest channel), E_mean its hemispherical mean: reciprocal, never
// above 1, and a white base makes the whole white (Kelemen & Szirmay-Kalos 2001, Kulla & Conty 2017).
#pragma once

#include "base/ggx.h"
#include "scene/surface.h"

namespace roomlight {

struct BsdfSample {
  Vec3 wi;       // world, unit
  Vec3 weight;   // f cos / pdf
  float pdf = 0; // per steradian; 0 with `mirror`
  bool mirror = false;
  bool valid() const { return mirror || pdf > 0; }
};

struct BsdfValue {
  Vec3 f;        // times the cosine of wi
  float pdf = 0;
};

class Bsdf {
 public:
  // ns: shading normal, ng: geometric normal, both on wo's side; wo: unit, towards the viewer; all world space.
  Bsdf(const MaterialSample& m, Vec3 ns, Vec3 ng, Vec3 wo);

  // f(wo, wi) |cos wi| without the mirror part; zero where wi is below the geometric surface.
  Vec3 evaluate(Vec3 wi) const;
  Vec3 evaluateDiffuse(Vec3 wi) const;   // its two parts apart
  Vec3 evaluateSpecular(Vec3 wi) const;
  float pdf(Vec3 wiWorld) const {
    const Vec3 wi = frame_.toLocal(wiWorld);
    return wi.z > 0 ? pdfLocal(wi) : 0;
  }
  BsdfValue value(Vec3 wi) const;        // evaluate() and pdf(), for less than both
  float pdfSpecular(Vec3 wi) const;  // of sampleSpecular; 0 for a mirror
  BsdfSample sample(Vec2 u, float choice) const;
  // A direction of the specular lobe alone; weight f_specular cos / pdf of that lobe. Not valid where it would enter
// the surface.
  BsdfSample sampleSpecular(Vec2 u) const;

  // Directional albedo, per channel: all light reflected towards wo under a uniform hemisphere of 1.
  Vec3 albedo() const { return specularAlbedo_ + diffuseAlbedo_; }
  Vec3 specularAlbedo() const { return specularAlbedo_; }
  Vec3 diffuseAlbedo() const { return diffuseAlbedo_; }
  bool isMirrorOnly() const { return mirror_ && isBlack(diffuseAlbedo_); }
  float alpha() const { return alpha_; }

 private:
  Vec3 diffuse(float cosI) const;
  bool hasLobe() const { return !mirror_ && specularChance_ > 0; }
  float pdfLocal(Vec3 wi) const {
    const float p = (1 - specularChance_) * wi.z / kPi;
    return hasLobe() ? p + specularChance_ * lobePdf(wi) : p;
  }
  // Of the specular lobe towards wi, local. Density: G1 D / (4 cos), with D written for a half vector of any length.
  float lobePdf(Vec3 wi) const {
    const Vec3 h = wi + wo_;
    const float xy = h.x * h.x + h.y * h.y, z2 = h.z * h.z, q = (xy + z2) / (xy + alpha_ * alpha_ * z2);
    return lobeScale_ * q * q;
  }
  // F G2 / G1: evaluateSpecular() over that density.
  Vec3 lobeWeight(Vec3 wi) const {
    const Vec3 h = wi + wo_;
    const float c2 = wi.z * wi.z, root = std::sqrt(c2 + alpha_ * alpha_ * std::max(0.0f, 1 - c2));
    return fresnelSchlick(f0_, f90_, dot(wo_, h) / length(h)) *
           ((1 + lambda_) * wi.z / ((0.5f + lambda_) * wi.z + 0.5f * root));
  }

  Frame frame_;
  Vec3 ng_, wo_;  // wo in the frame
  Vec3 f0_, f90_, base_;
  float roughness_, alpha_, diffuseScale_, specularChance_;
  float lambda_, lobeScale_;  // ggxLambda() of wo; what is constant in lobePdf()
  Vec3 specularAlbedo_, diffuseAlbedo_;
  bool mirror_;
};

}  // namespace roomlight
