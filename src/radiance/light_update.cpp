// LightCache::update: light after instances have moved.
#include "base/parallel.h"
#include "radiance/direct_light.h"
#include "radiance/light_cache.h"

namespace roomlight {
namespace {

constexpr float kWithin =
    2;  // voxels: so far at most from a slot's place lie points and hits on the surface it stands for

bool touched(const LinkBounds& detour, std::span<const Bounds3> places, float h) {
  return std::any_of(places.begin(), places.end(),
                     [&](const Bounds3& place) { return overlap(detour.within, place, kWithin * h); });
}

// What is left of the old links of a carried brick; returns those to trace again. A straight link is known to end at
// its slot, what is reflected on its way to keep within a box.
std::vector<LinkOf> keepLinks(const SlotSampling& slots, size_t brick, const Links& before, const SlotChange& change,
                              Links& links) {
  const Voxels& voxels = slots.voxels;
  const SlotRemap& remap = change.remap;
  std::vector<LinkOf> wanted;
  std::vector<Bounds3> ahead;
  const auto [first, last] = slotsOfBrick(voxels, brick);
  const float h = voxels.voxelSizeM;
  const Vec3 within(kWithin * h);
  // A voxel's width off a box counts as crossing it: once roughly, by where slots are, and only then with the ray
// itself.
  const auto crossed = [&](uint32_t s, uint32_t i, const Link& link, uint32_t end) {
    const Vec3 from = voxels.slots[s].position, to = voxels.slots[end].position;
    const Vec3 wide = within + Vec3(h);
    if (!link.isDark() && !mayMeetBetween({from - wide, from + wide}, {to - wide, to + wide}, ahead)) return false;
    Ray ray = linkRay(slots, {s, i});
    if (!link.isDark()) ray.tMax = length(to - ray.origin) + kWithin * h;
    return crosses(ray, ahead, h);
  };
  // In the order of the old links, of which a slot may have had more.
  const std::vector<LinkBounds>& linkBounds = before.linkBounds[static_cast<size_t>(remap.oldBrick[brick])];
  size_t next = 0;
  for (auto s = static_cast<uint32_t>(first); s < last; ++s) {
    while (next < linkBounds.size() && linkBounds[next].slot < s - first) ++next;
    inFront(voxels.slots[s], change.places, h, ahead);
    const size_t old = remap.firstOld[brick] + (s - first);
    for (uint32_t i = 0; i < links.count(s); ++i) {
      const bool known = i < before.count(old);
      const Link link = known ? before.links[before.first[old] + i] : Link();
      const uint32_t end = known ? remap.newSlot[link.slot()] : SlotRemap::kGone;
      const bool changed = end == SlotRemap::kGone || (link.isBent() ? touched(linkBounds[next], change.places, h)
                                                                     : !ahead.empty() && crossed(s, i, link, end));
      if (changed) {
        wanted.push_back({s, i});
      } else {
        links.links[links.first[s] + i] = link.withSlot(end);
        if (link.isBent())
          links.linkBounds[brick].push_back({s - static_cast<uint32_t>(first), i, linkBounds[next].within});
      }
      next += known && link.isBent() ? 1 : 0;
    }
  }
  return wanted;
}

}  // namespace

void LightCache::update(const RayScene& rays, const Lights& lights, const Voxels& voxels,
                        std::span<const Bounds3> places, const Progress& progress) {
  const Sources from{rays, lights, voxels, progress};
  std::vector<BrickMark> marks = marksOf(voxels);
  const SlotRemap remap = remapSlots(marks_, marks, voxels, places);
  const SlotChange change{remap, places};
  fewParticles_ = settings_.bouncesAtOnce > 0;
  field_.rays = 0;
  const SlotPaths::Before known{paths_, remap};
  const SlotPaths paths(rays, voxels, settings_.seed, progress, settings_.still, &known);
  if (progress.stop()) return;
  updateLinks(from, paths, change);
  paths_ = paths;
  learnLights(from);
  progress.at(0.5f);
  updateFixedLights(from, change);
  updateEmitters(from, change);
  forgetLampsBut(lights);
  updateLamps(from, change);
  updateParticles(from, change);
  matchEmitters(from);
  matchLamps(from);
  progress.at(0.8f);
  std::vector<Vec3> indirect(voxels.slots.size());
  for (size_t o = 0; o < remap.newSlot.size(); ++o) {
    if (remap.newSlot[o] != SlotRemap::kGone) indirect[remap.newSlot[o]] = indirect_[o];
  }
  indirect_ = std::move(indirect);
  marks_ = std::move(marks);
  solve(from, bouncesOfUpdate());
}

void LightCache::updateLinks(const Sources& from, const SlotPaths& paths, const SlotChange& change) {
  const bool hasSky = from.lights.sky().present();
  SkyGuideBuilder guide(from.voxels, from.lights.sky());
  const SlotSampling slots{from.voxels, paths, settings_.seed};
  Links links = planLinks(from.voxels, paths, settings_.links, &links_, &change.remap);
  std::atomic<uint64_t> traced = 0;
  parallelFor(from.voxels.bricks.size(), 4, [&](size_t b) {
    if (from.progress.stop()) return;
    const bool keeps = change.remap.keeps(b);
    std::vector<LinkOf> wanted =
        keeps ? keepLinks(slots, b, links_, change, links) : linksOfBrick(from.voxels, links, b);
    traceLinks(slots, b, wanted, links, hasSky && !keeps ? &guide : nullptr);
    traced += wanted.size();
  });
  links_ = std::move(links);
  field_.rays += traced;
  if (hasSky) field_.guide = keptGuide(field_.guide, guide.finish(from.progress), change.remap);
}

SlotLight LightCache::updated(const Sources& from, const SlotLight& before, const SlotChange& change,
                              const BrickTracer& trace) const {
  std::vector<Vec3> lux(from.voxels.slots.size());
  parallelFor(from.voxels.bricks.size(), 4, [&](size_t b) {
    if (from.progress.stop()) return;
    const bool keeps = change.remap.keeps(b);
    if (keeps) {
      const auto [first, last] = slotsOfBrick(from.voxels, b);
      before.copyBrick(static_cast<size_t>(change.remap.oldBrick[b]), last - first, std::span(lux).subspan(first));
    }
    if (!keeps || !change.places.empty()) trace(b, keeps ? change.places : std::span<const Bounds3>(), lux);
  });
  return SlotLight(from.voxels, lux);
}

void LightCache::updateFixedLights(const Sources& from, const SlotChange& change) {
  DirectLight direct(from.rays, from.lights, from.voxels, paths_, field_.seen, settings_);
  if (from.lights.sunCount() > 0) {
    suns_ = updated(from, suns_, change,
                    [&](size_t b, std::span<const Bounds3> near, std::span<Vec3> lux) { direct.suns(b, near, lux); });
  }
  if (from.lights.sky().present()) {
    SkyDirections ways(from.voxels.slots.size());
    for (size_t o = 0; o < skyWays_.size(); ++o) {
      if (change.remap.newSlot[o] != SlotRemap::kGone) ways[change.remap.newSlot[o]] = skyWays_[o];
    }
    skyWays_ = std::move(ways);
    sky_ = updated(from, sky_, change, [&](size_t b, std::span<const Bounds3> near, std::span<Vec3> lux) {
      direct.sky(field_.guide, b, near, skyWays_, lux);
    });
  }
  field_.rays += direct.rayCount();
}

void LightCache::updateLamps(const Sources& from, const SlotChange& change) {
  if (!lampsApart(from.lights)) return;  // matchLamps() lights them together
  DirectLight direct(from.rays, from.lights, from.voxels, paths_, field_.seen, settings_);
  for (LampLight& light : lamps_) {
    light.direct = updated(
        from, light.direct, change,
        [&](size_t b, std::span<const Bounds3> near, std::span<Vec3> lux) { direct.lamp(light.lamp, b, near, lux); });
  }
  field_.rays += direct.rayCount();
}

void LightCache::updateParticles(const Sources& from, const SlotChange& change) {
  const size_t small = smallEmitters(from);
  for (EmitterLight& light : emitters_) {
    const auto index = static_cast<size_t>(light.index);
    if (isSmall(from.lights, index, from.voxels.voxelSizeM))
      updateParticlesOf(from, change, particlesOf(from.lights, index, small, from.voxels.voxelSizeM), light.particles);
  }
  for (LampLight& light : lamps_) updateParticlesOf(from, change, particlesOfLamp(from, light.lamp), light.particles);
}

void LightCache::updateParticlesOf(const Sources& from, const SlotChange& change, const ParticleSource& source,
                                   ParticleLight& particles) {
  if (particles.trails.empty()) {  // there was no surface near it
    const bool mayBe = std::any_of(change.places.begin(), change.places.end(),
                                   [&](const Bounds3& place) { return source.around.touches(place); });
    if (mayBe) particles = particlesFrom(from, source);
    return;
  }
  roomlight::updateParticles(slots(from), source, settings_.attenuation, change, from.progress, particles);
  field_.rays += particles.rays;
}

}  // namespace roomlight
