#include "radiance/pyramid.h"

#include <bit>
#include <cmath>

#include "base/simd.h"

namespace roomlight {
namespace {

constexpr float kOpaque = 0.004f;     // what is left of a cone when it is given up
constexpr float kOverlap =
    0.02f;     // voxel edges: planes are looked for a little outside their voxel, so that none falls between two
constexpr float kMaskReach =
    0.05f;  // voxel edges: planes are rounded, and may lie just outside the sub-cells of their surface
constexpr float kSheet =
    0.15f;       // voxel edges: planes that show opposite ways and lie no further apart are two sides of one sheet
constexpr float kOwnSheet = 0.35f;  // base voxel edges: how far a bent sheet's plane may lie in front of a point on it
constexpr float kBeyond = 0.02f;  // voxel edges
constexpr float kNudge = 1e-3f;  // voxel edges: carries a step into the next voxel
constexpr float kNarrowest =
    1.2e-4f;  // width of a cone at distance 1: no cone stays on a level for so long that the nudge is lost in rounding

// Whether the sub-cell at p, from the voxel's middle in voxel edges, holds a surface.
bool isSet(uint64_t mask, Vec3 p) {
  const auto cell = [](float v) { return std::clamp(static_cast<int>(4 * v + 2), 0, 3); };
  return (mask >> (cell(p.x) + 4 * cell(p.y) + 16 * cell(p.z))) & 1;
}

struct Crossing {
  float t;
  size_t face;
};

// Whether `face` (unit normal n) is one side of a sheet that shows its other side through the opposite face.
bool isSheet(const DirectionalPlanes& voxel, size_t face, Vec3 n) {
  const size_t other = face ^ 1;
  return std::abs(voxel.distance(face) + voxel.distance(other)) < kSheet && dot(n, voxel.normal(other)) < -0.7f;
}

// Planes of one voxel that the ray crosses from their fronts between its tMin and tMax, nearest first. Its origin
// counts from the voxel's middle; lengths in voxel edges. `ownNormal` is that of the surface the ray comes from, which
// may lie behind the plane of its own voxel where it is bent, by up to `ownReach`: the plane's other side is not met
// then.
int crossings(const DirectionalPlanes& voxel, const Ray& ray, Vec3 ownNormal, float ownReach, Crossing (&out)[6]) {
  // All faces at once, normals in 1/127.
  const Float8 x = fromBytes(voxel.normalX.data()), y = fromBytes(voxel.normalY.data()),
               z = fromBytes(voxel.normalZ.data());
  const auto along = [&](Vec3 v) { return fma(x, Float8(v.x), fma(y, Float8(v.y), z * Float8(v.z))); };
  const Float8 facing = along(ray.direction);
  const Float8 plane =
      fma(fromBytes(voxel.plane.data()), Float8(127 * kFarthestPlane * 2 / 255), Float8(-127 * kFarthestPlane));
  const Float8 ahead = along(ray.origin) - plane, t = (Float8(0.0f) - ahead) / facing;
  const Float8 within = (Float8(ray.tMin) <= t) & (t < Float8(ray.tMax));
  // Where no surface faces a way, the normal there is 0 and so is `facing`.
  unsigned faces = topBits(within & (facing < Float8(-127 * 1e-4f))) & 0x3f;
  if (faces == 0) return 0;
  float aheadOf[8], tOf[8];
  ahead.store(aheadOf), t.store(tOf);
  int found = 0;
  for (; faces; faces &= faces - 1) {
    const auto face = static_cast<size_t>(std::countr_zero(faces));
    const Vec3 n = voxel.normal(face);
    if (aheadOf[face] < 127 * ownReach && dot(n, ownNormal) < -0.3f && isSheet(voxel, face, n)) continue;
    const Vec3 p = ray.origin + ray.direction * tOf[face];
    if (!isSet(voxel.mask, p + n * kMaskReach) && !isSet(voxel.mask, p - n * kMaskReach)) continue;
    int k = found++;
    for (; k > 0 && out[k - 1].t > tOf[face]; --k) out[k] = out[k - 1];
    out[k] = {tOf[face], face};
  }
  return found;
}

// Distance along the ray, in voxel edges, from p in voxel v to where it leaves the cube of `edge` (a power of two)
// voxels that holds it. `ahead` is 1 on axes along which the ray goes up, else 0.
float exitCube(Vec3 p, Int3 v, Vec3 inverse, Vec3 ahead, int edge) {
  const float e = static_cast<float>(edge);
  const auto along = [&](int cell, float q, float inv, float up) {
    return (static_cast<float>(cell & -edge) + up * e - q) * inv;
  };
  return std::max(0.0f, std::min(along(v.x, p.x, inverse.x, ahead.x),
                                 std::min(along(v.y, p.y, inverse.y, ahead.y), along(v.z, p.z, inverse.z, ahead.z))));
}

// Whether none of the 4x4x4 voxels of the brick around v is occupied.
bool blockIsEmpty(const Brick& brick, Int3 v) {
  const uint64_t* words = &brick.occupied[static_cast<size_t>(v.z & 4)];
  const uint64_t any = words[0] | words[1] | words[2] | words[3];
  return ((any >> ((v.x & 4) + 8 * (v.y & 4))) & 0x0f0f0f0full) == 0;
}

bool goneForGood(Int3 brick, Int3 dims, Vec3 d) {
  return (brick.x < 0 && d.x <= 0) || (brick.y < 0 && d.y <= 0) || (brick.z < 0 && d.z <= 0) ||
         (brick.x >= dims.x && d.x >= 0) || (brick.y >= dims.y && d.y >= 0) || (brick.z >= dims.z && d.z >= 0);
}

// Whether p lies in front of a plane that hides the surfaces met: there the plane goes on where they do not.
bool isBeyond(const DirectionalPlanes& voxel, unsigned hiding, Vec3 p) {
  for (; hiding; hiding &= hiding - 1) {
    const auto face = static_cast<size_t>(std::countr_zero(hiding));
    if (dot(p, voxel.normal(face)) - voxel.distance(face) > kBeyond) return true;
  }
  return false;
}

// Share of a plane's light that is the cone's: all but the points' part of its glow (in 1/255 of the light).
float kept(const RadianceField& field, uint8_t glow, Vec3 shown, float distance, float cosLight, float pdf) {
  const float share = static_cast<float>(glow) * (1.0f / 255);
  return 1 - share * (1 - field.glow.coneShare(share * luminance(shown), distance, cosLight, pdf));
}

float inverseOf(float v) { return 1 / (std::abs(v) > 1e-8f ? v : std::copysign(1e-8f, v)); }

// A cone on its way, and what it has met so far.
struct March {
  const RadianceField& field;
  const Vec3 ownNormal;  // of the surface where it began
  const ConeShape& shape;
  const float h = field.levels[0].voxelSizeM;
  ConeLight out = {};
  Vec3 veil = {};  // normal of the last veil or pane met,
  float veilUntil = 0;  // and how many metres along the way it may still be the same one

  // Takes the light of the planes of one voxel, for the ray as crossings() has it.
  inline void meet(const RadianceLevel& l, size_t record, const Ray& ray) {
    const DirectionalPlanes& planes = l.planes[record];
    const DirectionalLight& light = l.light[record];
    __builtin_prefetch(&light);  // on its way while planes are tested
    Crossing met[6];
    const int count = crossings(planes, ray, ownNormal, kOwnSheet * h / l.voxelSizeM, met);
    for (int i = 0; i < count; ++i) {
      const size_t face = met[i].face;
      if (isBeyond(planes, light.behind[face], ray.origin + ray.direction * met[i].t)) continue;
      const int opacity = light.opacity[face];
      if (opacity < 255) {
        // A veil or pane that spans voxels is met once, though both of their planes may be crossed on the way.
        const Vec3 n = planes.normal(face);
        if (met[i].t * l.voxelSizeM < veilUntil && dot(n, veil) > 0.5f) continue;
        veil = n, veilUntil = met[i].t * l.voxelSizeM + h;
      }
      const float alpha = out.left * static_cast<float>(light.coverage[face] * opacity) * (1.0f / (255 * 255));
      const auto& radiance = light.radiance[face];
      const Vec3 shown = Vec3{fromHalf(radiance[0]), fromHalf(radiance[1]), fromHalf(radiance[2])} * field.unitCdM2;
      out.radiance += shown * (light.glow[face] == 0 || shape.pdf == 0
                                   ? alpha
                                   : alpha * kept(field, light.glow[face], shown, met[i].t * l.voxelSizeM,
                                                  -dot(planes.normal(face), ray.direction), shape.pdf));
      out.occlusion += alpha / (1 + shape.lambda * met[i].t * l.voxelSizeM);
      out.left -= alpha;
    }
    if (out.left < kOpaque) out.left = 0;
  }
};

}  // namespace

ConeLight marchCone(const RadianceField& field, const ConeStart& from, Vec3 d, const ConeShape& shape,
                    float levelShift) {
  March march{field, from.normal, shape};
  const int coarsest = static_cast<int>(field.levels.size()) - 1;
  const Vec3 inverse{inverseOf(d.x), inverseOf(d.y), inverseOf(d.z)},
      ahead{d.x > 0 ? 1.0f : 0.0f, d.y > 0 ? 1.0f : 0.0f, d.z > 0 ? 1.0f : 0.0f};
  // As wide as the cone, but never so wide that a voxel reaches back into the surface the cone left.
  const float widening =
      std::max(kNarrowest, 2 * std::min(shape.tanHalf, std::max(0.0f, dot(d, from.normal))) * std::exp2(levelShift));
  // Lengths from here on in edges of the level's voxels: on every level the cone is two voxels wide at the same number
  // of them.
  const float widest = 2 / widening;
  Vec3 origin = (from.origin - field.origin) / march.h;
  int level = 0;
  for (float t = 0; march.out.left > 0;) {
    for (; t >= widest && level < coarsest; ++level) t *= 0.5f, origin *= 0.5f;
    const RadianceLevel& l = field.levels[static_cast<size_t>(level)];
    const Vec3 p = origin + d * (t + kNudge);
    const Int3 v{static_cast<int>(std::floor(p.x)), static_cast<int>(std::floor(p.y)),
                 static_cast<int>(std::floor(p.z))};
    const Int3 at{v.x >> 3, v.y >> 3, v.z >> 3};
    const Brick* brick = l.brickAt(at);
    if (!brick || blockIsEmpty(*brick, v)) {
      if (!brick && goneForGood(at, l.brickDims, d)) break;
      t += exitCube(p, v, inverse, ahead, brick ? kBrickSize / 2 : kBrickSize) + kNudge;
      continue;
    }
    const float leave = t + exitCube(p, v, inverse, ahead, 1) + kNudge;
    if (const int64_t record = l.find(*brick, v); record >= 0) {
      const Vec3 middle{static_cast<float>(v.x) + 0.5f, static_cast<float>(v.y) + 0.5f, static_cast<float>(v.z) + 0.5f};
      march.meet(l, static_cast<size_t>(record), {origin - middle, d, std::max(0.0f, t - kOverlap), leave + kOverlap});
    }
    t = leave;
  }
  return march.out;
}

}  // namespace roomlight
