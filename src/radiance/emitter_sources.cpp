// LightCache: light of emissive meshes, kept apart as that of lamps is.
#include "base/parallel.h"
#include "radiance/direct_light.h"
#include "radiance/light_cache.h"

namespace roomlight {
namespace {

constexpr size_t kMostApart = 48;  // every slot sends a ray to each
constexpr size_t kMostDark = 16;   // kept

std::vector<EmissiveMesh> emissiveMeshes(const Scene& scene, const Lights& lights) {
  std::vector<EmissiveMesh> out;
  for (size_t i = 0; i < lights.emitterCount(); ++i) out.emplace_back(scene, lights.emitterInstance(i));
  return out;
}

}  // namespace

size_t LightCache::smallEmitters(const Sources& from) {
  size_t count = 0;
  for (size_t i = 0; i < from.lights.emitterCount(); ++i)
    count += isSmall(from.lights, i, from.voxels.voxelSizeM) ? 1 : 0;
  return count;
}

bool LightCache::emittersApart(const Lights& lights) const {
  return settings_.emittersApart && lights.emitterCount() <= kMostApart;
}

void LightCache::traceEmitterSum(const Sources& from) {
  DirectLight direct(from.rays, from.lights, from.voxels, paths_, field_.seen, settings_);
  emittersTogether_ = lightOfAll(from, [&](size_t b, std::vector<Vec3>& lux) { direct.emitters(b, {}, lux); });
  field_.rays += direct.rayCount();
}

LightCache::EmitterLight LightCache::tracedEmitter(const Sources& from, size_t index, size_t small) {
  EmitterLight light{
      {from.rays.scene(), from.lights.emitterInstance(index)}, Vec3(1), static_cast<int32_t>(index), {}, {}};
  if (emittersApart(from.lights)) {
    DirectLight direct(from.rays, from.lights, from.voxels, paths_, field_.seen, settings_);
    light.direct = lightOfAll(from, [&](size_t b, std::vector<Vec3>& lux) { direct.emitter(index, b, {}, lux); });
    field_.rays += direct.rayCount();
  }
  if (isSmall(from.lights, index, from.voxels.voxelSizeM))
    light.particles = particlesFrom(from, particlesOf(from.lights, index, small, from.voxels.voxelSizeM));
  return light;
}

// Of one mesh, straight.
void LightCache::addEmitter(const Sources& from, size_t index, std::vector<Vec3>& lux) {
  if (emittersApart(from.lights)) {
    const auto light = std::find_if(emitters_.begin(), emitters_.end(),
                                    [&](const EmitterLight& e) { return e.index == static_cast<int32_t>(index); });
    return light->direct.addTo(from.voxels, light->scale, lux);
  }
  DirectLight direct(from.rays, from.lights, from.voxels, paths_, field_.seen, settings_);
  lightOfAll(from, [&](size_t b, std::vector<Vec3>& own) {
    direct.emitter(index, b, {}, own);
  }).addTo(from.voxels, Vec3(1), lux);
  field_.rays += direct.rayCount();
}

// What is known of meshes in the same place stays, scaled; the rest is traced.
void LightCache::matchEmitters(const Sources& from) {
  const Lights& lights = from.lights;
  const bool apart = emittersApart(lights), wereApart = knownSum_.empty();
  if (apart != wereApart) emitters_.clear(), emittersTogether_ = {};
  std::vector<EmissiveMesh> now = emissiveMeshes(from.rays.scene(), lights);
  if (!apart && now != knownSum_) traceEmitterSum(from);
  const size_t small = smallEmitters(from);
  std::vector<EmitterLight> next, dark;
  for (size_t i = 0; i < now.size(); ++i) {
    const auto known = std::find_if(emitters_.begin(), emitters_.end(),
                                    [&](const EmitterLight& e) { return now[i].shinesLike(e.mesh); });
    if (known == emitters_.end()) {
      next.push_back(tracedEmitter(from, i, small));
      continue;
    }
    next.push_back(std::move(*known));
    next.back().index = static_cast<int32_t>(i);
    next.back().scale = scaleBetween(next.back().mesh.emission, now[i].emission);
    emitters_.erase(known);
  }
  for (auto e = emitters_.rbegin(); e != emitters_.rend() && dark.size() < kMostDark; ++e) {
    dark.push_back(std::move(*e));
    dark.back().scale = {}, dark.back().index = -1;
  }
  next.insert(next.end(), std::make_move_iterator(dark.rbegin()), std::make_move_iterator(dark.rend()));
  emitters_ = std::move(next);
  knownSum_ = apart ? std::vector<EmissiveMesh>() : std::move(now);
}

// Of meshes where they were, as they shine now.
void LightCache::updateEmitters(const Sources& from, const SlotChange& change) {
  const std::vector<EmissiveMesh> now = emissiveMeshes(from.rays.scene(), from.lights);
  std::erase_if(emitters_, [&](const EmitterLight& e) {
    return std::none_of(now.begin(), now.end(), [&](const EmissiveMesh& m) { return m.shinesLike(e.mesh); });
  });
  DirectLight direct(from.rays, from.lights, from.voxels, paths_, field_.seen, settings_);
  for (EmitterLight& light : emitters_) {
    light.index = from.lights.emitterOf(light.mesh.instance);
    const auto index = static_cast<size_t>(light.index);
    const Vec3 scale = scaleBetween(light.mesh.emission, now[index].emission);
    light.mesh = now[index], light.scale = Vec3(1);
    light.direct.scale(scale), light.particles.scale(scale);
    if (!emittersApart(from.lights)) continue;
    light.direct = updated(
        from, light.direct, change,
        [&](size_t b, std::span<const Bounds3> near, std::span<Vec3> lux) { direct.emitter(index, b, near, lux); });
  }
  if (!emittersApart(from.lights) && now == knownSum_) {
    emittersTogether_ =
        updated(from, emittersTogether_, change,
                [&](size_t b, std::span<const Bounds3> near, std::span<Vec3> lux) { direct.emitters(b, near, lux); });
  }
  field_.rays += direct.rayCount();
}

}  // namespace roomlight
