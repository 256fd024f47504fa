#include "radiance/light_cache.h"

#include <atomic>
#include <mutex>

#include "base/parallel.h"
#include "radiance/cone_bounces.h"
#include "radiance/direct_light.h"
#include "radiance/hidden_light.h"
#include "radiance/pyramid.h"
#include "radiance/sun_bounce.h"
#include "trace/lamp_light.h"

namespace roomlight {
namespace {

constexpr float kUnseen = 1e12f;   // cd/m²: of glow that no voxel shows, so that points take all of it
constexpr size_t kDarkLamps = 16;  // kept
constexpr size_t kMostApart = 32;  // lamps: every slot sends rays to each

bool sameLight(const Lamp& a, const Lamp& b) {
  return a.kind == b.kind && a.position == b.position && a.direction == b.direction &&
         a.innerConeRad == b.innerConeRad && a.outerConeRad == b.outerConeRad && a.web == b.web &&
         (!a.web || (a.up == b.up && a.extended == b.extended));
}

// lm, of the slots together.
Vec3 fluxOf(const Voxels& voxels, const std::vector<Vec3>& lux) {
  double sum[3] = {};
  for (size_t i = 0; i < lux.size(); ++i) {
    for (int c = 0; c < 3; ++c) sum[c] += static_cast<double>(lux[i][c]) * static_cast<double>(voxels.slots[i].areaM2);
  }
  return {static_cast<float>(sum[0]), static_cast<float>(sum[1]), static_cast<float>(sum[2])};
}

// Reports from one thread at a time.
class Steps {
 public:
  Steps(const Progress& progress, float from, float to, size_t count)
      : progress_(progress), from_(from), to_(to), count_(count) {}
  void one() {
    const size_t d = ++done_;
    if (d % 256 == 0 && reporting_.try_lock()) {
      progress_.at(from_ + (to_ - from_) * static_cast<float>(d) / static_cast<float>(count_));
      reporting_.unlock();
    }
  }

 private:
  const Progress& progress_;
  const float from_, to_;
  const size_t count_;
  std::atomic<size_t> done_ = 0;
  std::mutex reporting_;
};

}  // namespace

LightCache::LightCache(const RayScene& rays, const Lights& lights, const Voxels& voxels,
                       const RadianceSettings& settings, const Progress& progress)
    : settings_(settings), paths_(rays, voxels, settings.seed, progress, settings.still) {
  const Sources from{rays, lights, voxels, progress};
  traceAllLinks(from);
  progress.at(0.5f);
  traceDaylight(from);
  learnLights(from);
  matchEmitters(from);
  matchLamps(from);
  progress.at(0.8f);
  indirect_.assign(voxels.slots.size(), {});
  marks_ = marksOf(voxels);
  solve(from, settings.maxBounces);
}

void LightCache::relight(const RayScene& rays, const Lights& lights, const Voxels& voxels, const Progress& progress) {
  const Sources from{rays, lights, voxels, progress};
  field_.rays = 0;
  fewParticles_ = settings_.bouncesAtOnce > 0;
  paths_.refer(rays, voxels);
  learnLights(from);
  matchEmitters(from);
  matchLamps(from);
  progress.at(0.5f);
  solve(from, bouncesOfUpdate());
}

void LightCache::goOn(const RayScene& rays, const Lights& lights, const Voxels& voxels, const Progress& progress) {
  if (settled_) return;
  field_.rays = 0;
  const Sources from{rays, lights, voxels, progress};
  paths_.refer(rays, voxels);
  traceAllParticles(from);
  mostAtOnce_ = std::min(2 * mostAtOnce_, settings_.maxBounces);
  solve(from, mostAtOnce_);
}

// Of what has moved while light was followed in steps.
void LightCache::traceAllParticles(const Sources& from) {
  fewParticles_ = false;
  const size_t small = smallEmitters(from);
  for (EmitterLight& light : emitters_) {
    if (!light.needsAllParticles()) continue;
    light.particles =
        particlesFrom(from, particlesOf(from.lights, static_cast<size_t>(light.index), small, from.voxels.voxelSizeM));
    // These are of the mesh as it shines now, and so must be all that is kept of it.
    light.direct.scale(light.scale);
    light.mesh = EmissiveMesh(from.rays.scene(), light.mesh.instance), light.scale = Vec3(1);
  }
  for (LampLight& light : lamps_) {
    if (light.needsAllParticles()) light.particles = particlesFrom(from, particlesOfLamp(from, light.lamp));
  }
}

void LightCache::followDaylight(const RayScene& rays, const Lights& lights, const Voxels& voxels,
                                const Progress& progress) {
  const Sources from{rays, lights, voxels, progress};
  field_.rays = 0;
  paths_.refer(rays, voxels);
  findGuide(from);
  traceDaylight(from);
  learnLights(from);
  matchEmitters(from);
  matchLamps(from);
  progress.at(0.5f);
  if (progress.stop()) return field_.irradianceLux.clear();
  const Vec3 before = fluxOf(voxels, direct_);
  std::vector<Vec3> near = sumDirect(from);
  const Vec3 now = fluxOf(voxels, direct_);
  const auto darker = [](float to, float of) { return to < of ? to / of : 1; };
  const Vec3 scale{darker(now.x, before.x), darker(now.y, before.y), darker(now.z, before.z)};
  for (Vec3& v : indirect_) v *= scale;
  bounceOn(from, bouncesOfUpdate(), near);
}

void LightCache::traceAllLinks(const Sources& from) {
  const bool hasSky = from.lights.sky().present();
  SkyGuideBuilder guide(from.voxels, from.lights.sky());
  if (from.progress.stop()) return;
  links_ = planLinks(from.voxels, paths_, settings_.links);
  if (settings_.still) links_.hidden.resize(from.voxels.bricks.size());
  Steps steps(from.progress, 0, 0.5f, from.voxels.bricks.size());
  parallelFor(from.voxels.bricks.size(), 4, [&](size_t b) {
    if (from.progress.stop()) return;
    traceLinks(slots(from), b, linksOfBrick(from.voxels, links_, b), links_, hasSky ? &guide : nullptr);
    steps.one();
  });
  if (from.progress.stop()) return;
  field_.rays += links_.links.size();
  if (hasSky) field_.guide = guide.finish(from.progress);
}

// Of links traced before.
void LightCache::findGuide(const Sources& from) {
  field_.guide = {};
  if (!from.lights.sky().present()) return;
  SkyGuideBuilder guide(from.voxels, from.lights.sky());
  std::atomic<uint64_t> followed = 0;
  parallelFor(from.voxels.bricks.size(), 4, [&](size_t b) {
    if (!from.progress.stop()) followed += lookAtSky(slots(from), b, links_, guide);
  });
  field_.rays += followed;
  field_.guide = guide.finish(from.progress);
}

// What is seen of lamps and emissive meshes. Where things move it would change with them, and with it the random
// choices of all that sees them.
void LightCache::learnLights(const Sources& from) {
  field_.seen = {};
  if (settings_.still && !from.progress.stop())
    field_.seen = SeenLights(from.rays, from.lights, from.voxels, paths_, settings_.seed, field_.rays);
}

// Suns and sky.
void LightCache::traceDaylight(const Sources& from) {
  DirectLight direct(from.rays, from.lights, from.voxels, paths_, field_.seen, settings_);
  suns_ = sky_ = {};
  skyWays_.clear();
  if (from.lights.sunCount() > 0)
    suns_ = lightOfAll(from, [&](size_t b, std::vector<Vec3>& lux) { direct.suns(b, {}, lux); });
  field_.sunPoints.clear();
  if (settings_.still && from.lights.sunCount() == 1 && !suns_.empty() && !from.progress.stop()) {
    std::vector<Vec3> sun(from.voxels.slots.size());
    suns_.addTo(from.voxels, Vec3(1), sun);
    field_.sunPoints = sunPlaces({from.rays, from.lights}, slots(from), links_, sun, field_.rays);
    suns_ = SlotLight(from.voxels, sun);
  }
  if (from.lights.sky().present()) {
    skyWays_.resize(from.voxels.slots.size());
    sky_ = lightOfAll(from, [&](size_t b, std::vector<Vec3>& lux) { direct.sky(field_.guide, b, {}, skyWays_, lux); });
  }
  field_.rays += direct.rayCount();
}

SlotLight LightCache::lightOfAll(const Sources& from, const std::function<void(size_t, std::vector<Vec3>&)>& ofBrick) {
  std::vector<Vec3> lux(from.voxels.slots.size());
  parallelFor(from.voxels.bricks.size(), 4, [&](size_t b) {
    if (!from.progress.stop()) ofBrick(b, lux);
  });
  return SlotLight(from.voxels, lux);
}

void LightCache::traceLamp(const Sources& from, LampLight& light) {
  DirectLight direct(from.rays, from.lights, from.voxels, paths_, field_.seen, settings_);
  light.direct = lightOfAll(from, [&](size_t b, std::vector<Vec3>& lux) { direct.lamp(light.lamp, b, {}, lux); });
  field_.rays += direct.rayCount();
  light.particles = particlesFrom(from, particlesOfLamp(from, light.lamp));
}

bool LightCache::lampsApart(const Lights& lights) const {
  return !settings_.still || settings_.layers || lights.lampCount() <= kMostApart;
}

void LightCache::traceLampSum(const Sources& from) {
  DirectLight direct(from.rays, from.lights, from.voxels, paths_, field_.seen, settings_);
  std::vector<LightSurroundings> around;
  for (size_t i = 0; i < from.lights.lampCount(); ++i) around.emplace_back(from.lights.lamp(i), from.voxels.voxelSizeM);
  lampsTogether_ = lightOfAll(from, [&](size_t b, std::vector<Vec3>& lux) { direct.lamps(around, b, lux); });
  lampParticles_ = traceLampParticles(slots(from), from.lights, settings_.attenuation, from.progress);
  field_.rays += direct.rayCount() + lampParticles_.rays;
}

ParticleSource LightCache::particlesOfLamp(const Sources& from, const Lamp& lamp) const {
  return particlesOf(lamp, std::max<size_t>(1, from.lights.lampCount()), from.voxels.voxelSizeM);
}

// None where there is no surface near the source.
ParticleLight LightCache::particlesFrom(const Sources& from, ParticleSource source) {
  if (from.progress.stop() || !hasSurfaces(from.voxels, source.around)) return {};
  if (fewParticles_) source.takeFewer();
  ParticleLight light = traceParticles(slots(from), source, settings_.attenuation, from.progress);
  field_.rays += light.rays;
  light.few = fewParticles_;
  if (settings_.still) light.trails = {};  // they tell what moved things change
  return light;
}

// What is known of lamps in the same place stays; the rest is traced.
void LightCache::matchLamps(const Sources& from) {
  lampsTogether_ = {}, lampParticles_ = {};
  if (!lampsApart(from.lights)) {
    lamps_.clear();
    return traceLampSum(from);
  }
  std::vector<LampLight> next, dark;
  std::vector<uint8_t> used(lamps_.size(), 0);
  for (size_t i = 0; i < from.lights.lampCount(); ++i) {
    const Lamp& lamp = from.lights.lamp(i);
    size_t k = 0;
    while (k < lamps_.size() && (used[k] || !sameLight(lamps_[k].lamp, lamp))) ++k;
    if (k < lamps_.size()) {
      used[k] = 1;
      next.push_back(std::move(lamps_[k]));
      next.back().lamp = lamp;
    } else {
      next.push_back({lamp, {}, {}});
      traceLamp(from, next.back());
    }
  }
  for (size_t k = lamps_.size(); k-- > 0 && dark.size() < kDarkLamps;) {
    if (used[k]) continue;
    dark.push_back(std::move(lamps_[k]));
    dark.back().lamp.intensityCd = {};
  }
  next.insert(next.end(), std::make_move_iterator(dark.rbegin()), std::make_move_iterator(dark.rend()));
  lamps_ = std::move(next);
}

void LightCache::forgetLampsBut(const Lights& lights) {
  std::erase_if(lamps_, [&](const LampLight& known) {
    for (size_t i = 0; i < lights.lampCount(); ++i) {
      if (sameLight(known.lamp, lights.lamp(i))) return false;
    }
    return true;
  });
}

bool LightCache::hasFewParticles() const {
  return std::any_of(emitters_.begin(), emitters_.end(), [](const EmitterLight& e) { return e.needsAllParticles(); }) ||
         std::any_of(lamps_.begin(), lamps_.end(), [](const LampLight& l) { return l.needsAllParticles(); });
}

int LightCache::bouncesOfUpdate() {
  return mostAtOnce_ = settings_.bouncesAtOnce > 0 ? std::min(settings_.bouncesAtOnce, settings_.maxBounces)
                                                   : settings_.maxBounces;
}

void LightCache::solve(const Sources& from, int mostBounces) {
  if (from.progress.stop()) return;
  std::vector<Vec3> near = sumDirect(from);
  bounceOn(from, mostBounces, near);
}

// All that comes straight, to direct_, but what lamps leave near them.
std::vector<Vec3> LightCache::sumDirect(const Sources& from) {
  const Voxels& voxels = from.voxels;
  direct_.assign(voxels.slots.size(), {});
  for (const SlotLight* light : {&suns_, &sky_, &lampsTogether_, &emittersTogether_})
    light->addTo(voxels, Vec3(1), direct_);
  for (const EmitterLight& e : emitters_) {
    if (!isBlack(e.scale)) e.direct.addTo(voxels, e.scale, direct_);
  }
  for (const LampLight& l : lamps_) {
    if (!isBlack(l.lamp.intensityCd)) l.direct.addTo(voxels, l.lamp.intensityCd, direct_);
  }
  holdSun(from);
  if (!links_.hidden.empty()) {
    hidden_ = lightOfHidden({from.rays, from.lights}, slots(from), links_, field_, settings_.layers.get(), field_.rays);
    for (std::vector<Vec3>& hidden : hidden_) {
      smooth(links_, hidden);
      for (size_t i = 0; i < hidden.size(); ++i) direct_[i] += hidden[i];
    }
    if (!settings_.layers) hidden_.clear();
  }
  std::vector<Vec3> near, far;
  for (const LitParticles& p : litParticles()) {
    near.resize(voxels.slots.size()), far.resize(voxels.slots.size());
    p.particles->near.addTo(voxels, p.scale, near);
    p.particles->far.addTo(voxels, p.scale, far);
  }
  smooth(links_, far);
  for (size_t i = 0; i < far.size(); ++i) direct_[i] += far[i];
  return near;
}

// What the sun lights sends its light on by place: links start from what arrives.
void LightCache::holdSun(const Sources& from) {
  sunHeld_.clear(), sunArrives_.clear();
  if (field_.sunPoints.empty() || from.progress.stop()) return;
  const Voxels& voxels = from.voxels;
  std::vector<Vec3> sun(voxels.slots.size());
  suns_.addTo(voxels, Vec3(1), sun);
  const BrightPatches patches(from.rays, voxels, field_.sunPoints, {}, 0, settings_.seed);
  if (patches.empty()) return;
  std::vector<Vec3> reflected(sun.size());
  parallelFor(sun.size(), 8192, [&](size_t i) {
    if (!patches.holdsSun(static_cast<int64_t>(i))) sun[i] = {};
    reflected[i] = voxels.slots[i].albedo * sun[i];
  });
  sunArrives_ = lightFrom(patches, from.rays, slots(from), links_, reflected, field_.rays);
  smooth(links_, sunArrives_);
  parallelFor(sun.size(), 8192, [&](size_t i) { direct_[i] = max(Vec3(0), direct_[i] - sun[i]) + sunArrives_[i]; });
  sunHeld_ = std::move(sun);
}

void LightCache::bounceOn(const Sources& from, int mostBounces, std::vector<Vec3>& near) {
  const Voxels& voxels = from.voxels;
  RadianceSettings once = settings_;
  once.maxBounces = mostBounces;
  const Bounces done = once.bounceBy == BounceBy::Cones
                           ? bounceByCones(voxels, paths_, direct_, indirect_, once, from.progress)
                           : bounce(voxels, links_, direct_, indirect_, once, from.progress);
  settled_ = !hasFewParticles() && (done.done < mostBounces || mostBounces >= settings_.maxBounces);
  field_.bounces = done.done, field_.residual = done.residual;
  if (!from.progress.stop()) fillField(from, near);
  if (settings_.layers && !from.progress.stop()) splitIntoLayers(from, done);
  if (from.progress.stop()) field_.irradianceLux.clear();
}

void LightCache::fillField(const Sources& from, std::vector<Vec3>& near) {
  const Voxels& voxels = from.voxels;
  std::vector<Vec3> shared = indirect_, radiance(settings_.pyramid ? voxels.slots.size() : 0), glow(near.size());
  smooth(links_, shared);
  field_.irradianceLux.resize(voxels.slots.size());
  field_.glowShare.resize(near.size());
  parallelFor(voxels.slots.size(), 8192, [&](size_t i) {
    const Vec3 e = direct_[i] + shared[i] + (sunHeld_.empty() ? Vec3() : sunHeld_[i]);
    field_.irradianceLux[i] = e;
    if (settings_.pyramid) radiance[i] = voxels.slots[i].albedo * e / kPi;
    if (near.empty()) return;
    field_.irradianceLux[i] += near[i];
    field_.glowShare[i] = luminance(near[i]) / std::max(luminance(field_.irradianceLux[i]), 1e-30f);
    glow[i] = voxels.slots[i].albedo * near[i] / kPi;
  });
  field_.sunLux.clear();
  if (from.lights.sunCount() == 1 && !suns_.empty()) {
    std::vector<Vec3> sun(voxels.slots.size());
    suns_.addTo(voxels, Vec3(1), sun);
    field_.sunLux.resize(sun.size());
    parallelFor(sun.size(), 8192, [&](size_t i) { field_.sunLux[i] = luminance(sun[i]); });
  }
  field_.glow = LampGlow(glowPoints(glow), voxels.voxelSizeM);
  if (settings_.pyramid) buildPyramid(voxels, radiance, glow, field_);
}

std::vector<Vec3> LightCache::sharpLux(const Voxels& voxels, std::span<const uint32_t> emissive) const {
  std::vector<Vec3> out(voxels.slots.size());
  suns_.addTo(voxels, Vec3(1), out);
  for (const LampLight& l : lamps_) {
    if (!isBlack(l.lamp.intensityCd) && isSharp(l.lamp)) l.direct.addTo(voxels, l.lamp.intensityCd, out);
  }
  for (const EmitterLight& e : emitters_) {
    if (std::find(emissive.begin(), emissive.end(), e.mesh.instance) != emissive.end() && !isBlack(e.scale))
      e.direct.addTo(voxels, e.scale, out);
  }
  return out;
}

// Of all that shines and has left any.
std::vector<LightCache::LitParticles> LightCache::litParticles() const {
  std::vector<LitParticles> out;
  for (const EmitterLight& e : emitters_) out.push_back({&e.particles, e.scale, -1, e.index});
  for (size_t i = 0; i < lamps_.size(); ++i)
    out.push_back({&lamps_[i].particles, lamps_[i].lamp.intensityCd, static_cast<int32_t>(i), -1});
  out.push_back({&lampParticles_, Vec3(1), -1, -1});
  std::erase_if(out, [](const LitParticles& p) { return p.particles->near.empty() || isBlack(p.scale); });
  return out;
}

// Of all sources' points as many as their flux asks for, so that in the end all have about the same.
std::vector<GlowPoint> LightCache::glowPoints(const std::vector<Vec3>& glow) const {
  const auto sources = litParticles();
  float fluxLm = 0;
  for (const LitParticles& p : sources) {
    if (!p.particles->points.empty()) fluxLm += luminance(p.scale) * p.particles->fluxLm;
  }
  std::vector<GlowPoint> points;
  float carry = 0.5f;
  for (const LitParticles& p : sources) {
    for (GlowPoint g : p.particles->points) {
      if (p.lamp >= 0 || p.emitter >= 0) g.lamp = p.lamp, g.emitter = p.emitter;
      g.fluxLm *= p.scale;
      const float copies = luminance(g.fluxLm) * kGlowPoints / fluxLm;
      g.fluxLm = g.fluxLm / copies;
      g.radianceCdM2 = g.slot < 0 ? kUnseen : luminance(glow[static_cast<size_t>(g.slot)]);
      for (carry += copies; carry >= 1; --carry) points.push_back(g);
    }
  }
  return points;
}

size_t LightCache::bytes() const {
  size_t sum = paths_.bytes() + links_.bytes() + suns_.bytes() + sky_.bytes() + lampsTogether_.bytes() +
               lampParticles_.bytes() + emittersTogether_.bytes() + skyWays_.size() * sizeof(skyWays_[0]) +
               (direct_.size() + indirect_.size()) * sizeof(Vec3);
  for (const LampLight& l : lamps_) sum += l.direct.bytes() + l.particles.bytes();
  for (const EmitterLight& e : emitters_) sum += e.direct.bytes() + e.particles.bytes();
  return sum;
}

}  // namespace roomlight
