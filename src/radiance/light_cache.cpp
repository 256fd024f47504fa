#include "radiance/light_cache.h"

#include <atomic>
#include <mutex>

#include "base/parallel.h"
#include "radiance/bounces.h"
#include "radiance/hidden_light.h"
#include "radiance/pyramid.h"
#include "radiance/sun_bounce.h"
#include "trace/lamp_light.h"

namespace roomlight {
namespace {

constexpr float kUnseen = 1e12f;   // cd/m²: of glow that no voxel shows, so that points take all of it
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
    : settings_(settings),
      paths_(rays, voxels, settings.seed, progress, settings.still),
      importance_(rays, voxels, settings.views, settings.seed, progress) {
  const Home home{rays, lights, voxels, progress};
  const SkyGuide othersGuide = traceAllLinks(home);
  progress.at(0.5f);
  daylight_.trace(tracing(home), links_, othersGuide, field_.sunPoints);
  matchSources(home);
  progress.at(0.8f);
  indirect_.assign(voxels.slots.size(), {});
  marks_ = marksOf(voxels);
  solve(home, settings.maxBounces);
}

void LightCache::relight(const RayScene& rays, const Lights& lights, const Voxels& voxels, const Progress& progress) {
  const Home home{rays, lights, voxels, progress};
  field_.rays = 0;
  fewParticles_ = settings_.bouncesAtOnce > 0;
  paths_.refer(rays, voxels);
  matchSources(home);
  progress.at(0.5f);
  solve(home, bouncesOfUpdate());
}

void LightCache::goOn(const RayScene& rays, const Lights& lights, const Voxels& voxels, const Progress& progress) {
  if (settled_) return;
  field_.rays = 0;
  const Home home{rays, lights, voxels, progress};
  paths_.refer(rays, voxels);
  fewParticles_ = false;
  emitters_.traceAllParticles(tracing(home));
  lamps_.traceAllParticles(tracing(home));
  mostAtOnce_ = std::min(2 * mostAtOnce_, settings_.maxBounces);
  solve(home, mostAtOnce_);
}

void LightCache::followDaylight(const RayScene& rays, const Lights& lights, const Voxels& voxels,
                                const Progress& progress) {
  const Home home{rays, lights, voxels, progress};
  field_.rays = 0;
  paths_.refer(rays, voxels);
  const SkyGuide othersGuide = findGuide(home);
  daylight_.trace(tracing(home), links_, othersGuide, field_.sunPoints);
  matchSources(home);
  progress.at(0.5f);
  if (progress.stop()) return field_.irradianceLux.clear();
  const Vec3 before = fluxOf(voxels, direct_);
  std::vector<Vec3> near = sumDirect(home);
  const Vec3 now = fluxOf(voxels, direct_);
  const auto darker = [](float to, float of) { return to < of ? to / of : 1; };
  const Vec3 scale{darker(now.x, before.x), darker(now.y, before.y), darker(now.z, before.z)};
  for (Vec3& v : indirect_) v *= scale;
  bounceOn(home, bouncesOfUpdate(), near);
}

SkyGuide LightCache::traceAllLinks(const Home& home) {
  const bool hasSky = home.lights.sky().present();
  SkyGuideBuilder guide(home.voxels, home.lights.sky());
  if (home.progress.stop()) return {};
  links_ = planLinks(home.voxels, paths_, settings_.links, importance_);
  if (settings_.still) links_.hidden.resize(home.voxels.bricks.size());
  Steps steps(home.progress, 0, 0.5f, home.voxels.bricks.size());
  parallelFor(home.voxels.bricks.size(), 4, [&](size_t b) {
    if (home.progress.stop()) return;
    traceLinks(slots(home), b, linksOfBrick(home.voxels, links_, b), links_, hasSky ? &guide : nullptr);
    steps.one();
  });
  field_.rays += links_.links.size();
  if (home.progress.stop() || !hasSky) return {};
  field_.guide = guide.finish(home.progress);
  return settings_.still ? guide.finishOfOthers(home.progress) : SkyGuide();
}

// Of links traced before.
SkyGuide LightCache::findGuide(const Home& home) {
  field_.guide = {};
  if (!home.lights.sky().present()) return {};
  SkyGuideBuilder guide(home.voxels, home.lights.sky());
  std::atomic<uint64_t> followed = 0;
  parallelFor(home.voxels.bricks.size(), 4, [&](size_t b) {
    if (!home.progress.stop()) followed += lookAtSky(slots(home), b, links_, guide);
  });
  field_.rays += followed;
  field_.guide = guide.finish(home.progress);
  return settings_.still ? guide.finishOfOthers(home.progress) : SkyGuide();
}

// What is seen of lamps and emissive meshes. Where things move it would change with them, and with it the random
// choices of all that sees them.
void LightCache::learnLights(const Home& home) {
  field_.seen = {};
  if (settings_.still && !home.progress.stop())
    field_.seen = SeenLights(home.rays, home.lights, home.voxels, paths_, settings_.seed, field_.rays);
}

void LightCache::matchSources(const Home& home) {
  learnLights(home);
  emitters_.match(tracing(home));
  lamps_.match(tracing(home));
}

int LightCache::bouncesOfUpdate() {
  return mostAtOnce_ = settings_.bouncesAtOnce > 0 ? std::min(settings_.bouncesAtOnce, settings_.maxBounces)
                                                   : settings_.maxBounces;
}

void LightCache::solve(const Home& home, int mostBounces) {
  if (home.progress.stop()) return;
  std::vector<Vec3> near = sumDirect(home);
  bounceOn(home, mostBounces, near);
}

// All that comes straight, to direct_, but what lamps leave near them.
std::vector<Vec3> LightCache::sumDirect(const Home& home) {
  const Voxels& voxels = home.voxels;
  direct_.assign(voxels.slots.size(), {});
  for (const SlotLight* light : {&daylight_.suns(), &daylight_.sky(), &lamps_.together(), &emitters_.together()})
    light->addTo(voxels, Vec3(1), direct_);
  for (const EmitterSource& e : emitters_.each()) e.addTo(voxels, direct_);
  for (const LampSource& l : lamps_.each()) l.addTo(voxels, direct_);
  holdSun(home);
  if (!links_.hidden.empty()) {
    hidden_ = lightOfHidden({home.rays, home.lights}, slots(home), links_, field_, settings_.layers.get(), field_.rays);
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
void LightCache::holdSun(const Home& home) {
  sunHeld_.clear(), sunArrives_.clear();
  if (field_.sunPoints.empty() || home.progress.stop()) return;
  const Voxels& voxels = home.voxels;
  std::vector<Vec3> sun(voxels.slots.size());
  daylight_.suns().addTo(voxels, Vec3(1), sun);
  const BrightPatches patches(home.rays, voxels, field_.sunPoints, {}, 0, settings_.seed);
  if (patches.empty()) return;
  std::vector<Vec3> reflected(sun.size());
  parallelFor(sun.size(), 8192, [&](size_t i) {
    if (!patches.holdsSun(static_cast<int64_t>(i))) sun[i] = {};
    reflected[i] = voxels.slots[i].albedo * sun[i];
  });
  sunArrives_ = lightFrom(patches, home.rays, slots(home), links_, reflected, field_.rays);
  smooth(links_, sunArrives_);
  parallelFor(sun.size(), 8192, [&](size_t i) { direct_[i] = max(Vec3(0), direct_[i] - sun[i]) + sunArrives_[i]; });
  sunHeld_ = std::move(sun);
}

void LightCache::bounceOn(const Home& home, int mostBounces, std::vector<Vec3>& near) {
  const Voxels& voxels = home.voxels;
  RadianceSettings once = settings_;
  once.maxBounces = mostBounces;
  const Bounces done = once.bounceBy == BounceBy::Cones
                           ? bounceByCones(voxels, paths_, direct_, indirect_, once, home.progress)
                           : bounce(voxels, links_, direct_, indirect_, once, home.progress);
  settled_ = !emitters_.hasFewParticles() && !lamps_.hasFewParticles() &&
             (done.done < mostBounces || mostBounces >= settings_.maxBounces);
  field_.bounces = done.done, field_.residual = done.residual;
  if (!home.progress.stop()) fillField(home, near);
  if (settings_.layers && !home.progress.stop()) splitIntoLayers(home, done);
  if (home.progress.stop()) field_.irradianceLux.clear();
}

void LightCache::fillField(const Home& home, std::vector<Vec3>& near) {
  const Voxels& voxels = home.voxels;
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
  if (home.lights.sunCount() == 1 && !daylight_.suns().empty()) {
    std::vector<Vec3> sun(voxels.slots.size());
    daylight_.suns().addTo(voxels, Vec3(1), sun);
    field_.sunLux.resize(sun.size());
    parallelFor(sun.size(), 8192, [&](size_t i) { field_.sunLux[i] = luminance(sun[i]); });
  }
  field_.glow = LampGlow(glowPoints(glow), voxels.voxelSizeM);
  if (settings_.pyramid) buildPyramid(voxels, radiance, glow, field_);
}

std::vector<Vec3> LightCache::sharpLux(const Voxels& voxels, std::span<const uint32_t> emissive) const {
  std::vector<Vec3> out(voxels.slots.size());
  daylight_.suns().addTo(voxels, Vec3(1), out);
  for (const LampSource& l : lamps_.each()) {
    if (isSharp(l.lamp())) l.addTo(voxels, out);
  }
  for (const EmitterSource& e : emitters_.each()) {
    if (std::find(emissive.begin(), emissive.end(), e.mesh().instance) != emissive.end()) e.addTo(voxels, out);
  }
  return out;
}

// Of all that shines and has left any.
std::vector<LitParticles> LightCache::litParticles() const {
  std::vector<LitParticles> out;
  emitters_.addParticles(out);
  lamps_.addParticles(out);
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
  return paths_.bytes() + links_.bytes() + daylight_.bytes() + emitters_.bytes() + lamps_.bytes() +
         (direct_.size() + indirect_.size()) * sizeof(Vec3);
}

}  // namespace roomlight
