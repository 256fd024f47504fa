#include "gather/cone_march.h"

#include <cmath>

#include "radiance/half.h"

namespace roomlight {
namespace {

constexpr float kOpaque = 0.004f;     // what is left of a cone when it is given up
constexpr float kOverlap = 0.02f;     // voxel edges: planes are looked for a little outside their voxel, so that none falls between two
constexpr float kMaskReach = 0.05f;  // voxel edges: planes are rounded, and may lie just outside the sub-cells of their surface
constexpr float kNudge = 1e-3f;       // voxel edges: carries a step into the next voxel

// Whether the sub-cell at p, from the voxel's middle in voxel edges, holds a surface.
bool isSet(uint64_t mask, Vec3 p) {
  const auto cell = [](float v) { return std::clamp(static_cast<int>(4 * v + 2), 0, 3); };
  return (mask >> (cell(p.x) + 4 * cell(p.y) + 16 * cell(p.z))) & 1;
}

struct Crossing {
  float t;
  const DirectionalFace* face;
};

// Planes of one voxel that the ray crosses from their fronts between t0 and t1, nearest first. `q` is the ray's origin from the
// voxel's middle; lengths in voxel edges.
int crossings(const DirectionalVoxel& voxel, Vec3 q, Vec3 d, float t0, float t1, Crossing (&out)[6]) {
  int found = 0;
  for (const DirectionalFace& f : voxel.face) {
    if (f.coverage == 0) continue;
    const Vec3 n = Vec3{static_cast<float>(f.normal[0]), static_cast<float>(f.normal[1]), static_cast<float>(f.normal[2])} * (1.0f / 127);
    const float facing = dot(n, d);
    if (facing >= -1e-4f) continue;
    const float t = (planeDistance(f) - dot(n, q)) / facing;
    if (t < t0 || t >= t1) continue;
    const Vec3 p = q + d * t;
    if (!isSet(voxel.mask, p + n * kMaskReach) && !isSet(voxel.mask, p - n * kMaskReach)) continue;
    int k = found++;
    for (; k > 0 && out[k - 1].t > t; --k) out[k] = out[k - 1];
    out[k] = {t, &f};
  }
  return found;
}

// Distance along the ray from p to where it leaves the cell of edge `size` that holds p.
float exitCell(Vec3 p, Vec3 d, Vec3 inverse, float size) {
  float t = kInfinity;
  for (int k = 0; k < 3; ++k) {
    const float low = std::floor(p[k] / size) * size;
    t = std::min(t, ((d[k] > 0 ? low + size : low) - p[k]) * inverse[k]);
  }
  return std::max(t, 0.0f);
}

bool goneForGood(Int3 brick, Int3 dims, Vec3 d) {
  return (brick.x < 0 && d.x <= 0) || (brick.y < 0 && d.y <= 0) || (brick.z < 0 && d.z <= 0) || (brick.x >= dims.x && d.x >= 0) ||
         (brick.y >= dims.y && d.y >= 0) || (brick.z >= dims.z && d.z >= 0);
}

float inverseOf(float v) { return 1 / (std::abs(v) > 1e-8f ? v : std::copysign(1e-8f, v)); }

}  // namespace

ConeLight marchCone(const RadianceField& field, const ConeStart& from, Vec3 d, const ConeShape& shape, float levelShift) {
  ConeLight out;
  const float h = field.levels[0].voxelSizeM;
  const int coarsest = static_cast<int>(field.levels.size()) - 1;
  const Vec3 origin = from.origin - field.origin, inverse{inverseOf(d.x), inverseOf(d.y), inverseOf(d.z)};
  // As wide as the cone, but never so wide that a voxel reaches back into the surface the cone left.
  const float widening = 2 * std::min(shape.tanHalf, std::max(0.0f, dot(d, from.normal))) / h;
  const float shift = std::exp2(levelShift);
  for (float t = 0; out.left > 0;) {
    const float width = widening * t * shift;
    const int level = width < 2 ? 0 : std::min(coarsest, static_cast<int>(std::log2(width)));
    const RadianceLevel& l = field.levels[static_cast<size_t>(level)];
    const float size = l.voxelSizeM;
    const Vec3 p = origin + d * (t + kNudge * size), q = p / size;
    const Int3 v{static_cast<int>(std::floor(q.x)), static_cast<int>(std::floor(q.y)), static_cast<int>(std::floor(q.z))};
    const Int3 brick{v.x >> 3, v.y >> 3, v.z >> 3};
    if (goneForGood(brick, l.brickDims, d)) return out;
    if (!l.hasBrick(brick)) {
      t += exitCell(p, d, inverse, size * kBrickSize) + kNudge * size;
      continue;
    }
    const float leave = t + exitCell(p, d, inverse, size) + kNudge * size;
    if (const DirectionalVoxel* voxel = l.find(v.x, v.y, v.z)) {
      const Vec3 middle{static_cast<float>(v.x) + 0.5f, static_cast<float>(v.y) + 0.5f, static_cast<float>(v.z) + 0.5f};
      Crossing met[6];
      const float first = std::max(0.0f, t / size - kOverlap);
      const int count = crossings(*voxel, origin / size - middle, d, first, leave / size + kOverlap, met);
      for (int i = 0; i < count; ++i) {
        const DirectionalFace& f = *met[i].face;
        const float alpha = out.left * static_cast<float>(f.coverage) * (1.0f / 255);
        out.radiance += Vec3{fromHalf(f.radiance[0]), fromHalf(f.radiance[1]), fromHalf(f.radiance[2])} * (alpha * field.unitCdM2);
        out.occlusion += alpha / (1 + shape.lambda * met[i].t * size);
        out.left -= alpha;
      }
      if (out.left < kOpaque) out.left = 0;
    }
    t = leave;
  }
  return out;
}

}  // namespace roomlight
