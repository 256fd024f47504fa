#include "radiance/light_sources.h"

#include <algorithm>
#include <utility>

#include "base/parallel.h"
#include "radiance/sun_bounce.h"

namespace roomlight {

SlotLight LightTracing::lightOfAll(const OfBrick& ofBrick) const {
  std::vector<Vec3> lux(voxels.slots.size());
  parallelFor(voxels.bricks.size(), 4, [&](size_t b) {
    if (!progress.stop()) ofBrick(b, lux);
  });
  return SlotLight(voxels, lux);
}

SlotLight LightTracing::updated(const SlotLight& before, const SlotChange& change, const BrickTracer& trace) const {
  std::vector<Vec3> lux(voxels.slots.size());
  parallelFor(voxels.bricks.size(), 4, [&](size_t b) {
    if (progress.stop()) return;
    const bool keeps = change.remap.keeps(b);
    if (keeps) {
      const auto [first, last] = slotsOfBrick(voxels, b);
      before.copyBrick(static_cast<size_t>(change.remap.oldBrick[b]), last - first, std::span(lux).subspan(first));
    }
    if (!keeps || !change.places.empty()) trace(b, keeps ? change.places : std::span<const Bounds3>(), lux);
  });
  return SlotLight(voxels, lux);
}

ParticleLight LightTracing::particlesFrom(ParticleSource source) const {
  if (progress.stop() || !hasSurfaces(voxels, source.around)) return {};
  if (fewParticles) source.takeFewer();
  ParticleLight light = traceParticles(slots(), source, settings.attenuation, progress);
  rayCount += light.rays;
  light.few = fewParticles;
  if (settings.still) light.trails = {};  // they tell what moved things change
  return light;
}

void LightTracing::update(const SlotChange& change, const ParticleSource& source, ParticleLight& particles) const {
  if (particles.trails.empty()) {  // there was no surface near it
    const bool mayBe = std::any_of(change.places.begin(), change.places.end(),
                                   [&](const Bounds3& place) { return source.around.touches(place); });
    if (mayBe) particles = particlesFrom(source);
    return;
  }
  updateParticles(slots(), source, settings.attenuation, change, progress, particles);
  rayCount += particles.rays;
}

void DaylightSource::trace(const LightTracing& t, const Links& links, const SkyGuide& othersGuide,
                           std::vector<GlowPoint>& sunPoints) {
  DirectLight direct = t.direct();
  suns_ = sky_ = {};
  ways_.clear();
  if (t.lights.sunCount() > 0) suns_ = t.lightOfAll([&](size_t b, std::vector<Vec3>& lux) { direct.suns(b, {}, lux); });
  sunPoints.clear();
  if (t.settings.still && t.lights.sunCount() == 1 && !suns_.empty() && !t.progress.stop()) {
    std::vector<Vec3> sun(t.voxels.slots.size());
    suns_.addTo(t.voxels, Vec3(1), sun);
    sunPoints = sunPlaces({t.rays, t.lights}, t.slots(), links, sun, t.rayCount);
    suns_ = SlotLight(t.voxels, sun);
  }
  if (t.lights.sky().present()) {
    if (othersGuide.guideOfBrick.empty()) ways_.resize(t.voxels.slots.size());
    const DirectLight::SharedSky shared{t.field.guide, othersGuide, links};
    sky_ = t.lightOfAll([&](size_t b, std::vector<Vec3>& lux) {
      if (othersGuide.guideOfBrick.empty()) {
        direct.sky(t.field.guide, b, {}, ways_, lux);
      } else {
        direct.skyWithLinks(shared, b, lux);
      }
    });
  }
  t.rayCount += direct.rayCount();
}

void DaylightSource::update(const LightTracing& t, const SlotChange& change) {
  DirectLight direct = t.direct();
  if (t.lights.sunCount() > 0) {
    suns_ = t.updated(suns_, change,
                      [&](size_t b, std::span<const Bounds3> near, std::span<Vec3> lux) { direct.suns(b, near, lux); });
  }
  if (t.lights.sky().present()) {
    SkyDirections ways(t.voxels.slots.size());
    for (size_t o = 0; o < ways_.size(); ++o) {
      if (change.remap.newSlot[o] != SlotRemap::kGone) ways[change.remap.newSlot[o]] = ways_[o];
    }
    ways_ = std::move(ways);
    sky_ = t.updated(sky_, change, [&](size_t b, std::span<const Bounds3> near, std::span<Vec3> lux) {
      direct.sky(t.field.guide, b, near, ways_, lux);
    });
  }
  t.rayCount += direct.rayCount();
}

}  // namespace roomlight
