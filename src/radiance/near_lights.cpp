#include "radiance/near_lights.h"

#include <bit>

#include "base/parallel.h"
#include "base/sampling.h"
#include "radiance/attenuation.h"

namespace roomlight {
namespace {

constexpr float kSmallest = 0.1f; // voxels²; smaller slots may get light meant for a neighbour, too much on so small an area
constexpr size_t kMostParticles = size_t{1} << 18, kMostPerSource = size_t{1} << 15, kFewestPerSource = size_t{1} << 12, kChunk = 512;
constexpr int kMostReflections = 64;

uint64_t keyOf(std::initializer_list<Vec3> values) {
  uint64_t key = 0;
  for (const Vec3& v : values) {
    for (const float x : {v.x, v.y, v.z}) key = mix64(key + std::bit_cast<uint32_t>(x) + 0x9e3779b97f4a7c15ull);
  }
  return key;
}

// Of `sources` that share all particles, and in whole chunks.
size_t particlesFor(float sizeOfPoints, size_t sources) {
  const size_t each = std::clamp(kMostParticles / sources, kFewestPerSource, kMostPerSource);
  return static_cast<size_t>(static_cast<float>(each) * sizeOfPoints) / kChunk * kChunk;
}

// Surfaces behind the foremost take no light: a flat one fills no more of a voxel than this.
float litArea(const FaceSlot& slot, float h) { return std::clamp(slot.areaM2, kSmallest * h * h, h * h / std::max(0.577f, maxComponent(abs(slot.normal)))); }

struct Deposit {
  uint32_t slot;
  Vec3 fluxLm;
  bool near;  // carried on
};

// What a chunk of particles leaves behind.
struct Trail {
  std::vector<Deposit> deposits;
  std::vector<GlowPoint> points;
  Bounds3 way;
};

class Particles {
 public:
  Particles(const RayScene& rays, const Voxels& voxels, const SlotPaths& paths, const ParticleSource& source, const RadianceSettings& settings)
      : rays_(rays), voxels_(voxels), paths_(paths), source_(source), settings_(settings), pointLm_(source.fluxLm / std::min(kGlowPoints, static_cast<float>(source.particles))) {}

  // All of a chunk step by step together, so that they can be traced together.
  Trail trace(size_t chunk) const {
    Trail trail;
    std::vector<Ray> rays;
    std::vector<Sampler> samplers;
    std::vector<Vec3> fluxLm;
    for (size_t i = 0; i < kChunk; ++i) {
      Sampler sampler(source_.key, static_cast<uint32_t>(chunk * kChunk + i), settings_.seed + 7);
      const LightRay ray = source_.ray(sampler);
      trail.way.add(ray.origin);
      rays.emplace_back(ray.origin, ray.direction, 0, kInfinity);
      samplers.emplace_back(source_.key, static_cast<uint32_t>(chunk * kChunk + i), settings_.seed + 8);
      fluxLm.push_back(ray.fluxLm / static_cast<float>(source_.particles));
    }
    for (int k = 0; k < kMostReflections && !rays.empty(); ++k) step(k > 0, rays, samplers, fluxLm, trail);
    return trail;
  }

 private:
  // From slot to slot while these are near the source. What falls on another slot straight from it is not ours.
  void step(bool reflected, std::vector<Ray>& rays, std::vector<Sampler>& samplers, std::vector<Vec3>& fluxLm, Trail& trail) const {
    std::vector<Arrival> ends;
    std::vector<HiddenReflection> hidden;
    paths_.follow(rays, samplers, ends, &hidden);
    for (const HiddenReflection& h : hidden) {
      trail.way.add(h.p);
      if (source_.around.contains(h.p) && !isLeftToRays(*h.material)) reflectedAt(h.p, h.n, fluxLm[h.ray] * h.left, -1, samplers[h.ray], trail);
    }
    size_t live = 0;
    for (size_t i = 0; i < rays.size(); ++i) {
      const Arrival& end = ends[i];
      if (end.escaped) trail.way = {Vec3(-kInfinity), Vec3(kInfinity)};
      if (end.slot < 0) continue;
      const auto s = static_cast<size_t>(end.slot);
      const FaceSlot& slot = voxels_.slots[s];
      const bool isNear = source_.around.contains(slot.position), indirect = reflected || end.reflected;
      if (!indirect && !isNear) continue;
      const SurfacePlace place = paths_.place(end);
      trail.way.add(place.p);
      Vec3 flux = fluxLm[i] * end.left;
      const float facing = -dot(slot.normal, end.ray.direction);
      if (!indirect && facing > 0.05f) flux *= attenuation(settings_.attenuation, slot.normal, -end.ray.direction) / facing;
      const bool carriedOn = isNear && !isLeftToRays(*place.material);
      trail.deposits.push_back({static_cast<uint32_t>(s), flux, carriedOn});
      if (!carriedOn) continue;
      const Vec3 albedo = paths_.albedo(end);
      Sampler sampler = samplers[i];
      reflectedAt(place.p, place.ng, flux * albedo, end.slot, sampler, trail);
      const float survive = std::min(0.95f, maxComponent(albedo));
      if (sampler.next1() >= survive) continue;
      rays[live] = {offsetOrigin(place.p, place.ng), Frame(place.ng).toWorld(sampleCosineHemisphere(sampler.next2())), 0, kInfinity};
      samplers[live] = sampler;
      fluxLm[live++] = flux * (albedo / survive);
    }
    rays.erase(rays.begin() + static_cast<std::ptrdiff_t>(live), rays.end());
    samplers.erase(samplers.begin() + static_cast<std::ptrdiff_t>(live), samplers.end());
    fluxLm.erase(fluxLm.begin() + static_cast<std::ptrdiff_t>(live), fluxLm.end());
  }

  bool isLeftToRays(const Material& m) const { return source_.isSurface && isPolishedMetal(m); }

  // As many points as the flux asks for on average, each of `pointLm_`.
  void reflectedAt(Vec3 p, Vec3 n, Vec3 flux, int64_t slot, Sampler& sampler, Trail& trail) const {
    const float luminous = luminance(flux), copies = std::floor(luminous / pointLm_ + sampler.fast1());
    for (float k = 0; k < copies; ++k) trail.points.push_back({offsetOrigin(p, n), n, flux * (pointLm_ / luminous), slot, 0, -1, -1});
  }

  const RayScene& rays_;
  const Voxels& voxels_;
  const SlotPaths& paths_;
  const ParticleSource& source_;
  const RadianceSettings& settings_;
  const float pointLm_;
};

}  // namespace

ParticleSource particlesOf(const Lamp& lamp, size_t lamps, float voxelSizeM) {
  Lamp unit = lamp;
  unit.intensityCd = Vec3(1);
  const LampDirections directions(lamp);
  const auto ray = [unit, directions](Sampler& sampler) {
    float pdf = 0;
    const Vec3 direction = directions.sample(sampler.next2(), pdf);
    return LightRay{lampPlace(unit, unit.extended ? sampler.next2() : Vec2{}), direction, lampIntensity(unit, direction) / pdf};
  };
  return {LightSurroundings(lamp, voxelSizeM), keyOf({lamp.position, lamp.direction}), directions.fluxPerCandela(), particlesFor(1, lamps), false, ray};
}

// Large surroundings get more, so that slots far from it get as many as those of a point would.
ParticleSource particlesOf(const Lights& lights, size_t emitter, size_t emitters, float voxelSizeM) {
  const Bounds3& box = lights.emitterBounds(emitter);
  const LightSurroundings around(box, voxelSizeM);
  const auto ray = [&lights, emitter](Sampler& sampler) { return lights.sampleEmitterRay(emitter, sampler); };
  return {around, keyOf({box.lo, box.hi}), lights.emitterFluxLm(emitter), particlesFor(around.sizeOfPoints(), emitters), true, ray};
}

void ParticleLight::scale(Vec3 by) {
  near.scale(by), far.scale(by);
  for (GlowPoint& g : points) g.fluxLm *= by;
  fluxLm *= luminance(by);
}

ParticleLight traceParticles(const RayScene& rays, const Voxels& voxels, const SlotPaths& paths, const ParticleSource& source, const RadianceSettings& settings, const Progress& progress) {
  ParticleLight light;
  const size_t n = source.particles;
  const Particles particles(rays, voxels, paths, source, settings);
  std::vector<Trail> trails(n / kChunk);
  parallelFor(trails.size(), 1, [&](size_t chunk) {
    if (!progress.stop()) trails[chunk] = particles.trace(chunk);
  });
  std::vector<Vec3> near(voxels.slots.size()), far(voxels.slots.size());
  // In order, so that sums do not depend on threads.
  for (const Trail& trail : trails) {
    light.points.insert(light.points.end(), trail.points.begin(), trail.points.end());
    light.way.add(trail.way);
    for (const Deposit& d : trail.deposits) {
      const FaceSlot& slot = voxels.slots[d.slot];
      (d.near ? near : far)[d.slot] += d.fluxLm / litArea(slot, voxels.voxelSizeM);
    }
  }
  light.near = SlotLight(voxels, near), light.far = SlotLight(voxels, far);
  light.rays = n;
  light.fluxLm = source.fluxLm;
  return light;
}

}  // namespace roomlight
