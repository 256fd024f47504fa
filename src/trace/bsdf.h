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
  float pdf(Vec3 wi) const;
  BsdfValue value(Vec3 wi) const;        // evaluate() and pdf(), for less than both
  float pdfSpecular(Vec3 wi) const;  // of sampleSpecular; 0 for a mirror
  BsdfSample sample(Vec2 u, float choice) const;
  // A direction of the specular lobe alone; weight f_specular cos / pdf of that lobe. Not valid where it would enter the surface.
  BsdfSample sampleSpecular(Vec2 u) const;

  // Directional albedo, per channel: all light reflected towards wo under a uniform hemisphere of 1.
  Vec3 albedo() const { return specularAlbedo_ + diffuseAlbedo_; }
  Vec3 specularAlbedo() const { return specularAlbedo_; }
  Vec3 diffuseAlbedo() const { return diffuseAlbedo_; }
  bool isMirrorOnly() const { return mirror_ && isBlack(diffuseAlbedo_); }
  float alpha() const { return alpha_; }

 private:
  Vec3 diffuse(float cosI) const;
  // Of the specular lobe towards wi, local: density, and evaluate() without Fresnel is density times what follows it.
  struct Lobe {
    float cosH;  // between wi and the half vector
    float pdf;   // G1 D / 4 cos
    float toValue;
  };
  Lobe lobe(Vec3 wi) const;

  Frame frame_;
  Vec3 ng_, wo_;  // wo in the frame
  Vec3 f0_, f90_, base_;
  float roughness_, alpha_, lambda_, diffuseScale_, specularChance_;  // lambda_: ggxLambda() of wo
  Vec3 specularAlbedo_, diffuseAlbedo_;
  bool mirror_;
};

}  // namespace roomlight
