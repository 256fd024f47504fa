#include "radiance/near_lights.h"

#include <array>
#include <atomic>
#include <bit>
#include <numeric>

#include "base/parallel.h"
#include "base/sampling.h"
#include "radiance/radiance_field.h"

namespace roomlight {
namespace {

constexpr float kSmallest =
    0.1f; // voxels²; smaller slots may get light meant for a neighbour, too much on so small an area
constexpr size_t kMostParticles = size_t{1} << 18, kMostPerSource = size_t{1} << 15, kFewestPerSource = size_t{1} << 12,
                 kChunk = 512, kFewestPerLamp = kChunk;
constexpr int kMostReflections = 64;
constexpr size_t kFirstLook = 4;
constexpr size_t kLampsAtOnce = 64;  // of which trails are in memory
constexpr float kAwayM = 1000;   // of what leaves the scene
constexpr float kWithin = 2;     // voxels: so far at most from a slot's place lie hits on the surface it stands for

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

// Of each of many lamps that are lit together: those beside one place send theirs to the same slots.
size_t particlesPerLamp(size_t lamps) {
  return std::clamp(kMostParticles / lamps, kFewestPerLamp, kMostPerSource) / kChunk * kChunk;
}

// Surfaces behind the foremost take no light: a flat one fills no more of a voxel than this.
float litArea(const FaceSlot& slot, float h) {
  return std::clamp(slot.areaM2, kSmallest * h * h, h * h / std::max(0.577f, maxComponent(abs(slot.normal))));
}

class Particles {
 public:
  // `pointLm`: luminous flux that a point stands for.
  Particles(const SlotSampling& slots, const ParticleSource& source, Attenuation attenuation, float pointLm)
      : slots_(slots), source_(source), attenuation_(attenuation), pointLm_(pointLm) {}
  Particles(const SlotSampling& slots, const ParticleSource& source, Attenuation attenuation)
      : Particles(slots, source, attenuation,
                  source.fluxLm / std::min(kGlowPoints, static_cast<float>(source.particles))) {}

  // Some of a chunk step by step together, so that they can be traced together. Added to `trail`.
  void trace(size_t chunk, std::span<const uint16_t> which, ParticleTrail& trail) const {
    std::vector<Flight> flights;
    std::vector<Ray> rays;
    std::vector<Sampler> samplers;
    for (const uint16_t i : which) {
      const auto number = static_cast<uint32_t>(chunk * kChunk + i);
      Sampler sampler(source_.key, number, slots_.seed + 7);
      const LightRay ray = source_.ray(sampler);
      rays.emplace_back(ray.origin, ray.direction, 0, kInfinity);
      samplers.emplace_back(source_.key, number, slots_.seed + 8);
      flights.push_back({ray.fluxLm / static_cast<float>(source_.particles), i});
    }
    for (int k = 0; k < kMostReflections && !rays.empty(); ++k) step(k > 0, rays, samplers, flights, trail);
  }

 private:
  struct Flight {
    Vec3 fluxLm;
    uint16_t particle;
  };
  // Light that leaves a surface.
  struct Reflected {
    Vec3 p, n;
    const Material& material;
    Vec3 fluxLm;
    int64_t slot;
    uint16_t particle;
  };

  // From slot to slot while these are near the source. What falls on another slot straight from it is not ours.
  void step(bool reflected, std::vector<Ray>& rays, std::vector<Sampler>& samplers, std::vector<Flight>& flights,
            ParticleTrail& trail) const {
    std::vector<Arrival> ends;
    std::vector<HiddenReflection> hidden;
    slots_.paths.follow(rays, samplers, ends, &hidden);
    std::vector<Bounds3> bent(hidden.empty() ? 0 : rays.size());
    for (const HiddenReflection& h : hidden) {
      bent[h.ray].add(h.p);
      if (source_.around.contains(h.p) && !isLeftToRays(*h.material))
        addPoints({h.p, h.n, *h.material, flights[h.ray].fluxLm * h.left, -1, flights[h.ray].particle}, samplers[h.ray],
                  trail);
    }
    size_t live = 0;
    for (size_t i = 0; i < rays.size(); ++i) {
      const Arrival& end = ends[i];
      const auto s = static_cast<size_t>(end.slot);
      const bool arrives = end.slot >= 0;
      const SurfacePlace place = arrives ? slots_.paths.place(end) : SurfacePlace{};
      addSegment(rays[i], end, arrives ? place.p : end.ray.origin + end.ray.direction * kAwayM,
                 bent.empty() ? Bounds3() : bent[i], flights[i].particle, trail);
      if (!arrives) continue;
      const FaceSlot& slot = slots_.voxels.slots[s];
      const bool isNear = source_.around.contains(slot.position), indirect = reflected || end.reflected;
      if (!indirect && !isNear) continue;
      Vec3 flux = flights[i].fluxLm * end.left;
      const float facing = -dot(slot.normal, end.ray.direction);
      if (!indirect && facing > 0.05f) flux *= attenuation(attenuation_, slot.normal, -end.ray.direction) / facing;
      const bool carriedOn = isNear && !isLeftToRays(*place.material);
      trail.deposits.push_back({flux, static_cast<uint32_t>(s), flights[i].particle, carriedOn});
      if (!carriedOn) continue;
      const Vec3 albedo = slots_.paths.albedo(end);
      Sampler sampler = samplers[i];
      addPoints({place.p, place.ng, *place.material, flux * albedo, end.slot, flights[i].particle}, sampler, trail);
      const float survive = std::min(0.95f, maxComponent(albedo));
      if (sampler.next1() >= survive) continue;
      rays[live] = {offsetOrigin(place.p, place.ng), Frame(place.ng).toWorld(sampleCosineHemisphere(sampler.next2())),
                    0, kInfinity};
      samplers[live] = sampler;
      flights[live++] = {flux * (albedo / survive), flights[i].particle};
    }
    rays.erase(rays.begin() + static_cast<std::ptrdiff_t>(live), rays.end());
    samplers.erase(samplers.begin() + static_cast<std::ptrdiff_t>(live), samplers.end());
    flights.erase(flights.begin() + static_cast<std::ptrdiff_t>(live), flights.end());
  }

  void addSegment(const Ray& ray, const Arrival& end, Vec3 to, Bounds3 bent, uint16_t particle,
                  ParticleTrail& trail) const {
    if (!end.reflected) return trail.ways.push_back({ray.origin, to, particle, true});
    for (const Vec3 p : {ray.origin, end.ray.origin, to}) bent.add(p);
    trail.ways.push_back({bent.lo, bent.hi, particle, false});
  }

  bool isLeftToRays(const Material& m) const { return source_.isSurface && isPolishedMetal(m); }

  // As many points as the flux asks for on average, each of `pointLm_`.
  void addPoints(const Reflected& r, Sampler& sampler, ParticleTrail& trail) const {
    const float luminous = luminance(r.fluxLm), copies = std::floor(luminous / pointLm_ + sampler.fast1());
    for (float k = 0; k < copies; ++k)
      trail.points.push_back({{offsetOrigin(r.p, r.n), r.n, r.fluxLm * (pointLm_ / luminous), r.slot, 0,
                               isPolishedMetal(r.material), -1, -1},
                              r.particle});
  }

  const SlotSampling slots_;
  const ParticleSource& source_;
  const Attenuation attenuation_;
  const float pointLm_;
};

// What trails hold together. In order, so that sums do not depend on threads.
class Sums {
 public:
  explicit Sums(const Voxels& voxels) : voxels_(voxels), near_(voxels.slots.size()), far_(voxels.slots.size()) {}
  void add(const ParticleTrail& trail, Vec3 scale, int32_t lamp, std::vector<GlowPoint>& points) {
    for (const ParticleTrail::Point& p : trail.points) {
      GlowPoint& g = points.emplace_back(p.glow);
      g.fluxLm *= scale, g.lamp = lamp;
    }
    for (const ParticleTrail::Deposit& d : trail.deposits)
      (d.near ? near_ : far_)[d.slot] += d.fluxLm * scale / litArea(voxels_.slots[d.slot], voxels_.voxelSizeM);
  }
  void finish(ParticleLight& light) const {
    light.near = SlotLight(voxels_, near_), light.far = SlotLight(voxels_, far_);
  }

 private:
  const Voxels& voxels_;
  std::vector<Vec3> near_, far_;
};

void addUp(const Voxels& voxels, ParticleLight& light) {
  Sums sums(voxels);
  light.points.clear();
  for (const ParticleTrail& trail : light.trails) sums.add(trail, Vec3(1), -1, light.points);
  sums.finish(light);
}

// What of a trail stays: the numbers of particles that do not are left in `again`.
class Keeper {
 public:
  Keeper(const SlotChange& change, float voxelSizeM) : remap_(change.remap), places_(change.places), h_(voxelSizeM) {
    for (const Bounds3& box : places_) around_.add(box);
  }

  void keep(ParticleTrail& trail, std::vector<uint16_t>& again) const {
    std::array<bool, kChunk> gone{};
    for (ParticleTrail::Deposit& d : trail.deposits) {
      d.slot = remap_.newSlot[d.slot];
      if (d.slot == SlotRemap::kGone) gone[d.particle] = true;
    }
    for (const ParticleTrail::Piece& way : trail.ways) gone[way.particle] = gone[way.particle] || touches(way);
    for (uint16_t i = 0; i < kChunk; ++i) {
      if (gone[i]) again.push_back(i);
    }
    for (ParticleTrail::Point& p : trail.points) {
      if (p.glow.slot >= 0 && !gone[p.particle])
        p.glow.slot = static_cast<int64_t>(remap_.newSlot[static_cast<size_t>(p.glow.slot)]);
    }
    const auto isGone = [&](const auto& x) { return gone[x.particle]; };
    std::erase_if(trail.deposits, isGone), std::erase_if(trail.points, isGone), std::erase_if(trail.ways, isGone);
  }

 private:
  // Surfaces as far from a way's end as the slot that stands for them may decide which one that is.
  bool touches(const ParticleTrail::Piece& way) const {
    const float off = kWithin * h_;
    if (!way.straight)
      return std::any_of(places_.begin(), places_.end(), [&](const Bounds3& place) {
        return overlap({way.from, way.to}, place, off);
      });
    const Vec3 d = way.to - way.from;
    const float metres = length(d);
    const Ray ray{way.from, metres > 0 ? d / metres : Vec3{0, 0, 1}, 0, metres + off};
    return crosses(ray, {&around_, 1}, h_) && crosses(ray, places_, h_);
  }

  const SlotRemap& remap_;
  std::span<const Bounds3> places_;
  const float h_;
  Bounds3 around_;
};

}  // namespace

ParticleSource particlesOf(const Lamp& lamp, size_t lamps, float voxelSizeM) {
  Lamp unit = lamp;
  unit.intensityCd = Vec3(1);
  const LampDirections directions(lamp);
  const auto ray = [unit, directions](Sampler& sampler) {
    float pdf = 0;
    const Vec3 direction = directions.sample(sampler.next2(), pdf);
    return LightRay{lampPlace(unit, unit.extended ? sampler.next2() : Vec2{}), direction,
                    lampIntensity(unit, direction) / pdf};
  };
  return {LightSurroundings(lamp, voxelSizeM),
          keyOf({lamp.position, lamp.direction}),
          directions.fluxPerCandela(),
          particlesFor(1, lamps),
          false,
          ray};
}

// Large surroundings get more, so that slots far from it get as many as those of a point would.
ParticleSource particlesOf(const Lights& lights, size_t emitter, size_t emitters, float voxelSizeM) {
  const Bounds3& box = lights.emitterBounds(emitter);
  const LightSurroundings around(box, voxelSizeM);
  const auto ray = [&lights, emitter](Sampler& sampler) { return lights.sampleEmitterRay(emitter, sampler); };
  return {around,
          keyOf({box.lo, box.hi}),
          lights.emitterFluxLm(emitter),
          particlesFor(around.sizeOfPoints(), emitters),
          true,
          ray};
}

void ParticleSource::takeFewer() { particles = std::max(kChunk, particles / kFirstLook / kChunk * kChunk); }

void ParticleLight::scale(Vec3 by) {
  near.scale(by), far.scale(by);
  for (GlowPoint& g : points) g.fluxLm *= by;
  for (ParticleTrail& trail : trails) {
    for (ParticleTrail::Deposit& d : trail.deposits) d.fluxLm *= by;
    for (ParticleTrail::Point& p : trail.points) p.glow.fluxLm *= by;
  }
  fluxLm *= luminance(by);
}

size_t ParticleLight::bytes() const {
  size_t sum = near.bytes() + far.bytes() + points.size() * sizeof(points[0]);
  for (const ParticleTrail& t : trails)
    sum += t.deposits.size() * sizeof(t.deposits[0]) + t.points.size() * sizeof(t.points[0]) +
           t.ways.size() * sizeof(t.ways[0]);
  return sum;
}

ParticleLight traceParticles(const SlotSampling& slots, const ParticleSource& source, Attenuation attenuation,
                             const Progress& progress) {
  ParticleLight light;
  const Particles particles(slots, source, attenuation);
  std::array<uint16_t, kChunk> all;
  std::iota(all.begin(), all.end(), uint16_t{0});
  light.trails.resize(source.particles / kChunk);
  parallelFor(light.trails.size(), 1, [&](size_t chunk) {
    if (!progress.stop()) particles.trace(chunk, all, light.trails[chunk]);
  });
  addUp(slots.voxels, light);
  light.rays = source.particles;
  light.fluxLm = source.fluxLm;
  return light;
}

bool hasSurfaces(const Voxels& voxels, const LightSurroundings& around) {
  const Bounds3 box = around.bounds();
  const auto brickOf = [&](Vec3 p) {
    const Vec3 q = (p - voxels.origin) / (voxels.voxelSizeM * kBrickSize);
    const auto within = [](float x, int dim) {
      return static_cast<int>(std::clamp(std::floor(x), 0.0f, static_cast<float>(dim - 1)));
    };
    return Int3{within(q.x, voxels.brickDims.x), within(q.y, voxels.brickDims.y), within(q.z, voxels.brickDims.z)};
  };
  const Int3 lo = brickOf(box.lo), hi = brickOf(box.hi);
  for (int z = lo.z; z <= hi.z; ++z) {
    for (int y = lo.y; y <= hi.y; ++y) {
      for (int x = lo.x; x <= hi.x; ++x) {
        const int32_t b = voxels.brickAt({x, y, z});
        if (b < 0 || !around.touches(boundsOfBrick(voxels, static_cast<size_t>(b)))) continue;
        const auto [first, last] = slotsOfBrick(voxels, static_cast<size_t>(b));
        for (size_t s = first; s < last; ++s) {
          if (around.contains(voxels.slots[s].position)) return true;
        }
      }
    }
  }
  return false;
}

ParticleLight traceLampParticles(const SlotSampling& slots, const Lights& lights, Attenuation attenuation,
                                 const Progress& progress) {
  const Voxels& voxels = slots.voxels;
  struct Lit {
    int32_t lamp;
    ParticleSource source;
  };
  std::vector<Lit> lit;
  ParticleLight light;
  const auto luminous = [&](const Lit& one) {
    return luminance(lights.lamp(static_cast<size_t>(one.lamp)).intensityCd);
  };
  for (size_t i = 0; i < lights.lampCount(); ++i) {
    Lit one{static_cast<int32_t>(i), particlesOf(lights.lamp(i), 1, voxels.voxelSizeM)};
    if (!hasSurfaces(voxels, one.source.around)) continue;
    one.source.particles = particlesPerLamp(lights.lampCount());
    light.fluxLm += luminous(one) * one.source.fluxLm, light.rays += one.source.particles;
    lit.push_back(std::move(one));
  }
  std::array<uint16_t, kChunk> all;
  std::iota(all.begin(), all.end(), uint16_t{0});
  Sums sums(voxels);
  for (size_t first = 0; first < lit.size() && !progress.stop(); first += kLampsAtOnce) {
    const std::span<const Lit> some = std::span(lit).subspan(first, std::min(kLampsAtOnce, lit.size() - first));
    std::vector<ParticleTrail> trails(some.size());
    parallelFor(some.size(), 1, [&](size_t k) {
      const Particles particles(slots, some[k].source, attenuation, light.fluxLm / (kGlowPoints * luminous(some[k])));
      for (size_t chunk = 0; chunk < some[k].source.particles / kChunk; ++chunk) particles.trace(chunk, all, trails[k]);
    });
    for (size_t k = 0; k < some.size(); ++k)
      sums.add(trails[k], lights.lamp(static_cast<size_t>(some[k].lamp)).intensityCd, some[k].lamp, light.points);
  }
  sums.finish(light);
  return light;
}

void updateParticles(const SlotSampling& slots, const ParticleSource& source, Attenuation attenuation,
                     const SlotChange& change, const Progress& progress, ParticleLight& light) {
  ParticleSource same = source;
  same.particles = light.trails.size() * kChunk;  // of as many sources as there were
  const Particles particles(slots, same, attenuation);
  const Keeper keeper(change, slots.voxels.voxelSizeM);
  std::atomic<uint64_t> traced = 0;
  parallelFor(light.trails.size(), 1, [&](size_t chunk) {
    if (progress.stop()) return;
    std::vector<uint16_t> again;
    keeper.keep(light.trails[chunk], again);
    particles.trace(chunk, again, light.trails[chunk]);
    traced += again.size();
  });
  if (progress.stop()) return;
  addUp(slots.voxels, light);
  light.rays = traced;
}

}  // namespace roomlight
