// LightCache::update: light after instances have moved.
#include "base/parallel.h"
#include "radiance/direct_light.h"
#include "radiance/light_cache.h"

namespace roomlight {
namespace {

// What is left of the old links of a carried brick; returns those to trace again. A straight link is known to end at its slot; what
// is reflected on its way may go anywhere.
std::vector<LinkOf> carryLinks(const Voxels& voxels, const SlotPaths& paths, size_t brick, uint64_t seed, const Links& before, const Carried& carried,
                               std::span<const Bounds3> places, Links& links) {
  std::vector<LinkOf> wanted;
  const auto [first, last] = slotsOfBrick(voxels, brick);
  const float h = voxels.voxelSizeM;
  for (auto s = static_cast<uint32_t>(first); s < last; ++s) {
    const size_t old = carried.firstOld[brick] + (s - first);
    for (uint32_t i = 0; i < links.count(s); ++i) {
      const bool known = i < before.count(old);
      const Link link = known ? before.links[before.first[old] + i] : Link();
      const uint32_t end = known ? carried.newSlot[link.slot()] : Carried::kGone;
      bool stays = known && end != Carried::kGone && !link.isBent();
      if (stays) {
        Ray ray = linkRay(voxels, paths, {s, i}, seed);
        if (!link.isDark()) ray.tMax = length(voxels.slots[end].position - ray.origin) + 2 * h;
        stays = !crosses(ray, places, h);
      }
      if (stays) {
        links.links[links.first[s] + i] = link.withSlot(end);
      } else {
        wanted.push_back({s, i});
      }
    }
  }
  return wanted;
}

}  // namespace

void LightCache::update(const RayScene& rays, const Lights& lights, const Voxels& voxels, const MovedInstances& moved, const Progress& progress) {
  const Sources from{rays, lights, voxels, progress};
  std::vector<BrickMark> marks = marksOf(voxels);
  const Carried carried = carry(marks_, marks, voxels, moved.places);
  const Change change{carried, moved.places};
  field_.rays = 0;
  const SlotPaths paths(rays, voxels, settings_.seed, progress, &paths_, &carried);
  if (progress.stop()) return;
  updateLinks(from, paths, change);
  paths_ = paths;
  progress.at(0.5f);
  const bool emittersMoved = moved.glow || std::any_of(moved.instances.begin(), moved.instances.end(), [&](uint32_t i) {
                               const Scene& scene = rays.scene();
                               return !isBlack(scene.materials[static_cast<size_t>(scene.meshes[static_cast<size_t>(scene.instances[i].mesh)].material)].emission);
                             });
  updateFixedLights(from, change, emittersMoved);
  forgetLampsBut(lights);
  updateLamps(from, change);
  updateParticles(from, change);
  matchEmitters(from);
  matchLamps(from);
  progress.at(0.8f);
  std::vector<Vec3> indirect(voxels.slots.size());
  for (size_t o = 0; o < carried.newSlot.size(); ++o) {
    if (carried.newSlot[o] != Carried::kGone) indirect[carried.newSlot[o]] = indirect_[o];
  }
  indirect_ = std::move(indirect);
  marks_ = std::move(marks);
  solve(from);
}

void LightCache::updateLinks(const Sources& from, const SlotPaths& paths, const Change& change) {
  const bool hasSky = from.lights.sky().present();
  SkyGuideBuilder guide(from.voxels, from.lights.sky());
  Links links = planLinks(from.voxels, paths, settings_.links);
  std::atomic<uint64_t> traced = 0;
  parallelFor(from.voxels.bricks.size(), 4, [&](size_t b) {
    if (from.progress.stop()) return;
    const bool keeps = change.carried.keeps(b);
    std::vector<LinkOf> wanted = keeps ? carryLinks(from.voxels, paths, b, settings_.seed, links_, change.carried, change.places, links) : linksOfBrick(from.voxels, links, b);
    traceLinks(from.voxels, paths, b, wanted, settings_.seed, links, hasSky && !keeps ? &guide : nullptr);
    traced += wanted.size();
  });
  links_ = std::move(links);
  field_.rays += traced;
  if (hasSky) field_.guide = carriedGuide(field_.guide, guide.finish(from.progress), change.carried);
}

SlotLight LightCache::updated(const Sources& from, const SlotLight& before, const Change& change, const BrickTracer& trace) const {
  std::vector<Vec3> lux(from.voxels.slots.size());
  parallelFor(from.voxels.bricks.size(), 4, [&](size_t b) {
    if (from.progress.stop()) return;
    if (!change.carried.keeps(b)) {
      trace(b, {}, lux);
    } else if (!trace(b, change.places, lux)) {
      const auto [first, last] = slotsOfBrick(from.voxels, b);
      before.copyBrick(static_cast<size_t>(change.carried.oldBrick[b]), last - first, std::span(lux).subspan(first));
    }
  });
  return SlotLight(from.voxels, lux);
}

SlotLight LightCache::carriedLight(const Sources& from, const SlotLight& before, const Carried& carried) const {
  return updated(from, before, {carried, {}}, [](size_t, std::span<const Bounds3>, std::span<Vec3>) { return false; });
}

void LightCache::updateFixedLights(const Sources& from, const Change& change, bool emittersMoved) {
  DirectLight direct(from.rays, from.lights, from.voxels, paths_, settings_);
  if (from.lights.sunCount() > 0) {
    suns_ = updated(from, suns_, change, [&](size_t b, std::span<const Bounds3> near, std::span<Vec3> lux) { return direct.suns(b, near, lux); });
  }
  if (from.lights.sky().present()) {
    sky_ = updated(from, sky_, change, [&](size_t b, std::span<const Bounds3> near, std::span<Vec3> lux) { return direct.sky(field_.guide, b, near, lux); });
  }
  if (from.lights.hasEmitters()) {
    emitters_ = updated(from, emitters_, change, [&](size_t b, std::span<const Bounds3> near, std::span<Vec3> lux) {
      return direct.emitters(b, emittersMoved ? std::span<const Bounds3>() : near, lux);
    });
  } else {
    emitters_ = {};
  }
  field_.rays += direct.rayCount();
}

void LightCache::updateLamps(const Sources& from, const Change& change) {
  DirectLight direct(from.rays, from.lights, from.voxels, paths_, settings_);
  for (LampLight& light : lamps_) {
    light.direct = updated(from, light.direct, change, [&](size_t b, std::span<const Bounds3> near, std::span<Vec3> lux) { return direct.lamp(light.lamp, b, near, lux); });
  }
  field_.rays += direct.rayCount();
}

// Particles of a source are sent out again if any has been near a change; those of one source are quickly traced.
void LightCache::updateParticles(const Sources& from, const Change& change) {
  std::vector<Bounds3> dirty(change.places.begin(), change.places.end());
  for (size_t b = 0; b < from.voxels.bricks.size(); ++b) {
    if (!change.carried.keeps(b)) dirty.push_back(boundsOfBrick(from.voxels, b));
  }
  const auto isTouched = [&](const ParticleLight& particles, const LightSurroundings& around) {
    return std::any_of(dirty.begin(), dirty.end(), [&](const Bounds3& d) { return overlap(particles.way, d, 0) || around.touches(d); });
  };
  // Emissive meshes left out here are traced by matchEmitters, where they still are.
  std::erase_if(nearEmitters_, [&](const EmitterLight& e) { return isTouched(e.particles, LightSurroundings(e.bounds, from.voxels.voxelSizeM)); });
  for (EmitterLight& e : nearEmitters_) carryParticles(from, change.carried, e.particles);
  for (LampLight& light : lamps_) {
    const ParticleSource source = particlesOfLamp(from, light.lamp);
    if (isTouched(light.particles, source.around)) {
      light.particles = particlesFrom(from, source);
    } else {
      carryParticles(from, change.carried, light.particles);
    }
  }
}

void LightCache::carryParticles(const Sources& from, const Carried& carried, ParticleLight& particles) const {
  particles.near = carriedLight(from, particles.near, carried), particles.far = carriedLight(from, particles.far, carried);
  for (GlowPoint& g : particles.points) {
    if (g.slot >= 0) g.slot = static_cast<int64_t>(carried.newSlot[static_cast<size_t>(g.slot)]);
  }
}

}  // namespace roomlight
