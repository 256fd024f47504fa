// Light of emissive meshes, kept apart as that of lamps is.
#include <algorithm>
#include <iterator>
#include <utility>

#include "radiance/light_sources.h"

namespace roomlight {
namespace {

constexpr size_t kMostMeshesApart = 48;  // every slot sends a ray to each

std::vector<EmissiveMesh> emissiveMeshes(const Scene& scene, const Lights& lights) {
  std::vector<EmissiveMesh> out;
  for (size_t i = 0; i < lights.emitterCount(); ++i) out.emplace_back(scene, lights.emitterInstance(i));
  return out;
}

// Those that send particles out.
size_t smallEmitters(const LightTracing& t) {
  size_t count = 0;
  for (size_t i = 0; i < t.lights.emitterCount(); ++i) count += isSmall(t.lights, i, t.voxels.voxelSizeM) ? 1 : 0;
  return count;
}

}  // namespace

EmitterSource::EmitterSource(const LightTracing& t, size_t index, bool apart, size_t small)
    : LightSource(Vec3(1)),
      mesh_(t.rays.scene(), t.lights.emitterInstance(index)),
      index_(static_cast<int32_t>(index)) {
  if (apart) {
    DirectLight direct = t.direct();
    direct_ = t.lightOfAll([&](size_t b, std::vector<Vec3>& lux) { direct.emitter(index, b, {}, lux); });
    t.rayCount += direct.rayCount();
  }
  if (isSmall(t.lights, index, t.voxels.voxelSizeM))
    particles_ = t.particlesFrom(particlesOf(t.lights, index, small, t.voxels.voxelSizeM));
}

void EmitterSource::become(size_t index, const EmissiveMesh& now) {
  index_ = static_cast<int32_t>(index);
  scale_ = scaleBetween(mesh_.emission, now.emission);
}

// What is kept is of the mesh as it shines now.
void EmitterSource::updateDirect(const LightTracing& t, DirectLight& direct, const EmissiveMesh& now, bool apart,
                                 const SlotChange& change) {
  const Vec3 scale = scaleBetween(mesh_.emission, now.emission);
  mesh_ = now, scale_ = Vec3(1), index_ = t.lights.emitterOf(now.instance);
  direct_.scale(scale), particles_.scale(scale);
  if (!apart) return;
  const auto index = static_cast<size_t>(index_);
  direct_ = t.updated(direct_, change, [&](size_t b, std::span<const Bounds3> near, std::span<Vec3> lux) {
    direct.emitter(index, b, near, lux);
  });
}

void EmitterSource::updateParticles(const LightTracing& t, size_t small, const SlotChange& change) {
  const auto index = static_cast<size_t>(index_);
  if (isSmall(t.lights, index, t.voxels.voxelSizeM))
    t.update(change, particlesOf(t.lights, index, small, t.voxels.voxelSizeM), particles_);
}

void EmitterSource::traceAllParticles(const LightTracing& t, size_t small) {
  if (!needsAllParticles()) return;
  particles_ = t.particlesFrom(particlesOf(t.lights, static_cast<size_t>(index_), small, t.voxels.voxelSizeM));
  // These are of the mesh as it shines now, and so must be all that is kept of it.
  direct_.scale(scale_);
  mesh_ = EmissiveMesh(t.rays.scene(), mesh_.instance), scale_ = Vec3(1);
}

bool EmitterSources::apart(const RadianceSettings& settings, const Lights& lights) {
  return settings.emittersApart && lights.emitterCount() <= kMostMeshesApart;
}

void EmitterSources::match(const LightTracing& t) {
  const bool isApart = apart(t.settings, t.lights), wasApart = knownTogether_.empty();
  if (isApart != wasApart) each_.clear(), together_ = {};
  std::vector<EmissiveMesh> now = emissiveMeshes(t.rays.scene(), t.lights);
  if (!isApart && now != knownTogether_) {
    DirectLight direct = t.direct();
    together_ = t.lightOfAll([&](size_t b, std::vector<Vec3>& lux) { direct.emitters(b, {}, lux); });
    t.rayCount += direct.rayCount();
  }
  const size_t small = smallEmitters(t);
  std::vector<EmitterSource> next, dark;
  for (size_t i = 0; i < now.size(); ++i) {
    const auto known =
        std::find_if(each_.begin(), each_.end(), [&](const EmitterSource& e) { return now[i].shinesLike(e.mesh()); });
    if (known == each_.end()) {
      next.emplace_back(t, i, isApart, small);
      continue;
    }
    next.push_back(std::move(*known));
    next.back().become(i, now[i]);
    each_.erase(known);
  }
  size_t darkBytes = 0;
  for (auto e = each_.rbegin(); e != each_.rend() && dark.size() < kMostDarkSources; ++e) {
    if (darkBytes + e->bytes() > kMostDarkBytes) continue;
    darkBytes += e->bytes();
    dark.push_back(std::move(*e));
    dark.back().switchOff();
  }
  next.insert(next.end(), std::make_move_iterator(dark.rbegin()), std::make_move_iterator(dark.rend()));
  each_ = std::move(next);
  knownTogether_ = isApart ? std::vector<EmissiveMesh>() : std::move(now);
}

// Of meshes where they were, as they shine now.
void EmitterSources::update(const LightTracing& t, const SlotChange& change) {
  const std::vector<EmissiveMesh> now = emissiveMeshes(t.rays.scene(), t.lights);
  const bool isApart = apart(t.settings, t.lights);
  std::erase_if(each_, [&](const EmitterSource& e) {
    return std::none_of(now.begin(), now.end(), [&](const EmissiveMesh& m) { return m.shinesLike(e.mesh()); });
  });
  DirectLight direct = t.direct();
  for (EmitterSource& light : each_) {
    const auto index = static_cast<size_t>(t.lights.emitterOf(light.mesh().instance));
    light.updateDirect(t, direct, now[index], isApart, change);
  }
  if (!isApart && now == knownTogether_) {
    together_ = t.updated(together_, change, [&](size_t b, std::span<const Bounds3> near, std::span<Vec3> lux) {
      direct.emitters(b, near, lux);
    });
  }
  t.rayCount += direct.rayCount();
  const size_t small = smallEmitters(t);
  for (EmitterSource& light : each_) light.updateParticles(t, small, change);
}

void EmitterSources::traceAllParticles(const LightTracing& t) {
  const size_t small = smallEmitters(t);
  for (EmitterSource& light : each_) light.traceAllParticles(t, small);
}

bool EmitterSources::hasFewParticles() const {
  return std::any_of(each_.begin(), each_.end(), [](const EmitterSource& e) { return e.needsAllParticles(); });
}

void EmitterSources::addEmitter(const LightTracing& t, size_t index, std::vector<Vec3>& lux) const {
  if (apart(t.settings, t.lights)) {
    const auto light = std::find_if(each_.begin(), each_.end(),
                                    [&](const EmitterSource& e) { return e.index() == static_cast<int32_t>(index); });
    return light->addTo(t.voxels, lux);
  }
  DirectLight direct = t.direct();
  t.lightOfAll([&](size_t b, std::vector<Vec3>& own) {
     direct.emitter(index, b, {}, own);
   }).addTo(t.voxels, Vec3(1), lux);
  t.rayCount += direct.rayCount();
}

void EmitterSources::addParticles(std::vector<LitParticles>& to) const {
  for (const EmitterSource& e : each_) to.push_back({&e.particles(), e.scale(), -1, e.index()});
}

size_t EmitterSources::bytes() const {
  size_t sum = together_.bytes();
  for (const EmitterSource& e : each_) sum += e.bytes();
  return sum;
}

}  // namespace roomlight
