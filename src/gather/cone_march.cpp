#include "gather/cone_march.h"

#include <cmath>

#include "gather/near_march.h"
#include "radiance/half.h"

namespace roomlight {
namespace {

constexpr float kClearVoxels = 1.5f;    // height above its own surface from which a cone may use the pyramid
constexpr float kMostNearVoxels = 8;
constexpr float kOpaque = 0.004f;  // what is left of a cone when it is given up

// Distance along the ray to leave the brick of the level that holds p (lattice coordinates in voxels of the level).
float exitBrick(Vec3 p, Vec3 inverse, float voxelSizeM) {
  float t = kInfinity;
  for (int k = 0; k < 3; ++k) {
    const float cell = std::floor(p[k] * (1.0f / kBrickSize)) * kBrickSize;
    const float edge = inverse[k] > 0 ? cell + kBrickSize : cell;
    t = std::min(t, (edge - p[k]) * inverse[k]);
  }
  return std::max(t, 0.0f) * voxelSizeM;
}

// From the distance tNear on. Only surfaces that lie ahead of that point count: a wall beside the start would otherwise
// shadow a cone that moves away from it.
void marchFar(const RadianceField& field, Vec3 origin, Vec3 d, float rise, float tNear, const ConeShape& shape, float levelShift, ConeLight& out) {
  const float h = field.levels[0].voxelSizeM;
  const int coarsest = static_cast<int>(field.levels.size()) - 1;
  const Vec3 start = origin - field.origin, ahead = start + d * tNear;
  const Vec3 inverse{1 / (std::abs(d.x) > 1e-8f ? d.x : std::copysign(1e-8f, d.x)), 1 / (std::abs(d.y) > 1e-8f ? d.y : std::copysign(1e-8f, d.y)),
                     1 / (std::abs(d.z) > 1e-8f ? d.z : std::copysign(1e-8f, d.z))};
  // Faces that the ray sees: those whose direction is against it.
  const int fx = d.x > 0 ? 1 : 0, fy = d.y > 0 ? 3 : 2, fz = d.z > 0 ? 5 : 4;
  const __m128 wx = _mm_set1_ps(std::abs(d.x)), wy = _mm_set1_ps(std::abs(d.y)), wz = _mm_set1_ps(std::abs(d.z));
  __m128 sum = _mm_setzero_ps();

  float t = tNear;
  for (int guard = 0; guard < 2048; ++guard) {
    const float diameter = std::max(h, 2 * std::min(t * shape.tanHalf, t * rise));
    const int level = std::min(coarsest, static_cast<int>(std::log2(diameter / h) + levelShift));
    const RadianceLevel& l = field.levels[static_cast<size_t>(level)];
    const float size = l.voxelSizeM;
    const Vec3 q = (start + d * t) / size;
    const int x = static_cast<int>(std::floor(q.x)), y = static_cast<int>(std::floor(q.y)), z = static_cast<int>(std::floor(q.z));
    const int bx = x >> 3, by = y >> 3, bz = z >> 3;
    if (static_cast<unsigned>(bx) >= static_cast<unsigned>(l.brickDims.x) || static_cast<unsigned>(by) >= static_cast<unsigned>(l.brickDims.y) ||
        static_cast<unsigned>(bz) >= static_cast<unsigned>(l.brickDims.z)) {
      // Outside the grid: gone for good once past the far side along some axis.
      const Int3 n = l.brickDims;
      const bool gone = (bx < 0 && d.x <= 0) || (by < 0 && d.y <= 0) || (bz < 0 && d.z <= 0) || (bx >= n.x && d.x >= 0) ||
                        (by >= n.y && d.y >= 0) || (bz >= n.z && d.z >= 0);
      if (gone) break;
      t += size;
      continue;
    }
    const int32_t b = l.brickIndex[(static_cast<size_t>(bz) * static_cast<size_t>(l.brickDims.y) + static_cast<size_t>(by)) * static_cast<size_t>(l.brickDims.x) + static_cast<size_t>(bx)];
    if (b < 0) {
      t += exitBrick(q, inverse, size) + 0.01f * size;
      continue;
    }
    const float step = size * shape.stepFactor;
    const Brick& brick = l.bricks[static_cast<size_t>(b)];
    const auto word = static_cast<size_t>(z & 7);
    const int bit = (x & 7) + 8 * (y & 7);
    if ((brick.occupied[word] >> bit) & 1) {
      const DirectionalVoxel& v = l.voxels[brick.firstVoxel + brick.before[word] + static_cast<size_t>(std::popcount(brick.occupied[word] & ((uint64_t{1} << bit) - 1)))];
      const auto seen = [&](int face, int cell, int axis) {
        const float plane = (static_cast<float>(cell) + static_cast<float>(v.plane[static_cast<size_t>(face)]) * (1.0f / 255)) * size;
        return (plane - ahead[axis]) * inverse[axis] > 0;
      };
      __m128 c = _mm_setzero_ps();
      if (seen(fx, x, 0)) c = _mm_mul_ps(fromHalf4(v.face[static_cast<size_t>(fx)].data()), wx);
      if (seen(fy, y, 1)) c = _mm_add_ps(c, _mm_mul_ps(fromHalf4(v.face[static_cast<size_t>(fy)].data()), wy));
      if (seen(fz, z, 2)) c = _mm_add_ps(c, _mm_mul_ps(fromHalf4(v.face[static_cast<size_t>(fz)].data()), wz));
      const float s = _mm_cvtss_f32(_mm_shuffle_ps(c, c, 0xff));
      if (s > 1e-5f) {
        const float alpha = 1 - std::exp(-s * shape.stepFactor);  // opacity of a step of this length
        sum = _mm_add_ps(sum, _mm_mul_ps(c, _mm_set1_ps(out.left * alpha / s)));
        out.occlusion += out.left * alpha / (1 + shape.lambda * 0.5f * diameter);
        out.left *= 1 - alpha;
        if (out.left < kOpaque) {
          out.left = 0;
          break;
        }
      }
    }
    t += step;
  }
  alignas(16) float rgb[4];
  _mm_store_ps(rgb, sum);
  out.radiance += Vec3{rgb[0], rgb[1], rgb[2]} * field.unitCdM2;
}

// Where the way through base voxels ends: the cone has become wider than they are and stands clear of its own surface.
float nearEnd(float h, float rise, const ConeShape& shape, float levelShift) {
  const float wide = std::exp2(-levelShift) * h / std::max(shape.tanHalf, 1e-3f);
  const float clear = kClearVoxels * h / std::max(rise, 1e-3f);
  return std::min(std::max({wide, clear, 2 * h}), kMostNearVoxels * h);
}

}  // namespace

ConeLight marchCone(const Voxels& voxels, const RadianceField& field, const ConeStart& from, Vec3 d, const ConeShape& shape, float levelShift) {
  ConeLight out;
  const float h = field.levels[0].voxelSizeM;
  const float rise = std::max(0.0f, dot(d, from.normal));
  const float tNear = nearEnd(h, rise, shape, levelShift);
  marchNear(voxels, field, from.origin, d, tNear, shape.lambda, out);
  if (out.left > 0) marchFar(field, from.origin, d, rise, tNear, shape, levelShift, out);
  return out;
}

}  // namespace roomlight
