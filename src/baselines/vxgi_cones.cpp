#include <cmath>

#include "baselines/vxgi.h"

namespace roomlight {
namespace {

constexpr float kOpaque = 0.01f;  // what is left of a cone when it is given up

}  // namespace

Vec3 traceVxgiCone(const VxgiClipmap& map, Vec3 origin, Vec3 d, float tanHalf, const VxgiTracing& tracing) {
  const int coarsest = map.levels() - 1;
  const float perFinest = 1 / map.voxelSizeM(0), coarsestM = map.voxelSizeM(coarsest);
  Float4 sum;
  float left = 1, t = 0;
  int finest = map.levelAt(origin);
  for (int i = 0; i < tracing.maxSamples && left > kOpaque && finest <= coarsest; ++i) {
    // As wide as the cone, on no finer level than there is; sampled in the middle of the step.
    const float wide = std::clamp(2 * tanHalf * t, map.voxelSizeM(finest), coarsestM), stepM = tracing.step * wide;
    const Vec3 p = origin + d * (t + 0.5f * stepM);
    t += stepM;
    finest = map.levelAt(p, finest);
    if (finest > coarsest) break;
    // Between the two levels whose voxels are next to the width, in proportion to it.
    int level;
    float coarser = 2 * std::frexp(wide * perFinest, &level) - 1;
    if (--level < finest) level = finest, coarser = 0;
    Float4 found = map.sample(level, p, d);
    if (coarser > 0 && level < coarsest) found = fma(Float4(coarser), map.sample(level + 1, p, d) - found, found);
    const float alpha = found.everyW().x();
    if (alpha > 1e-4f) {
      // Opacity is that of a whole voxel: of a step through it, 1 - (1 - alpha)^step.
      const float clear = std::max(0.0f, 1 - alpha),
                  passes = tracing.step == 0.5f ? std::sqrt(clear) : std::pow(clear, tracing.step);
      sum = fma(Float4(left * (1 - passes) / alpha), found, sum);
      left *= passes;
    }
  }
  float rgba[4];
  sum.store(rgba);
  return Vec3{rgba[0], rgba[1], rgba[2]} * map.unit();
}

VxgiCones::VxgiCones(int count) {
  // Fibonacci's spiral on the hemisphere: equal solid angles.
  constexpr float kGoldenRad = 2.39996323f;
  float sum = 0;
  for (int i = 0; i < count; ++i) {
    const float z = 1 - (static_cast<float>(i) + 0.5f) / static_cast<float>(count), r = std::sqrt(1 - z * z),
                phi = kGoldenRad * static_cast<float>(i);
    direction.push_back({r * std::cos(phi), r * std::sin(phi), z});
    weight.push_back(z);
    sum += z;
  }
  for (float& w : weight) w /= sum;
  // Each has 1 / count of the hemisphere's 2 pi: its half-angle's cosine is 1 - 1 / count.
  const float cosHalf = std::max(0.5f, 1 - 1 / static_cast<float>(count));
  tanHalf = std::sqrt(1 - cosHalf * cosHalf) / cosHalf;
}

Vec3 traceVxgiDiffuse(const VxgiClipmap& map, const VxgiReceiver& at, const VxgiCones& cones, float turnRad,
                      const VxgiTracing& tracing) {
  const int level = map.levelAt(at.p);
  if (level == map.levels()) return {};
  const Frame frame(at.ns);
  const Vec3 origin = at.p + at.ng * (tracing.startOffsetVoxels * map.voxelSizeM(level));
  const float c = std::cos(turnRad), s = std::sin(turnRad);
  Vec3 sum;
  for (size_t i = 0; i < cones.direction.size(); ++i) {
    const Vec3 local = cones.direction[i],
               d = frame.toWorld({local.x * c - local.y * s, local.x * s + local.y * c, local.z});
    sum += traceVxgiCone(map, origin, d, cones.tanHalf, tracing) * cones.weight[i];
  }
  return sum;
}

}  // namespace roomlight
