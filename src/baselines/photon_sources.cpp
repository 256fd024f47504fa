#include "baselines/photon_sources.h"

#include "radiance/sky_guide.h"

namespace roomlight {
namespace {

constexpr float kBefore = 3e-4f;  // of coordinates: how far before its surface a photon starts

SurfacePieces piecesFor(const Scene& scene, const Lights& lights) {
  return lights.sunCount() > 0 || lights.sky().present() ? SurfacePieces(scene) : SurfacePieces(Scene());
}

}  // namespace

PhotonSources::PhotonSources(const RayScene& rays, const Lights& lights, const PhotonImportance& importance,
                             const SkySurvey& survey)
    : rays_(rays), lights_(lights), survey_(survey), pieces_(piecesFor(rays.scene(), lights)) {
  std::vector<PieceChoice::Found> found;
  for (size_t i = 0; i < lights.sunCount(); ++i) {
    found.clear();
    for (const SunProbe& s : importance.sunProbes(i)) found.push_back({s.p, s.n, s.open * dot(s.d, s.n)});
    suns_.emplace_back(pieces_, importance, found);
  }
  if (!lights.sky().present()) return;
  found.clear();
  for (const SkyProbe& s : importance.skyProbes()) {
    const float light = s.open * luminance(lights.sky().radiance(s.d));
    if (light > 0) found.push_back({s.p, s.n, light});
  }
  sky_.emplace(pieces_, importance, found);
}

PhotonStart PhotonSources::sample(size_t source, Sampler& sampler, uint64_t& rayCount) const {
  if (source < lights_.lampCount()) return {lights_.sampleLampRay(source, sampler)};
  source -= lights_.lampCount();
  if (source < lights_.emitterCount()) return {lights_.sampleEmitterRay(source, sampler)};
  source -= lights_.emitterCount();
  const double choice =
      static_cast<double>(sampler.next1()) + 0x1p-24 * static_cast<double>(sampler.fast1());  // finer than a float
  const Vec2 u = sampler.next2(), direction = sampler.next2();
  const bool sun = source < suns_.size();
  const PieceChoice::Place place = (sun ? suns_[source] : *sky_).sample(choice, u);
  if (sun) return arriving(place, lights_.sampleSun(source, direction), rayCount);
  const int32_t guide = guideAt(survey_.guide, survey_.voxels, place.p, place.n);
  return arriving(place, sampleSkyGuided(survey_.guide, guide, lights_, direction, sampler.next1()), rayCount);
}

PhotonStart PhotonSources::arriving(const PieceChoice::Place& place, const LightSample& light,
                                    uint64_t& rayCount) const {
  PhotonStart start;
  start.arrives = true;
  const float cosine = dot(light.wi, place.n);
  if (!(cosine > 0) || !(place.pdf > 0) || !light.valid()) return start;
  const Vec3 left = rays_.transmittance({offsetOrigin(place.p, place.n), light.wi, 0, kInfinity});
  ++rayCount;
  const float before = kBefore * std::max(1.0f, maxComponent(abs(place.p)));
  start.ray = {place.p + light.wi * before, -light.wi, light.radiance * left * (cosine / place.pdf)};
  return start;
}

}  // namespace roomlight
