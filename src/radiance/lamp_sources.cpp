// Light of lamps, kept lamp by lamp.
#include <algorithm>
#include <iterator>
#include <utility>

#include "radiance/light_sources.h"

namespace roomlight {
namespace {

constexpr size_t kMostLampsApart = 32;  // every slot sends rays to each

ParticleSource particlesOfLamp(const LightTracing& t, const Lamp& lamp) {
  return particlesOf(lamp, std::max<size_t>(1, t.lights.lampCount()), t.voxels.voxelSizeM);
}

}  // namespace

LampSource::LampSource(const LightTracing& t, const Lamp& lamp) : LightSource(lamp.intensityCd), lamp_(lamp) {
  DirectLight direct = t.direct();
  direct_ = t.lightOfAll([&](size_t b, std::vector<Vec3>& lux) { direct.lamp(lamp_, b, {}, lux); });
  t.rayCount += direct.rayCount();
  particles_ = t.particlesFrom(particlesOfLamp(t, lamp_));
}

bool LampSource::shinesLike(const Lamp& b) const {
  const Lamp& a = lamp_;
  return a.kind == b.kind && a.position == b.position && a.direction == b.direction &&
         a.innerConeRad == b.innerConeRad && a.outerConeRad == b.outerConeRad && a.web == b.web &&
         (!a.web || (a.up == b.up && a.extended == b.extended));
}

void LampSource::updateDirect(const LightTracing& t, DirectLight& direct, const SlotChange& change) {
  direct_ = t.updated(direct_, change, [&](size_t b, std::span<const Bounds3> near, std::span<Vec3> lux) {
    direct.lamp(lamp_, b, near, lux);
  });
}

void LampSource::updateParticles(const LightTracing& t, const SlotChange& change) {
  t.update(change, particlesOfLamp(t, lamp_), particles_);
}

void LampSource::traceAllParticles(const LightTracing& t) {
  if (needsAllParticles()) particles_ = t.particlesFrom(particlesOfLamp(t, lamp_));
}

bool LampSources::apart(const RadianceSettings& settings, const Lights& lights) {
  return !settings.still || settings.layers || lights.lampCount() <= kMostLampsApart;
}

void LampSources::match(const LightTracing& t) {
  together_ = {}, particlesTogether_ = {};
  if (!apart(t.settings, t.lights)) {
    each_.clear();
    DirectLight direct = t.direct();
    std::vector<LightSurroundings> around;
    for (size_t i = 0; i < t.lights.lampCount(); ++i) around.emplace_back(t.lights.lamp(i), t.voxels.voxelSizeM);
    together_ = t.lightOfAll([&](size_t b, std::vector<Vec3>& lux) { direct.lamps(around, b, lux); });
    particlesTogether_ = traceLampParticles(t.slots(), t.lights, t.settings.attenuation, t.progress);
    t.rayCount += direct.rayCount() + particlesTogether_.rays;
    return;
  }
  std::vector<LampSource> next, dark;
  std::vector<uint8_t> used(each_.size(), 0);
  for (size_t i = 0; i < t.lights.lampCount(); ++i) {
    const Lamp& lamp = t.lights.lamp(i);
    size_t k = 0;
    while (k < each_.size() && (used[k] || !each_[k].shinesLike(lamp))) ++k;
    if (k < each_.size()) {
      used[k] = 1;
      next.push_back(std::move(each_[k]));
      next.back().become(lamp);
    } else {
      next.emplace_back(t, lamp);
    }
  }
  size_t darkBytes = 0;
  for (size_t k = each_.size(); k-- > 0 && dark.size() < kMostDarkSources;) {
    if (used[k] || darkBytes + each_[k].bytes() > kMostDarkBytes) continue;
    darkBytes += each_[k].bytes();
    dark.push_back(std::move(each_[k]));
    dark.back().switchOff();
  }
  next.insert(next.end(), std::make_move_iterator(dark.rbegin()), std::make_move_iterator(dark.rend()));
  each_ = std::move(next);
}

void LampSources::forgetBut(const Lights& lights) {
  std::erase_if(each_, [&](const LampSource& known) {
    for (size_t i = 0; i < lights.lampCount(); ++i) {
      if (known.shinesLike(lights.lamp(i))) return false;
    }
    return true;
  });
}

void LampSources::update(const LightTracing& t, const SlotChange& change) {
  forgetBut(t.lights);
  if (apart(t.settings, t.lights)) {  // else match() lights them together
    DirectLight direct = t.direct();
    for (LampSource& lamp : each_) lamp.updateDirect(t, direct, change);
    t.rayCount += direct.rayCount();
  }
  for (LampSource& lamp : each_) lamp.updateParticles(t, change);
}

void LampSources::traceAllParticles(const LightTracing& t) {
  for (LampSource& lamp : each_) lamp.traceAllParticles(t);
}

bool LampSources::hasFewParticles() const {
  return std::any_of(each_.begin(), each_.end(), [](const LampSource& l) { return l.needsAllParticles(); });
}

void LampSources::addParticles(std::vector<LitParticles>& to) const {
  for (size_t i = 0; i < each_.size(); ++i)
    to.push_back({&each_[i].particles(), each_[i].scale(), static_cast<int32_t>(i), -1});
  to.push_back({&particlesTogether_, Vec3(1), -1, -1});
}

size_t LampSources::bytes() const {
  size_t sum = together_.bytes() + particlesTogether_.bytes();
  for (const LampSource& lamp : each_) sum += lamp.bytes();
  return sum;
}

}  // namespace roomlight
