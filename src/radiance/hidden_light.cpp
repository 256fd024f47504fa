#include "radiance/hidden_light.h"

#include <atomic>

#include "base/parallel.h"
#include "radiance/near_lights.h"
#include "radiance/slot_samples.h"
#include "trace/traced_scene.h"

namespace roomlight {
namespace {

class HiddenLight {
 public:
  HiddenLight(const Lights& lights, const Voxels& voxels, const SkyGuide& guide, const SeenLights& seen)
      : lights_(lights),
        voxels_(voxels),
        guide_(guide),
        seen_(seen),
        besideEmitters_(emitterSurroundings(lights, voxels.voxelSizeM)) {
    for (size_t i = 0; i < lights.lampCount(); ++i) besideLamps_.emplace_back(lights.lamp(i), voxels.voxelSizeM);
  }

  // Hands on a sample of each kind of light at a place, and the layer it belongs to, if there are `layers`.
  template <class Take>
  void at(const HiddenPlace& h, const LightLayers* layers, Sampler& sampler, const Take& take) const {
    const int32_t side = brickSideAt(voxels_, h.p, h.n);
    if (lights_.lampCount() > 0) {
      const LightSample lamp = seen_.sampleLamps(lights_, h.p, side, sampler);
      if (lamp.valid() && !besideLamps_[static_cast<size_t>(lamp.lamp)].contains(h.p))
        take(lamp, layers ? layers->of(lamp) : -1);
    }
    for (size_t i = 0; i < lights_.sunCount(); ++i)
      take(lights_.sampleSun(i, sampler.next2()), layers ? layers->sun : -1);
    if (lights_.hasEmitters()) {
      const Vec2 u = sampler.next2();
      const LightSample emitter = seen_.sampleEmitters(lights_, h.p, side, u, sampler.next1());
      if (emitter.valid() && !besideEmitters_[static_cast<size_t>(emitter.emitter)].contains(h.p))
        take(emitter, layers ? layers->of(emitter) : -1);
    }
    if (lights_.sky().present()) {
      const Vec2 u = sampler.next2();
      take(sampleSkyGuided(guide_, guideAt(guide_, voxels_, h.p, h.n), lights_, u, sampler.next1()),
           layers ? layers->sky : -1);
    }
  }

 private:
  const Lights& lights_;
  const Voxels& voxels_;
  const SkyGuide& guide_;
  const SeenLights& seen_;
  std::vector<LightSurroundings> besideLamps_;
  const std::vector<LightSurroundings> besideEmitters_;
};

}  // namespace

std::vector<std::vector<Vec3>> lightOfHidden(const TracedScene& scene, const SlotSampling& slots, const Links& links,
                                             const RadianceField& field, const LightLayers* layers,
                                             uint64_t& rayCount) {
  std::vector<std::vector<Vec3>> lux(layers ? layers->size() : 1, std::vector<Vec3>(slots.voxels.slots.size()));
  if (links.hidden.empty()) return lux;
  const HiddenLight hidden(scene.lights, slots.voxels, field.guide, field.seen);
  std::atomic<uint64_t> count = 0;
  parallelFor(links.hidden.size(), 4, [&](size_t b) {
    std::vector<SlotSamples> samples(lux.size());
    uint32_t number = 0;
    for (const HiddenPlace& h : links.hidden[b]) {
      Sampler sampler(slots.paths.key(h.slot), number++, slots.seed + 14);
      const float perLink = 1 / static_cast<float>(links.count(h.slot));
      hidden.at(h, layers, sampler, [&](const LightSample& light, int32_t layer) {
        const float cosine = dot(light.wi, h.n);
        if (light.valid() && cosine > 0)
          samples[static_cast<size_t>(std::max(0, layer))].ask(h.slot, shadowRay(offsetOrigin(h.p, h.n), h.p, light),
                                                               h.left * light.radiance * (cosine * perLink));
      });
    }
    for (size_t l = 0; l < lux.size(); ++l) count += samples[l].addTo(scene.rays, lux[l]);
  });
  rayCount += count;
  return lux;
}

}  // namespace roomlight
