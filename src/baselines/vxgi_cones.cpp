#include "baselines/vxgi.h"

namespace roomlight {
namespace {

constexpr float kOpaque = 0.01f;  // what is left of a cone when it is given up

}  // namespace

Vec3 traceVxgiCone(const VxgiClipmap& map, Vec3 origin, Vec3 d, float tanHalf, const VxgiTracing& tracing) {
  const int coarsest = map.levels() - 1;
  const float finestM = map.voxelSizeM(0), coarsestM = map.voxelSizeM(coarsest);
  __m128 sum = _mm_setzero_ps();
  float left = 1, t = 0;
  for (int i = 0; i < tracing.maxSamples && left > kOpaque; ++i) {
    const int here = map.levelAt(origin + d * t);
    if (here > coarsest) break;
    // As wide as the cone in the middle of the step, on no finer level than there is.
    const float wide = std::clamp(2 * tanHalf * t, map.voxelSizeM(here), coarsestM), stepM = tracing.step * wide;
    const Vec3 p = origin + d * (t + 0.5f * stepM);
    const int there = map.levelAt(p);
    if (there > coarsest) break;
    const float lod = std::max(static_cast<float>(there), std::log2(wide / finestM));
    const int level = std::min(coarsest, static_cast<int>(lod));
    __m128 found = map.sample(level, p, d);
    if (const float coarser = lod - static_cast<float>(level); coarser > 0 && level < coarsest) {
      found = _mm_fmadd_ps(_mm_set1_ps(coarser), _mm_sub_ps(map.sample(level + 1, p, d), found), found);
    }
    const float alpha = _mm_cvtss_f32(_mm_shuffle_ps(found, found, 0xff));
    if (alpha > 1e-4f) {
      // Opacity is that of a whole voxel: of a step through it, 1 - (1 - alpha)^step.
      const float clear = std::max(0.0f, 1 - alpha), passes = tracing.step == 0.5f ? std::sqrt(clear) : std::pow(clear, tracing.step);
      sum = _mm_fmadd_ps(_mm_set1_ps(left * (1 - passes) / alpha), found, sum);
      left *= passes;
    }
    t += stepM;
  }
  alignas(16) float rgba[4];
  _mm_store_ps(rgba, sum);
  return Vec3{rgba[0], rgba[1], rgba[2]} * map.unit();
}

VxgiCones::VxgiCones(int count) {
  // Fibonacci's spiral on the hemisphere: equal solid angles.
  constexpr float kGoldenRad = 2.39996323f;
  float sum = 0;
  for (int i = 0; i < count; ++i) {
    const float z = 1 - (static_cast<float>(i) + 0.5f) / static_cast<float>(count), r = std::sqrt(1 - z * z), phi = kGoldenRad * static_cast<float>(i);
    direction.push_back({r * std::cos(phi), r * std::sin(phi), z});
    weight.push_back(z);
    sum += z;
  }
  for (float& w : weight) w /= sum;
  // Each has 1 / count of the hemisphere's 2 pi: its half-angle's cosine is 1 - 1 / count.
  const float cosHalf = std::max(0.5f, 1 - 1 / static_cast<float>(count));
  tanHalf = std::sqrt(1 - cosHalf * cosHalf) / cosHalf;
}

Vec3 traceVxgiDiffuse(const VxgiClipmap& map, Vec3 p, Vec3 ng, Vec3 ns, const VxgiCones& cones, float turnRad, const VxgiTracing& tracing) {
  const int level = map.levelAt(p);
  if (level == map.levels()) return {};
  const Frame frame(ns);
  const Vec3 origin = p + ng * (tracing.startOffsetVoxels * map.voxelSizeM(level));
  const float c = std::cos(turnRad), s = std::sin(turnRad);
  Vec3 sum;
  for (size_t i = 0; i < cones.direction.size(); ++i) {
    const Vec3 local = cones.direction[i], d = frame.toWorld({local.x * c - local.y * s, local.x * s + local.y * c, local.z});
    sum += traceVxgiCone(map, origin, d, cones.tanHalf, tracing) * cones.weight[i];
  }
  return sum;
}

}  // namespace roomlight
