#include "radiance/near_lamps.h"

#include <bit>

#include "base/parallel.h"
#include "base/sampling.h"
#include "radiance/attenuation.h"

namespace roomlight {
namespace {

constexpr float kNearVoxels = 4;  // further off a voxel sees the lamp under nearly the same distance everywhere
constexpr float kNearM = 0.5f;    // further off surfaces are no brighter than cones can deal with
constexpr float kSmallest = 0.1f; // voxels²; smaller slots may get light meant for a neighbour, too much on so small an area
constexpr size_t kMostParticles = size_t{1} << 18, kMostPerLamp = size_t{1} << 15, kFewestPerLamp = size_t{1} << 12, kChunk = 512;
constexpr int kMostReflections = 64;
constexpr float kNarrow = 0.5f;      // rad
constexpr float kNarrowVoxels = 8;  // radius of a disc of light

// Half-angle that holds most light of a lamp that has a beam.
float beamRad(const Lamp& lamp) { return lamp.web ? beamHalfAngleRad(*lamp.web) : lamp.kind == LampKind::Spot ? lamp.outerConeRad
                                                                                                              : kPi; }

// The same random numbers for a lamp whatever others there are.
uint64_t keyOf(const Lamp& lamp) {
  uint64_t key = 0;
  for (const float v : {lamp.position.x, lamp.position.y, lamp.position.z, lamp.direction.x, lamp.direction.y, lamp.direction.z}) key = mix64(key + std::bit_cast<uint32_t>(v) + 0x9e3779b97f4a7c15ull);
  return key;
}

// Surfaces behind the foremost take no light: a flat one fills no more of a voxel than this.
float litArea(const FaceSlot& slot, float h) { return std::clamp(slot.areaM2, kSmallest * h * h, h * h / std::max(0.577f, maxComponent(abs(slot.normal)))); }

struct Deposit {
  uint32_t slot;
  Vec3 fluxLm;
};

// What a chunk of particles leaves behind.
struct Trail {
  std::vector<Deposit> deposits;
  std::vector<GlowPoint> points;
  Bounds3 way;
};

class Particles {
 public:
  Particles(const RayScene& rays, const Voxels& voxels, const SlotPaths& paths, const Lamp& lamp, size_t count, const RadianceSettings& settings)
      : rays_(rays), voxels_(voxels), paths_(paths), lamp_(lamp), count_(count), settings_(settings), around_(lamp, voxels.voxelSizeM), key_(keyOf(lamp)), directions_(lamp), pointLm_(directions_.fluxPerCandela() / std::min(kGlowPoints, static_cast<float>(count))) {}

  const LampSurroundings& around() const { return around_; }
  float fluxPerCandela() const { return directions_.fluxPerCandela(); }

  // All of a chunk step by step together, so that they can be traced together.
  Trail trace(size_t chunk) const {
    Trail trail;
    Lamp unit = lamp_;
    unit.intensityCd = Vec3(1);
    std::vector<Ray> rays;
    std::vector<Sampler> samplers;
    std::vector<Vec3> fluxLm;
    for (size_t i = 0; i < kChunk; ++i) {
      Sampler sampler(key_, static_cast<uint32_t>(chunk * kChunk + i), settings_.seed + 7);
      float pdf = 0;
      const Vec3 direction = directions_.sample(sampler.next2(), pdf), place = lampPlace(lamp_, lamp_.extended ? sampler.next2() : Vec2{});
      trail.way.add(place);
      const Ray& ray = rays.emplace_back(place, direction, 0, kInfinity);
      samplers.emplace_back(key_, static_cast<uint32_t>(chunk * kChunk + i), settings_.seed + 8);
      fluxLm.push_back(lampIntensity(unit, ray.direction) / (pdf * static_cast<float>(count_)));
    }
    for (int k = 0; k < kMostReflections && !rays.empty(); ++k) step(k > 0, rays, samplers, fluxLm, trail);
    return trail;
  }

 private:
  // From slot to slot while these are near the lamp. What falls on another slot straight from it is not ours.
  void step(bool reflected, std::vector<Ray>& rays, std::vector<Sampler>& samplers, std::vector<Vec3>& fluxLm, Trail& trail) const {
    std::vector<Arrival> ends;
    std::vector<HiddenReflection> hidden;
    paths_.follow(rays, samplers, ends, &hidden);
    for (const HiddenReflection& h : hidden) {
      trail.way.add(h.p);
      if (around_.contains(h.p)) reflectedAt(h.p, h.n, fluxLm[h.ray] * h.left, -1, samplers[h.ray], trail);
    }
    size_t live = 0;
    for (size_t i = 0; i < rays.size(); ++i) {
      const Arrival& end = ends[i];
      if (end.escaped) trail.way = {Vec3(-kInfinity), Vec3(kInfinity)};
      if (end.slot < 0) continue;
      const auto s = static_cast<size_t>(end.slot);
      const FaceSlot& slot = voxels_.slots[s];
      const bool isNear = around_.contains(slot.position), indirect = reflected || end.reflected;
      if (!indirect && !isNear) continue;
      const SurfacePlace place = paths_.place(end);
      trail.way.add(place.p);
      Vec3 flux = fluxLm[i] * end.left;
      const float facing = -dot(slot.normal, end.ray.direction);
      if (!indirect && facing > 0.05f) flux *= attenuation(settings_.attenuation, slot.normal, -end.ray.direction) / facing;
      trail.deposits.push_back({static_cast<uint32_t>(s), flux});
      if (!isNear) continue;
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

  // As many points as the flux asks for on average, each of `pointLm_`.
  void reflectedAt(Vec3 p, Vec3 n, Vec3 flux, int64_t slot, Sampler& sampler, Trail& trail) const {
    const float luminous = luminance(flux), copies = std::floor(luminous / pointLm_ + sampler.fast1());
    for (float k = 0; k < copies; ++k) trail.points.push_back({offsetOrigin(p, n), n, flux * (pointLm_ / luminous), slot, 0});
  }

  const RayScene& rays_;
  const Voxels& voxels_;
  const SlotPaths& paths_;
  const Lamp& lamp_;
  const size_t count_;
  const RadianceSettings& settings_;
  const LampSurroundings around_;
  const uint64_t key_;
  const LampDirections directions_;
  const float pointLm_;
};

}  // namespace

LampSurroundings::LampSurroundings(const Lamp& lamp, float voxelSizeM)
    : position_(lamp.position), direction_(lamp.direction), acrossC0_(lamp.up), acrossC90_(cross(lamp.up, lamp.direction)), near_(std::max(kNearM, kNearVoxels * voxelSizeM)), far_(0), tanOuter_(std::tan(beamRad(lamp))), voxelSizeM_(voxelSizeM) {
  // How far a spot's disc of light is smaller than a few voxels, so that shadow rays from slots miss it. Not for wide ones.
  const float outerRad = beamRad(lamp);
  if (outerRad < kNarrow) far_ = kNarrowVoxels * voxelSizeM / std::tan(std::max(outerRad, 1e-3f));
  if (lamp.extended) halfC0_ = 0.5f * lamp.web->sizeC0M, halfC90_ = 0.5f * lamp.web->sizeC90M;
}

// From the nearest place of the rectangle about the opening.
Vec3 LampSurroundings::toOpening(Vec3 p) const {
  const Vec3 d = p - position_;
  if (halfC0_ <= 0) return d;
  return d - acrossC0_ * std::clamp(dot(d, acrossC0_), -halfC0_, halfC0_) - acrossC90_ * std::clamp(dot(d, acrossC90_), -halfC90_, halfC90_);
}

bool LampSurroundings::contains(Vec3 p) const {
  const Vec3 d = toOpening(p);
  const float d2 = lengthSquared(d);
  if (d2 < near_ * near_) return true;
  if (d2 > far_ * far_) return false;
  const float along = dot(d, direction_), lit = along * tanOuter_ + voxelSizeM_;
  return along > 0 && d2 - along * along < lit * lit;
}

bool LampSurroundings::touches(const Bounds3& box) const {
  const float reach = std::max(near_, far_) + std::sqrt(halfC0_ * halfC0_ + halfC90_ * halfC90_);
  return lengthSquared(position_ - max(box.lo, min(box.hi, position_))) < reach * reach;
}

ParticleLight traceParticles(const RayScene& rays, const Voxels& voxels, const SlotPaths& paths, const Lamp& lamp, size_t lamps,
                             const RadianceSettings& settings, const Progress& progress) {
  ParticleLight light;
  const size_t n = std::clamp(kMostParticles / lamps, kFewestPerLamp, kMostPerLamp) / kChunk * kChunk;
  const Particles particles(rays, voxels, paths, lamp, n, settings);
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
      (particles.around().contains(slot.position) ? near : far)[d.slot] += d.fluxLm / litArea(slot, voxels.voxelSizeM);
    }
  }
  light.near = SlotLight(voxels, near), light.far = SlotLight(voxels, far);
  light.rays = n;
  light.fluxPerCandela = particles.fluxPerCandela();
  return light;
}

}  // namespace roomlight
