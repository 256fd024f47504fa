#include "baselines/scene_survey.h"

#include "base/parallel.h"
#include "base/sampling.h"
#include "radiance/sky_guide.h"
#include "radiance/slot_paths.h"

namespace roomlight {

SkyGuide surveySky(const TracedScene& scene, const Voxels& voxels, const SlotRemap* remap, const SurveyRays& use,
                   uint64_t& rayCount, const Progress& progress) {
  SkyGuideBuilder guide(voxels, scene.lights.sky());
  std::atomic<uint64_t> count = 0;
  parallelFor(voxels.bricks.size(), 4, [&](size_t b) {
    if (progress.stop() || (remap && remap->keeps(b))) return;
    const auto [first, last] = slotsOfBrick(voxels, b);
    std::vector<Ray> tries;
    for (size_t s = first; s < last; ++s) {
      const FaceSlot& slot = voxels.slots[s];
      const Frame frame(slot.normal);
      for (int k = 0; k < use.perSlot; ++k) {
        const Vec3 d = frame.toWorld(sampleCosineHemisphere(Sampler(s, static_cast<uint32_t>(k), use.seed).next2()));
        tries.push_back({offsetOrigin(slot.position, slot.normal), d, 0, kInfinity});
      }
    }
    std::vector<Vec3> left(tries.size());
    scene.rays.transmittance(tries, left);
    for (size_t i = 0; i < tries.size(); ++i) {
      guide.add(b, voxels.slots[first + i / static_cast<size_t>(use.perSlot)].face, tries[i].direction,
                luminance(left[i]));
    }
    count += tries.size();
  });
  rayCount += count;
  return guide.finish(progress);
}

SkySurvey surveySky(const TracedScene& scene, const VoxelSettings& settings, const SurveyRays& use,
                    const Progress& progress) {
  SkySurvey out;
  if (!scene.lights.sky().present()) return out;
  out.voxels = voxelise(scene.rays.scene(), settings).voxels;
  out.guide = surveySky(scene, out.voxels, nullptr, use, out.rays, progress);
  return out;
}

}  // namespace roomlight
