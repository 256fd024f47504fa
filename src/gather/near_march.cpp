#include "gather/near_march.h"

#include <cmath>

namespace roomlight {
namespace {

struct Crossing {
  float t;
  size_t slot;
};

// Slots of one voxel that the ray crosses between t0 and t1, nearest first.
int crossings(const Voxels& voxels, const SurfaceVoxel& voxel, Vec3 origin, Vec3 d, float t0, float t1, Crossing (&out)[6]) {
  int found = 0;
  const size_t end = voxel.firstSlot + static_cast<size_t>(std::popcount(static_cast<unsigned>(voxel.faces)));
  for (size_t s = voxel.firstSlot; s < end; ++s) {
    const FaceSlot& slot = voxels.slots[s];
    const float facing = dot(slot.normal, d);
    if (facing >= -1e-4f) continue;
    const float t = dot(slot.normal, slot.position - origin) / facing;
    if (t < t0 || t >= t1) continue;
    int k = found++;
    for (; k > 0 && out[k - 1].t > t; --k) out[k] = out[k - 1];
    out[k] = {t, s};
  }
  return found;
}

}  // namespace

void marchNear(const Voxels& voxels, const RadianceField& field, Vec3 origin, Vec3 d, float tEnd, float lambda, ConeLight& light) {
  const float h = voxels.voxelSizeM;
  const Vec3 q = (origin - voxels.origin) / h;
  int cell[3], step[3];
  float next[3], delta[3];
  for (int k = 0; k < 3; ++k) {
    cell[k] = static_cast<int>(std::floor(q[k]));
    step[k] = d[k] < 0 ? -1 : 1;
    delta[k] = h / std::max(std::abs(d[k]), 1e-9f);
    const float toEdge = d[k] < 0 ? q[k] - static_cast<float>(cell[k]) : static_cast<float>(cell[k]) + 1 - q[k];
    next[k] = toEdge * delta[k];
  }
  for (float t0 = 0; t0 < tEnd;) {
    const int axis = next[0] < next[1] ? (next[0] < next[2] ? 0 : 2) : (next[1] < next[2] ? 1 : 2);
    const float t1 = std::min(next[axis], tEnd);
    const int64_t record = voxels.voxelAt({cell[0], cell[1], cell[2]});
    if (record >= 0) {
      Crossing met[6];
      const int count = crossings(voxels, voxels.voxels[static_cast<size_t>(record)], origin, d, t0, t1, met);
      for (int i = 0; i < count; ++i) {
        const size_t s = met[i].slot;
        const float alpha = static_cast<float>(field.coverage[s]) * (1.0f / 255);
        light.radiance += voxels.slots[s].albedo * field.irradianceLux[s] * (light.left * alpha / kPi);
        light.occlusion += light.left * alpha / (1 + lambda * met[i].t);
        light.left *= 1 - alpha;
      }
      if (light.left < 0.004f) {
        light.left = 0;
        return;
      }
    }
    t0 = next[axis];
    cell[axis] += step[axis];
    next[axis] += delta[axis];
  }
}

}  // namespace roomlight
