#include "radiance/slot_snapshot.h"

#include <algorithm>
#include <cmath>

#include "base/parallel.h"

namespace roomlight {
namespace {

constexpr float kFacing = 0.7f;     // cosine between the normals of a place and of a slot that stands for it
constexpr float kOffPlane = 0.6f;   // voxels
constexpr float kHidden =
    0.04f;    // of the brightest around: darker slots are taken to lie in a wall, where no eye comes
constexpr float kOneSurface = 0.9f;
constexpr float kOneSheet = 1.05f;  // of the area that a plane cuts from a voxel, at most
constexpr float kOnSheet = 0.15f;   // voxels off its plane
constexpr int kSmoothings = 6;
constexpr float kLeastWeight = 1e-3f;

// Three channels of nine bits and an exponent of five, as in OpenGL's RGB9_E5 but for its range: from 2^-20 lx up to
// 2^20.
constexpr int kLeastExponent = -20;
uint32_t packed(Vec3 v) {
  const float most = maxComponent(v);
  if (!(most > 0)) return 0;
  int e = 0;
  std::frexp(most, &e);  // most < 2^e
  e = std::clamp(e, kLeastExponent + 9, kLeastExponent + 9 + 31);
  const float scale = std::ldexp(1.0f, 9 - e);
  const auto channel = [&](float c) {
    return static_cast<uint32_t>(std::clamp(std::lround(std::max(0.0f, c) * scale), 0L, 511L));
  };
  return channel(v.x) | channel(v.y) << 9 | channel(v.z) << 18 | static_cast<uint32_t>(e - 9 - kLeastExponent) << 27;
}
Vec3 unpacked(uint32_t bits) {
  const float scale =
      std::bit_cast<float>(static_cast<uint32_t>(127 + kLeastExponent + static_cast<int>(bits >> 27)) << 23);
  return Vec3{static_cast<float>(bits & 511), static_cast<float>(bits >> 9 & 511),
              static_cast<float>(bits >> 18 & 511)} *
         scale;
}

bool isOneSheet(const SurfaceVoxel& voxel, const FaceSlot& slot, float h) {
  const int ofAxis = 3 << (slot.face & ~1);
  return (voxel.faces & ~ofAxis) == 0 && slot.areaM2 * std::abs(slot.normal[slot.face / 2]) < kOneSheet * h * h;
}

int8_t packedUnit(float v) { return static_cast<int8_t>(std::lround(127 * v)); }

}  // namespace

SlotSnapshot::SlotSnapshot(const Voxels& voxels, std::span<const Vec3> irradianceLux, std::span<const Vec3> sharpLux,
                           std::vector<uint32_t> emissive)
    : perMetre_(1 / voxels.voxelSizeM),
      emissive_(std::move(emissive)),
      grid_(voxels),
      cells_(voxels.voxels.size()),
      records_(voxels.slots.size()) {
  parallelFor(cells_.size(), 16384, [&](size_t v) {
    const SurfaceVoxel& voxel = voxels.voxels[v];
    cells_[v] = {voxel.firstSlot, voxel.faces};
    const auto slots = static_cast<uint32_t>(std::popcount(static_cast<unsigned>(voxel.faces)));
    for (uint32_t i = voxel.firstSlot; i < voxel.firstSlot + slots; ++i)
      records_[i].alone = isOneSheet(voxel, voxels.slots[i], voxels.voxelSizeM);
  });
  std::vector<Vec3> soft(records_.size());
  parallelFor(records_.size(), 16384, [&](size_t i) {
    const FaceSlot& slot = voxels.slots[i];
    const Vec3 sharp = sharpLux.empty() ? Vec3(0) : sharpLux[i];
    Record& r = records_[i];
    soft[i] = irradianceLux[i] - sharp, r.sharp = packed(sharp);
    r.normalX = packedUnit(slot.normal.x), r.normalY = packedUnit(slot.normal.y), r.normalZ = packedUnit(slot.normal.z);
    r.offset = dot(slot.position - voxels.origin, r.normal()) * perMetre_;
  });
  smooth(voxels, soft);
  parallelFor(records_.size(), 16384, [&](size_t i) { records_[i].soft = packed(soft[i]); });
}

// What links find has noise from slot to slot: each takes on some of those beside it on the same surface, from pass to
// pass farther ones too. Slots within walls are dark and left out, so that no light comes from one room to another
// along a wall they share.
void SlotSnapshot::smooth(const Voxels& voxels, std::vector<Vec3>& soft) const {
  std::vector<std::array<int32_t, 8>> beside(records_.size());
  parallelFor(voxels.bricks.size(), 64, [&](size_t b) {
    const Brick& brick = voxels.bricks[b];
    uint32_t voxel = brick.firstVoxel;
    for (int z = 0; z < kBrickSize; ++z) {
      for (uint64_t left = brick.occupied[static_cast<size_t>(z)]; left; left &= left - 1, ++voxel) {
        const int bit = std::countr_zero(left);
        const Int3 v{8 * brick.coord.x + (bit & 7), 8 * brick.coord.y + (bit >> 3), 8 * brick.coord.z + z};
        const Cell& cell = cells_[voxel];
        for (int face = 0; face < 6; ++face) {
          if (const Record* r = recordOf(cell, face))
            findBeside(v, *r, face, beside[static_cast<size_t>(r - records_.data())]);
        }
      }
    }
  });
  std::vector<Vec3> next(soft.size());
  for (int pass = 0; pass < kSmoothings; ++pass) {
    parallelFor(soft.size(), 8192, [&](size_t i) {
      const float least = kHidden * luminance(soft[i]);
      Vec3 sum = soft[i] * 4;
      float weight = 4;
      for (size_t k = 0; k < 8; ++k) {
        const int32_t n = beside[i][k];
        if (n < 0 || !(luminance(soft[static_cast<size_t>(n)]) > least) ||
            luminance(soft[static_cast<size_t>(n)]) * kHidden > luminance(soft[i]))
          continue;
        const float w = k < 4 ? 2.0f : 1.0f;  // edges, then corners
        sum += soft[static_cast<size_t>(n)] * w, weight += w;
      }
      next[i] = sum * (1 / weight);
    });
    soft.swap(next);
  }
}

void SlotSnapshot::findBeside(Int3 v, const Record& r, int face, std::array<int32_t, 8>& beside) const {
  constexpr std::array<std::array<int, 2>, 8> kSteps{
      {{1, 0}, {-1, 0}, {0, 1}, {0, -1}, {1, 1}, {1, -1}, {-1, 1}, {-1, -1}}};
  const int axis = face >> 1;
  for (size_t k = 0; k < 8; ++k) {
    const auto [a, b] = kSteps[k];
    const Int3 at{v.x + (axis == 0 ? 0 : a), v.y + (axis == 1 ? 0 : axis == 0 ? a : b), v.z + (axis == 2 ? 0 : b)};
    const Cell* cell = cellAt(at);
    const Record* o = cell ? recordOf(*cell, face) : nullptr;
    // Of one plane, seen from the middle of the other voxel.
    const Vec3 middle{static_cast<float>(at.x) + 0.5f, static_cast<float>(at.y) + 0.5f,
                      static_cast<float>(at.z) + 0.5f};
    const bool same =
        o && dot(o->normal(), r.normal()) > kOneSurface &&
        std::abs((dot(middle, r.normal()) - r.offset) - (dot(middle, o->normal()) - o->offset)) < kOffPlane;
    beside[k] = same ? static_cast<int32_t>(o - records_.data()) : -1;
  }
}

SlotIrradiance SlotSnapshot::at(Vec3 p, Vec3 n) const {
  const Vec3 q = (p - grid_.origin) * perMetre_, corner = q - Vec3(0.5f);
  const Int3 v{static_cast<int>(std::floor(corner.x)), static_cast<int>(std::floor(corner.y)),
               static_cast<int>(std::floor(corner.z))};
  const Vec3 t = corner - Vec3(static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z));
  const int face = dominantFace(n);
  struct Near {
    Vec3 soft, sharp;
    float weight;
    bool sure;
  };
  std::array<Near, 8> found;
  size_t count = 0;
  float brightest = 0;
  for (int k = 0; k < 8; ++k) {
    const int x = k & 1, y = k >> 1 & 1, z = k >> 2;
    const float weight = (x ? t.x : 1 - t.x) * (y ? t.y : 1 - t.y) * (z ? t.z : 1 - t.z);
    if (weight < kLeastWeight) continue;
    const Cell* cell = cellAt({v.x + x, v.y + y, v.z + z});
    const Record* r = cell ? recordOf(*cell, face) : nullptr;
    if (!r || dot(r->normal(), n) < kFacing) continue;
    const float off = std::abs(dot(q, r->normal()) - r->offset);
    if (off > kOffPlane) continue;
    found[count] = {unpacked(r->soft), unpacked(r->sharp), weight, r->alone && off < kOnSheet};
    brightest = std::max(brightest, luminance(found[count].soft + found[count].sharp));
    ++count;
  }
  SlotIrradiance out;
  float sum = 0, sure = 0;
  for (size_t i = 0; i < count; ++i) {
    const Near& f = found[i];
    if (luminance(f.soft + f.sharp) < kHidden * brightest) continue;
    out.soft += f.soft * f.weight, out.sharp += f.sharp * f.weight, sum += f.weight;
    if (f.sure) sure += f.weight;
  }
  if (sum > 0) {
    out.soft *= 1 / sum, out.sharp *= 1 / sum, out.found = true;
    out.sure = sure > 0.5f * sum;
    return out;
  }
  // Of bent or small things: the slot that faces n best, in the voxel of p or one beside it.
  for (const float nudge : {0.0f, 0.3f, -0.3f, 0.8f}) {
    const Vec3 at = q + n * nudge;
    const Cell* cell = cellAt(
        {static_cast<int>(std::floor(at.x)), static_cast<int>(std::floor(at.y)), static_cast<int>(std::floor(at.z))});
    if (!cell) continue;
    const Record* best = recordOf(*cell, face);
    float bestCosine = best ? 1 : 0;
    for (int f = 0; f < 6 && bestCosine < 1; ++f) {
      const Record* r = recordOf(*cell, f);
      const float c = r ? dot(r->normal(), n) : 0;
      if (c > bestCosine) bestCosine = c, best = r;
    }
    if (best) return {unpacked(best->soft), unpacked(best->sharp), true};
  }
  return out;
}

}  // namespace roomlight
