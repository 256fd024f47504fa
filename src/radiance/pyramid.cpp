#include "radiance/pyramid.h"

#include "base/parallel.h"
#include "base/simd.h"
#include "voxel/submask.h"

namespace roomlight {
namespace {

constexpr float kWholeFrom = 0.6f;
constexpr float kBehind = 0.05f;  // voxel edges

// One face while the pyramid is built. Lengths in edges of its voxel, from the voxel's middle.
struct Face {
  float cover = 0;    // projected coverage along the face's axis, 0..1
  float opacity = 1;  // of what covers
  Vec3 radiance, normal, point;
};
using Faces = std::array<Face, 6>;

int8_t toByte(float v) { return static_cast<int8_t>(std::lround(127 * std::clamp(v, -1.0f, 1.0f))); }

// Where the faces of a voxel are packed.
struct Packed {
  DirectionalPlanes& planes;
  DirectionalLight& light;
};

void pack(const Face& f, size_t face, Vec3 columns, Vec3 glow, float unit, const Packed& out) {
  if (!(f.cover > 0)) return;
  DirectionalPlanes& planes = out.planes;
  DirectionalLight& light = out.light;
  const float distance = dot(f.point, f.normal);
  const Vec3 shown = f.radiance + glow, c = shown / unit;
  light.radiance[face] = {toHalf(c.x), toHalf(c.y), toHalf(c.z)};
  planes.normalX[face] = toByte(f.normal.x), planes.normalY[face] = toByte(f.normal.y),
  planes.normalZ[face] = toByte(f.normal.z);
  planes.plane[face] =
      static_cast<uint8_t>(std::lround(255 * std::clamp(0.5f + 0.5f * distance / kFarthestPlane, 0.0f, 1.0f)));
  // Of the columns along the axis that hold surfaces at all. Sub-cells on a border are covered in part: more than half
  // of it is taken for a whole surface, so that walls do not leak along their edges.
  const float share = f.cover / std::max(1.0f / 16, columns[static_cast<int>(face / 2)]);
  light.coverage[face] = static_cast<uint8_t>(std::lround(std::clamp(255 * share / kWholeFrom, 1.0f, 255.0f)));
  light.opacity[face] = static_cast<uint8_t>(std::lround(std::clamp(255 * f.opacity, 1.0f, 255.0f)));
  light.glow[face] = static_cast<uint8_t>(std::lround(255 * luminance(glow) / std::max(luminance(shown), 1e-30f)));
}

// The faces whose planes have the middle of `face` behind them.
uint8_t planesBefore(const Faces& faces, size_t face) {
  unsigned bits = 0;
  for (size_t other = 0; other < 6; ++other) {
    if (faces[other].cover > 0 && dot(faces[face].point - faces[other].point, faces[other].normal) < -kBehind)
      bits |= 1u << other;
  }
  return static_cast<uint8_t>(bits);
}

void pack(const Faces& faces, uint64_t mask, const PerFace<Vec3>& glow, float unit, RadianceLevel& level,
          size_t record) {
  level.planes[record].mask = mask;
  const Vec3 columns = columnCoverage(mask);
  for (size_t face = 0; face < 6; ++face) level.light[record].behind[face] = planesBefore(faces, face);
  for (size_t face = 0; face < 6; ++face)
    pack(faces[face], face, columns, glow[face], unit, {level.planes[record], level.light[record]});
}

// The slots of a base voxel.
Faces baseFaces(const Voxels& voxels, const SurfaceVoxel& voxel, Vec3 middle, std::span<const Vec3> slotRadiance) {
  Faces faces;
  const float h = voxels.voxelSizeM;
  const size_t end = voxel.firstSlot + static_cast<size_t>(std::popcount(static_cast<unsigned>(voxel.faces)));
  for (size_t i = voxel.firstSlot; i < end; ++i) {
    const FaceSlot& slot = voxels.slots[i];
    const float projected = slot.areaM2 / std::max(1e-3f, slot.opacity) * std::abs(slot.normal[slot.face / 2]);
    faces[slot.face] = {std::min(1.0f, projected / (h * h)), slot.opacity, slotRadiance[i], slot.normal,
                        (slot.position - middle) / h};
  }
  return faces;
}

PerFace<Vec3> baseGlow(const Voxels& voxels, const SurfaceVoxel& voxel, std::span<const Vec3> slotGlow) {
  PerFace<Vec3> glow;
  const size_t count = static_cast<size_t>(std::popcount(static_cast<unsigned>(voxel.faces)));
  if (slotGlow.empty()) return glow;
  for (size_t i = voxel.firstSlot; i < voxel.firstSlot + count; ++i) glow[voxels.slots[i].face] = slotGlow[i];
  return glow;
}

// A mask at half its resolution: the 2x2x2 sub-cells at the lower corner of a mask.
uint64_t halved(uint64_t mask) {
  uint64_t out = 0;
  for (; mask; mask &= mask - 1) {
    const int bit = std::countr_zero(mask);
    out |= uint64_t{1} << ((bit & 3) / 2 + 4 * ((bit >> 2 & 3) / 2) + 16 * ((bit >> 4) / 2));
  }
  return out;
}

// Eight children into one. Along each axis the nearer child comes first and the farther one fills what is left, for a
// wall that crosses both covers different parts of the column; the four columns are averaged.
Faces combine(const std::array<const Faces*, 8>& child) {
  Faces out;
  for (int face = 0; face < 6; ++face) {
    const int axis = face / 2, side = face & 1;  // the + face is seen by rays that come from the high side
    const int u = 1 << ((axis + 1) % 3), v = 1 << ((axis + 2) % 3), along = 1 << axis;
    Face sum;
    float opaque = 0;
    for (int column = 0; column < 4; ++column) {
      const int base = (column & 1 ? u : 0) + (column & 2 ? v : 0);
      float left = 1;
      for (const int high : {1 - side, side}) {
        const int k = base + high * along;
        if (!child[static_cast<size_t>(k)]) continue;
        const Face& f = (*child[static_cast<size_t>(k)])[static_cast<size_t>(face)];
        const float w = std::min(left, f.cover);
        const Vec3 middle{k & 1 ? 0.25f : -0.25f, k & 2 ? 0.25f : -0.25f, k & 4 ? 0.25f : -0.25f};
        sum.radiance += f.radiance * (w * f.opacity);
        opaque += w * f.opacity;
        sum.normal += f.normal * w;
        sum.point += (middle + 0.5f * f.point) * w;
        left -= w;
      }
      sum.cover += 1 - left;
    }
    const float l = length(sum.normal);
    if (!(opaque > 0) || !(l > 0)) continue;
    out[static_cast<size_t>(face)] = {sum.cover / 4, opaque / sum.cover, sum.radiance / opaque, sum.normal / l,
                                      sum.point / sum.cover};
  }
  return out;
}

struct Working {
  RadianceLevel level;
  std::vector<Faces> faces;
};

void countRecords(RadianceLevel& level) {
  size_t voxels = 0;
  for (Brick& brick : level.bricks) {
    brick.firstVoxel = static_cast<uint32_t>(voxels);
    uint16_t before = 0;
    for (size_t w = 0; w < 8; ++w) {
      brick.before[w] = before;
      before = static_cast<uint16_t>(before + std::popcount(brick.occupied[w]));
    }
    voxels += before;
  }
  level.planes.resize(voxels), level.light.resize(voxels);
}

// Occupancy of the next coarser level.
RadianceLevel coarser(const RadianceLevel& fine) {
  RadianceLevel level;
  level.voxelSizeM = 2 * fine.voxelSizeM;
  level.brickDims = {(fine.brickDims.x + 1) / 2, (fine.brickDims.y + 1) / 2, (fine.brickDims.z + 1) / 2};
  level.brickIndex.assign(static_cast<size_t>(level.brickDims.x) * level.brickDims.y * level.brickDims.z, -1);
  for (const Brick& brick : fine.bricks) {
    const Int3 c{brick.coord.x / 2, brick.coord.y / 2, brick.coord.z / 2};
    int32_t& index = level.brickIndex[(static_cast<size_t>(c.z) * level.brickDims.y + c.y) * level.brickDims.x + c.x];
    if (index < 0) {
      index = static_cast<int32_t>(level.bricks.size());
      level.bricks.push_back({});
      level.bricks.back().coord = c;
    }
    Brick& out = level.bricks[static_cast<size_t>(index)];
    const int ox = 4 * (brick.coord.x & 1), oy = 4 * (brick.coord.y & 1), oz = 4 * (brick.coord.z & 1);
    for (int z = 0; z < 8; ++z) {
      for (uint64_t bits = brick.occupied[static_cast<size_t>(z)]; bits; bits &= bits - 1) {
        const int bit = std::countr_zero(bits);
        out.occupied[static_cast<size_t>(oz + z / 2)] |= uint64_t{1}
                                                         << ((ox + (bit & 7) / 2) + 8 * (oy + (bit >> 3) / 2));
      }
    }
  }
  countRecords(level);
  return level;
}

template <class Visit>
void forEachVoxel(const RadianceLevel& level, Visit&& visit) {
  parallelFor(level.bricks.size(), 8, [&](size_t b) {
    const Brick& brick = level.bricks[b];
    size_t record = brick.firstVoxel;
    for (int z = 0; z < 8; ++z) {
      for (uint64_t bits = brick.occupied[static_cast<size_t>(z)]; bits; bits &= bits - 1) {
        const int bit = std::countr_zero(bits);
        visit(record++, Int3{brick.coord.x * 8 + (bit & 7), brick.coord.y * 8 + (bit >> 3), brick.coord.z * 8 + z});
      }
    }
  });
}

}  // namespace

void buildPyramid(const Voxels& voxels, std::span<const Vec3> slotRadiance, std::span<const Vec3> slotGlow,
                  RadianceField& field) {
  float brightest = 0;
  for (size_t i = 0; i < slotRadiance.size(); ++i)
    brightest = std::max(brightest, maxComponent(slotGlow.empty() ? slotRadiance[i] : slotRadiance[i] + slotGlow[i]));
  field.unitCdM2 = brightest > 0 ? brightest / 32768 : 1;  // below the largest half
  field.origin = voxels.origin;
  field.levels.clear();

  Working now;
  now.level.voxelSizeM = voxels.voxelSizeM;
  now.level.brickDims = voxels.brickDims;
  now.level.brickIndex = voxels.brickIndex;
  now.level.bricks = voxels.bricks;
  now.level.planes.resize(voxels.voxels.size()), now.level.light.resize(voxels.voxels.size());
  now.faces.resize(voxels.voxels.size());
  forEachVoxel(now.level, [&](size_t record, Int3 v) {
    const Vec3 middle = voxels.origin + Vec3{static_cast<float>(v.x) + 0.5f, static_cast<float>(v.y) + 0.5f,
                                             static_cast<float>(v.z) + 0.5f} *
                                            voxels.voxelSizeM;
    now.faces[record] = baseFaces(voxels, voxels.voxels[record], middle, slotRadiance);
    pack(now.faces[record], voxels.voxels[record].mask, baseGlow(voxels, voxels.voxels[record], slotGlow),
         field.unitCdM2, now.level, record);
  });
  while (true) {
    const Int3 dims = now.level.brickDims;
    if (dims.x <= 1 && dims.y <= 1 && dims.z <= 1) break;
    Working next;
    next.level = coarser(now.level);
    next.faces.resize(next.level.planes.size());
    forEachVoxel(next.level, [&](size_t record, Int3 v) {
      std::array<const Faces*, 8> child{};
      uint64_t mask = 0;
      for (int k = 0; k < 8; ++k) {
        const int64_t c = now.level.find({2 * v.x + (k & 1), 2 * v.y + ((k >> 1) & 1), 2 * v.z + (k >> 2)});
        child[static_cast<size_t>(k)] = c < 0 ? nullptr : &now.faces[static_cast<size_t>(c)];
        if (c >= 0)
          mask |= halved(now.level.planes[static_cast<size_t>(c)].mask)
                  << (2 * (k & 1) + 8 * ((k >> 1) & 1) + 32 * (k >> 2));
      }
      next.faces[record] = combine(child);
      pack(next.faces[record], mask, {}, field.unitCdM2, next.level, record);
    });
    field.levels.push_back(std::move(now.level));
    now = std::move(next);
  }
  field.levels.push_back(std::move(now.level));
}

}  // namespace roomlight
