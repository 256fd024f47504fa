#include "radiance/bounces.h"

#include "base/parallel.h"
#include "base/sampling.h"
#include "radiance/pyramid.h"

namespace roomlight {
namespace {

constexpr uint32_t kCones = 8;
constexpr float kTanHalf = 0.1f;
constexpr float kStart = 0.04f;  // voxels in front of a slot's points
constexpr float kLeak = 0.5f;  // what slips through surfaces along their edges: a cone that has met more than half of
                               // what it could is scaled to all
constexpr double kFading = 0.9;  // from one bounce to the next, before it is known

}  // namespace

Bounces bounceByCones(const Voxels& voxels, const SlotPaths& paths, std::span<const Vec3> direct,
                      std::vector<Vec3>& indirect, const RadianceSettings& settings, const Progress& progress) {
  Bounces out;
  RadianceField field;
  std::vector<Vec3> radiance(voxels.slots.size()), gathered(voxels.slots.size());
  double before = 0;
  while (out.done < settings.maxBounces && !progress.stop()) {
    parallelFor(radiance.size(), 8192,
                [&](size_t s) { radiance[s] = voxels.slots[s].albedo * (direct[s] + indirect[s]) / kPi; });
    buildPyramid(voxels, radiance, {}, field);
    parallelFor(gathered.size(), 256, [&](size_t s) {
      gathered[s] = {};
      if (progress.stop()) return;
      const Vec3 n = voxels.slots[s].normal;
      for (uint32_t k = 0; k < kCones; ++k) {
        Sampler sampler(paths.key(s), k, settings.seed + 9);
        const Vec3 d = Frame(n).toWorld(sampleCosineHemisphere(sampler.next2()));
        const ConeStart from{paths.point(s, k) + n * (kStart * voxels.voxelSizeM), n};
        const ConeLight met = marchCone(field, from, d, {kTanHalf}, sampler.next1());
        gathered[s] += met.radiance * (kPi / static_cast<float>(kCones) / (met.left < kLeak ? 1 - met.left : 1));
      }
    });
    // As for links: relative to the light of each slot, averaged where there is change.
    double squares = 0, fractions = 0;
    for (size_t s = 0; s < gathered.size(); ++s) {
      const double light = static_cast<double>(luminance(direct[s] + gathered[s]));
      const double r = std::abs(static_cast<double>(luminance(gathered[s] - indirect[s]))) / (light + 1e-30),
                   area = static_cast<double>(voxels.slots[s].areaM2);
      squares += area * r * r, fractions += area * r;
    }
    indirect.swap(gathered);
    const double delta = fractions > 0 ? squares / fractions : 0;
    const double fading = std::clamp(before > 0 ? delta / before : kFading, 0.0, 0.99);
    before = delta;
    out.residual = delta * fading / (1 - fading);
    ++out.done;
    if (out.residual <= settings.residual) break;
  }
  return out;
}

}  // namespace roomlight
