#include "trace/lamp_light.h"

#include "base/sampling.h"
#include "photometry/spot.h"

namespace roomlight {
namespace {

// Axes of a web in the world: x towards C0, y towards C90, z away from the nadir.
struct WebAxes {
  Vec3 x, y, z;
  WebAxes(Vec3 nadir, Vec3 c0) : x(c0), y(cross(-nadir, c0)), z(-nadir) {}
  Vec3 toWeb(Vec3 v) const { return {dot(v, x), dot(v, y), dot(v, z)}; }
  Vec3 toWorld(Vec3 v) const { return x * v.x + y * v.y + z * v.z; }
};

}  // namespace

Vec3 lampIntensity(const Lamp& lamp, Vec3 direction) {
  if (lamp.web)
    return lamp.intensityCd *
           (intensityCd(*lamp.web, WebAxes(lamp.direction, lamp.up).toWeb(direction)) / lamp.web->peakCd);
  if (lamp.kind == LampKind::Point) return lamp.intensityCd;
  return lamp.intensityCd *
         spotFalloff(dot(direction, lamp.direction), std::cos(lamp.innerConeRad), std::cos(lamp.outerConeRad));
}

Vec3 lampPlace(const Lamp& lamp, Vec2 u) {
  if (!lamp.extended) return lamp.position;
  const Vec2 s = lamp.web->round ? sampleDisc(u) : Vec2{2 * u.x - 1, 2 * u.y - 1};
  const WebAxes axes(lamp.direction, lamp.up);
  return lamp.position + axes.x * (0.5f * lamp.web->sizeC0M * s.x) + axes.y * (0.5f * lamp.web->sizeC90M * s.y);
}

LightSample sampleLamp(const Lamp& lamp, Vec3 p, Vec2 u) {
  LightSample s;
  const Vec3 d = lampPlace(lamp, u) - p;
  s.distance = length(d);
  if (s.distance < 1e-4f) return s;
  s.wi = d / s.distance;
  s.radiance = lampIntensity(lamp, -s.wi) / (s.distance * s.distance);
  return s;
}

LampDirections::LampDirections(const Lamp& lamp, std::shared_ptr<const WebSampler> sampler)
    : sampler_(std::move(sampler)), direction_(lamp.direction), up_(lamp.up) {
  if (lamp.web) {
    if (!sampler_) sampler_ = std::make_shared<const WebSampler>(*lamp.web);
    fluxPerCandela_ = static_cast<float>(lamp.web->fluxLm) / lamp.web->peakCd;
    return;
  }
  if (lamp.kind == LampKind::Spot) {
    const float s = std::sin(0.5f * lamp.outerConeRad);
    oneMinusCos_ = std::clamp(2 * s * s, 1e-6f, 2.0f);
  }
  fluxPerCandela_ = 2 * kPi * oneMinusCos_;
}

Vec3 LampDirections::sample(Vec2 u, float& pdf) const {
  if (sampler_) return WebAxes(direction_, up_).toWorld(sampler_->sample(u, pdf));
  pdf = conePdf(oneMinusCos_);
  return oneMinusCos_ >= 2 ? sampleSphere(u) : Frame(direction_).toWorld(sampleCone(u, oneMinusCos_));
}

float LampDirections::pdf(Vec3 direction) const {
  if (sampler_) return sampler_->pdf(WebAxes(direction_, up_).toWeb(direction));
  return oneMinusCos_ >= 2 || dot(direction, direction_) > 1 - oneMinusCos_ ? conePdf(oneMinusCos_) : 0;
}

}  // namespace roomlight
