#include "radiance/near_lamps.h"

#include "base/parallel.h"
#include "base/sampling.h"
#include "radiance/attenuation.h"
#include "radiance/lamp_cells.h"

namespace roomlight {
namespace {

constexpr float kNearVoxels = 4;  // further off a voxel sees the lamp under nearly the same distance everywhere
constexpr float kNearM = 0.5f;    // further off surfaces are no brighter than cones can deal with
constexpr float kSmallest = 0.1f; // voxels²; smaller slots may get light meant for a neighbour, too much on so small an area
constexpr size_t kMostParticles = size_t{1} << 19, kMostPerLamp = size_t{1} << 17, kFewestPerLamp = size_t{1} << 12, kChunk = 512;
constexpr int kMostReflections = 64;
constexpr float kNarrow = 0.5f;      // rad
constexpr float kNarrowVoxels = 8;  // radius of a disc of light
constexpr float kPoints = 32768;  // that stand for a flux like that of the lamps

// Part of the directions a lamp shines into, as 1 - cos of its cone.
float extent(const Lamp& lamp) {
  if (lamp.kind == LampKind::Point) return 2;
  const float s = std::sin(0.5f * lamp.outerConeRad);
  return 2 * s * s;
}

}  // namespace

NearLamps::NearLamps(const Lights& lights, const Voxels& voxels, const SlotPaths& paths) : lights_(lights), voxels_(voxels), nearAny_(voxels.slots.size()) {
  if (lights.lampCount() == 0) return;
  std::vector<std::atomic<bool>> hasNear(lights.lampCount());
  const LampCells cells(lights, radius());
  std::vector<size_t> narrow;
  for (size_t l = 0; l < hasNear.size(); ++l) {
    if (narrowFor(lights.lamp(l)) > radius()) narrow.push_back(l);
  }
  parallelFor(voxels.bricks.size(), 16, [&](size_t b) {
    const auto [first, last] = paths.slotsOfBrick(b);
    Bounds3 bounds;
    for (size_t s = first; s < last; ++s) bounds.add(voxels.slots[s].position);
    std::vector<size_t> candidates;
    cells.around(bounds, candidates);
    candidates.insert(candidates.end(), narrow.begin(), narrow.end());
    for (const size_t l : candidates) {
      for (size_t s = first; s < last; ++s) {
        if (isNear(l, s)) nearAny_[s] = 1, hasNear[l] = true;
      }
    }
  });
  for (size_t l = 0; l < hasNear.size(); ++l) {
    if (hasNear[l]) lamps_.push_back(l);
  }
}

float NearLamps::radius() const { return std::max(kNearM, kNearVoxels * voxels_.voxelSizeM); }

bool NearLamps::isNear(size_t lamp, Vec3 p) const {
  const Lamp& l = lights_.lamp(lamp);
  const Vec3 d = p - l.position;
  const float near = radius(), d2 = lengthSquared(d), far = narrowFor(l);
  if (d2 < near * near) return true;
  if (d2 > far * far) return false;
  const float along = dot(d, l.direction), lit = along * std::tan(l.outerConeRad) + voxels_.voxelSizeM;
  return along > 0 && d2 - along * along < lit * lit;
}

// How far a spot's disc of light is smaller than a few voxels, so that shadow rays from slots miss it, m. Not for wide ones.
float NearLamps::narrowFor(const Lamp& lamp) const {
  return lamp.kind == LampKind::Spot && lamp.outerConeRad < kNarrow ? kNarrowVoxels * voxels_.voxelSizeM / std::tan(std::max(lamp.outerConeRad, 1e-3f)) : 0;
}

// Surfaces behind the foremost take no light: a flat one fills no more of a voxel than this.
float NearLamps::litArea(const FaceSlot& slot) const {
  const float h2 = voxels_.voxelSizeM * voxels_.voxelSizeM;
  return std::clamp(slot.areaM2, kSmallest * h2, h2 / std::max(0.577f, maxComponent(abs(slot.normal))));
}

NearLamps::Light NearLamps::trace(const RayScene& rays, const SlotPaths& paths, const RadianceSettings& settings, const Progress& progress) const {
  Light light;
  if (lamps_.empty() || progress.stop()) return light;
  const size_t slots = voxels_.slots.size();
  light.near.resize(slots), light.far.resize(slots);
  const size_t n = std::clamp(kMostParticles / lamps_.size(), kFewestPerLamp, kMostPerLamp) / kChunk * kChunk;
  std::vector<Trail> trails(n / kChunk);
  float fluxLm = 0;
  for (const size_t l : lamps_) fluxLm += luminance(lights_.lamp(l).intensityCd) * 2 * kPi * extent(lights_.lamp(l));
  for (const size_t l : lamps_) {
    if (progress.stop()) break;
    const Lamp& lamp = lights_.lamp(l);
    const Frame frame(lamp.kind == LampKind::Point ? Vec3{0, 0, 1} : lamp.direction);
    const float steradiansEach = 2 * kPi * extent(lamp) / static_cast<float>(n);
    parallelFor(trails.size(), 1, [&](size_t chunk) {
      trails[chunk] = {};
      if (progress.stop()) return;
      std::vector<Ray> out(kChunk);
      std::vector<Hit> hits(kChunk);
      for (size_t i = 0; i < kChunk; ++i) {
        Sampler sampler(l, static_cast<uint32_t>(chunk * kChunk + i), settings.seed + 7);
        out[i] = {lamp.position, frame.toWorld(sampleCone(sampler.next2(), extent(lamp))), 0, kInfinity};
      }
      rays.intersect(out, hits);
      for (size_t i = 0; i < kChunk; ++i) {
        Sampler sampler(l, static_cast<uint32_t>(chunk * kChunk + i), settings.seed + 8);
        follow(rays, paths, l, out[i], hits[i], lampIntensity(lamp, out[i].direction) * steradiansEach, fluxLm / kPoints, settings.attenuation, sampler, trails[chunk]);
      }
    });
    // In order, so that sums do not depend on threads.
    for (const Trail& trail : trails) {
      light.points.insert(light.points.end(), trail.points.begin(), trail.points.end());
      for (const Deposit& d : trail.deposits) {
        (nearAny_[d.slot] ? light.near : light.far)[d.slot] += d.fluxLm / litArea(voxels_.slots[d.slot]);
      }
    }
    light.rays += n;
  }
  return light;
}

// From slot to slot while these are near a lamp. What falls on another slot straight from the lamp is not ours.
void NearLamps::follow(const RayScene& rays, const SlotPaths& paths, size_t lamp, Ray ray, Hit hit, Vec3 fluxLm, float pointLm, Attenuation kind,
                       Sampler& sampler, Trail& trail) const {
  std::vector<HiddenReflection> hidden;
  // As many points as the flux asks for on average, each of `pointLm`.
  const auto reflectedAt = [&](Vec3 p, Vec3 n, Vec3 flux, int64_t slot) {
    const float luminous = luminance(flux), copies = std::floor(luminous / pointLm + sampler.fast1());
    for (float k = 0; k < copies; ++k) trail.points.push_back({offsetOrigin(p, n), n, flux * (pointLm / luminous), slot, 0});
  };
  bool reflected = false;
  for (int k = 0; k < kMostReflections; ++k) {
    hidden.clear();
    const Arrival end = paths.follow(ray, hit, sampler, &hidden);
    for (const HiddenReflection& h : hidden) {
      if (isNearAny(h, lamp)) reflectedAt(h.p, h.n, fluxLm * h.left, -1);
    }
    if (end.slot < 0) return;
    const auto s = static_cast<size_t>(end.slot);
    reflected = reflected || end.reflected;
    if (!reflected && !isNear(lamp, s)) return;
    const FaceSlot& slot = voxels_.slots[s];
    fluxLm *= end.left;
    const float facing = -dot(slot.normal, ray.direction);
    if (!reflected && facing > 0.05f) fluxLm *= attenuation(kind, slot.normal, -ray.direction) / facing;
    trail.deposits.push_back({static_cast<uint32_t>(s), fluxLm});
    if (!nearAny_[s]) return;
    const Vec3 albedo = paths.albedo(end);
    reflectedAt(end.p, end.n, fluxLm * albedo, end.slot);
    const float survive = std::min(0.95f, maxComponent(albedo));
    if (sampler.next1() >= survive) return;
    fluxLm *= albedo / survive;
    reflected = true;
    ray = {offsetOrigin(end.p, end.n), Frame(end.n).toWorld(sampleCosineHemisphere(sampler.next2())), 0, kInfinity};
    hit = rays.intersect(ray);
  }
}

}  // namespace roomlight
