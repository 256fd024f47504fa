#include "baselines/sky_survey.h"

#include "base/parallel.h"
#include "base/sampling.h"
#include "radiance/sky_guide.h"
#include "radiance/slot_paths.h"

namespace roomlight {

SkySurvey surveySky(const RayScene& rays, const Lights& lights, const VoxelSettings& settings, int raysPerSlot, uint64_t seed, const Progress& progress) {
  SkySurvey out;
  if (!lights.sky().present()) return out;
  out.voxels = voxelise(rays.scene(), settings).voxels;
  SkyGuideBuilder guide(out.voxels, lights.sky());
  std::atomic<uint64_t> count = 0;
  parallelFor(out.voxels.bricks.size(), 4, [&](size_t b) {
    if (progress.stop()) return;
    const auto [first, last] = slotsOfBrick(out.voxels, b);
    std::vector<Ray> tries;
    for (size_t s = first; s < last; ++s) {
      const FaceSlot& slot = out.voxels.slots[s];
      const Frame frame(slot.normal);
      for (int k = 0; k < raysPerSlot; ++k) {
        const Vec3 d = frame.toWorld(sampleCosineHemisphere(Sampler(s, static_cast<uint32_t>(k), seed).next2()));
        tries.push_back({offsetOrigin(slot.position, slot.normal), d, 0, kInfinity});
      }
    }
    std::vector<Vec3> left(tries.size());
    rays.transmittance(tries, left);
    for (size_t i = 0; i < tries.size(); ++i) {
      guide.add(b, out.voxels.slots[first + i / static_cast<size_t>(raysPerSlot)].face, tries[i].direction, luminance(left[i]));
    }
    count += tries.size();
  });
  out.guide = guide.finish(progress);
  out.rays = count;
  return out;
}

}  // namespace roomlight
