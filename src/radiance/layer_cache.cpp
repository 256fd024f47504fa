// LightCache::splitIntoLayers: whose the light on slots is.
#include <utility>

#include "base/parallel.h"
#include "base/simd.h"
#include "radiance/bounces.h"
#include "radiance/light_cache.h"

namespace roomlight {
namespace {

constexpr float kMostShare = 60000;      // half floats end at 65504

void add(std::vector<Vec3>& to, const std::vector<Vec3>& what) {
  parallelFor(what.size(), 8192, [&](size_t i) { to[i] += what[i]; });
}

}  // namespace

// Light of one layer as solve() has all light: what bounces, and of that what is near small sources.
LightCache::LayerDirect LightCache::directOf(const Home& home, const LightLayers& layers, int32_t layer) {
  const Voxels& voxels = home.voxels;
  LayerDirect out;
  out.all.assign(voxels.slots.size(), {});
  if (layer == layers.sun) daylight_.suns().addTo(voxels, Vec3(1), out.all);
  if (layer == layers.sky) daylight_.sky().addTo(voxels, Vec3(1), out.all);
  for (size_t i = 0; i < layers.ofLamp.size(); ++i) {
    if (layers.ofLamp[i] == layer) lamps_.each()[i].addTo(voxels, out.all);
  }
  for (size_t i = 0; i < layers.ofEmitter.size(); ++i) {
    if (layers.ofEmitter[i] == layer) emitters_.addEmitter(tracing(home), i, out.all);
  }
  std::vector<Vec3> far;
  for (const LitParticles& p : litParticles()) {
    if ((p.lamp >= 0 ? layers.ofLamp[static_cast<size_t>(p.lamp)] : layers.ofEmitter[static_cast<size_t>(p.emitter)]) !=
        layer)
      continue;
    out.near.resize(voxels.slots.size()), far.resize(voxels.slots.size());
    p.particles->near.addTo(voxels, p.scale, out.near);
    p.particles->far.addTo(voxels, p.scale, far);
  }
  out.straight.resize(voxels.bricks.size());
  parallelFor(voxels.bricks.size(), 64, [&](size_t b) {
    const auto [first, last] = slotsOfBrick(voxels, b);
    for (size_t s = first; s < last; ++s) {
      if (!isBlack(out.all[s]) || (!out.near.empty() && !isBlack(out.near[s]))) out.straight[b] = 1;
    }
  });
  smooth(links_, far);
  add(out.all, far);
  if (layer == layers.sun && !sunHeld_.empty()) {
    out.held = sunHeld_;
    parallelFor(out.all.size(), 8192,
                [&](size_t i) { out.all[i] = max(Vec3(0), out.all[i] - sunHeld_[i]) + sunArrives_[i]; });
  }
  if (!hidden_.empty()) add(out.all, std::exchange(hidden_[static_cast<size_t>(layer)], {}));
  return out;
}

void LightCache::splitIntoLayers(const Home& home, const Bounces& like) {
  const LightLayers& layers = *settings_.layers;
  const Voxels& voxels = home.voxels;
  SlotLayers& out = field_.layers;
  out.lights = settings_.layers;
  out.stride = layerStride(layers.size());
  out.shares.assign(voxels.slots.size() * out.slotSize(), 0);
  out.reach.assign(voxels.bricks.size(), 0);
  if (!field_.glowShare.empty()) out.glowOf.assign(voxels.slots.size(), -1);
  std::vector<float> mostGlow(out.glowOf.size(), 0);
  for (size_t begin = 0; begin < layers.size() && !home.progress.stop(); begin += kLayersAtOnce) {
    const size_t count = std::min(kLayersAtOnce, layers.size() - begin);
    std::vector<std::vector<Vec3>> direct, near, held, indirect(count);
    for (size_t k = 0; k < count; ++k) {
      const size_t l = begin + k;
      LayerDirect light = directOf(home, layers, static_cast<int32_t>(l));
      for (size_t b = 0; b < voxels.bricks.size(); ++b) out.reach[b] |= static_cast<uint64_t>(light.straight[b]) << l;
      direct.push_back(std::move(light.all)), near.push_back(std::move(light.near)),
          held.push_back(std::move(light.held));
    }
    bounceLayers(voxels, links_, direct, indirect, like, home.progress);
    for (size_t k = 0; k < count; ++k) {
      smooth(links_, indirect[k]);
      keepShares(begin + k, direct[k], indirect[k], near[k], held[k], mostGlow);
    }
    home.progress.at(0.9f + 0.1f * static_cast<float>(begin + count) / static_cast<float>(layers.size()));
  }
  // So that those of a slot make one.
  parallelFor(voxels.slots.size(), 4096, [&](size_t s) {
    for (size_t c = 0; c < 3; ++c) {
      uint16_t* at = &out.shares[s * out.slotSize() + c * out.stride];
      float sum = 0;
      for (size_t l = 0; l < layers.size(); ++l) sum += fromHalf(at[l]);
      if (!(sum > 0)) continue;
      for (size_t l = 0; l < layers.size(); ++l) at[l] = toHalf(fromHalf(at[l]) / sum);
    }
  });
}

// Of one layer, relative to the light there is.
void LightCache::keepShares(size_t layer, const std::vector<Vec3>& direct, const std::vector<Vec3>& indirect,
                            const std::vector<Vec3>& near, const std::vector<Vec3>& held,
                            std::vector<float>& mostGlow) {
  SlotLayers& out = field_.layers;
  parallelFor(direct.size(), 8192, [&](size_t s) {
    const Vec3 glow = near.empty() ? Vec3(0) : near[s],
               all = direct[s] + indirect[s] + glow + (held.empty() ? Vec3(0) : held[s]);
    uint16_t* at = &out.shares[s * out.slotSize() + layer];
    for (int c = 0; c < 3; ++c) {
      const float whole = field_.irradianceLux[s][c];
      at[static_cast<size_t>(c) * out.stride] = toHalf(whole > 0 ? std::min(all[c] / whole, kMostShare) : 0);
    }
    if (!out.glowOf.empty() && luminance(glow) > mostGlow[s])
      mostGlow[s] = luminance(glow), out.glowOf[s] = static_cast<int8_t>(layer);
  });
}

}  // namespace roomlight
