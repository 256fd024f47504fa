// How light reaches a point, before visibility, and that of one point or spot lamp.
#pragma once

#include <cstdint>
#include <memory>

#include "base/vec.h"
#include "photometry/photometric_web.h"
#include "scene/scene.h"

namespace roomlight {

// One way light may reach a point, before visibility.
struct LightSample {
  Vec3 wi;            // unit, towards the light
  float distance = kInfinity;
  Vec3 radiance;  // incident radiance / pdf: times f cos is the estimate. Delta lights: intensity / distance² / chance
  float pdf = 0;  // per steradian, selection included; 0: delta light, no other strategy can find it
  int32_t lamp = -1;  // of which point or spot lamp (see Lights), -1: none
  int32_t emitter = -1;  // of which emissive mesh, -1: none
  bool valid() const { return !isBlack(radiance); }
};

// Intensity of a lamp towards a unit direction away from it; the spot's falloff is KHR_lights_punctual's.
Vec3 lampIntensity(const Lamp& lamp, Vec3 direction);

// Whether all its light leaves it in one place.
inline bool isSharp(const Lamp& lamp) { return lamp.kind != LampKind::Area && !lamp.extended; }

// Where light leaves it: its position, or a place of its opening, even over the area.
Vec3 lampPlace(const Lamp& lamp, Vec2 u);

// From one such place to p. An extended lamp is the mean over its places, each of which shines as the whole would from
// there: from afar that is the web, and for a Lambertian web it is the luminous panel from anywhere.
LightSample sampleLamp(const Lamp& lamp, Vec3 p, Vec2 u);

// Directions in which rays leave a lamp: of a web as its light goes, else even over the sphere or the spot's cone.
class LampDirections {
 public:
  // `sampler`: of the lamp's web, for lamps that share it; made anew where there is none.
  explicit LampDirections(const Lamp& lamp, std::shared_ptr<const WebSampler> sampler = {});

  Vec3 sample(Vec2 u, float& pdf) const;  // pdf: per steradian
  float pdf(Vec3 direction) const;
  // Flux per candela of intensityCd, lm/cd; of a spot that of its cone without falloff.
  float fluxPerCandela() const { return fluxPerCandela_; }

 private:
  std::shared_ptr<const WebSampler> sampler_;
  Vec3 direction_, up_;
  float oneMinusCos_ = 2;  // of the cone that holds all light, without a web
  float fluxPerCandela_;
};

}  // namespace roomlight
