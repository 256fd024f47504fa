#include "baselines/scene_survey.h"

#include <algorithm>
#include <array>
#include <vector>

#include "base/sampler.h"
#include "base/sampling.h"

namespace roomlight {

Bounds3 roomAround(const RayScene& rays, Vec3 eye) {
  constexpr uint32_t kRays = 4096;
  constexpr size_t kLeftOut = kRays / 50;
  std::array<std::vector<float>, 3> met;
  for (uint32_t i = 0; i < kRays; ++i) {
    const Vec3 d = sampleSphere(Sampler(0, i, 0).next2());
    const Hit hit = rays.intersect({eye, d, 0, kInfinity});
    for (int k = 0; hit.valid() && k < 3; ++k) met[static_cast<size_t>(k)].push_back(eye[k] + d[k] * hit.t);
  }
  if (met[0].size() <= 2 * kLeftOut) return rays.bounds();
  Bounds3 out;
  for (int k = 0; k < 3; ++k) {
    std::vector<float>& m = met[static_cast<size_t>(k)];
    std::sort(m.begin(), m.end());
    out.lo[k] = m[kLeftOut], out.hi[k] = m[m.size() - 1 - kLeftOut];
  }
  out.add(eye);
  return out;
}

}  // namespace roomlight
