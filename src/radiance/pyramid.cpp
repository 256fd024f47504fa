#include "radiance/pyramid.h"

#include "base/parallel.h"
#include "radiance/half.h"

namespace roomlight {
namespace {

constexpr float kLargestOpacity = 0.998f;  // extinction stays finite

// One directional voxel while the pyramid is built: opacity per axis, radiance per face (not weighted).
struct Faces {
  Vec3 opacity;
  std::array<Vec3, 6> radiance;
  std::array<float, 6> plane;  // 0..1 along the axis of the face
};

float extinction(float opacity) { return -std::log(1 - std::min(opacity, kLargestOpacity)); }

DirectionalVoxel pack(const Faces& f, float unit) {
  DirectionalVoxel v;
  for (size_t face = 0; face < 6; ++face) {
    const float s = extinction(f.opacity[static_cast<int>(face / 2)]);
    const Vec3 c = f.radiance[face] * (s / unit);
    v.face[face] = {toHalf(c.x), toHalf(c.y), toHalf(c.z), toHalf(s)};
    v.plane[face] = static_cast<uint8_t>(std::lround(255 * std::clamp(f.plane[face], 0.0f, 1.0f)));
  }
  return v;
}

// What a base voxel shows to each of the six directions: its slots, by the area they turn that way.
Faces baseFaces(const Voxels& voxels, const SurfaceVoxel& voxel, std::span<const Vec3> slotRadiance) {
  Faces f;
  f.plane.fill(0.5f);
  f.opacity = voxel.opacity;
  const size_t count = static_cast<size_t>(std::popcount(static_cast<unsigned>(voxel.faces)));
  for (int face = 0; face < 6; ++face) {
    const Vec3 d = faceDirection(face);
    float weight = 0, plane = 0;
    Vec3 sum;
    for (size_t i = voxel.firstSlot; i < voxel.firstSlot + count; ++i) {
      const float w = voxels.slots[i].areaM2 * std::max(0.0f, dot(voxels.slots[i].normal, d));
      const float along = (voxels.slots[i].position[face / 2] - voxels.origin[face / 2]) / voxels.voxelSizeM;
      sum += slotRadiance[i] * w;
      plane += (along - std::floor(along)) * w;
      weight += w;
    }
    if (weight > 0) {
      f.radiance[static_cast<size_t>(face)] = sum / weight;
      f.plane[static_cast<size_t>(face)] = plane / weight;
    }
  }
  return f;
}

// Eight children into one: along each axis the nearer one composited over the farther, then the four columns averaged.
Faces combine(const std::array<const Faces*, 8>& child) {
  Faces out;
  out.plane.fill(0.5f);
  for (int axis = 0; axis < 3; ++axis) {
    const int u = 1 << ((axis + 1) % 3), v = 1 << ((axis + 2) % 3), along = 1 << axis;
    for (const int side : {0, 1}) {  // the + face is seen by rays that come from the high side, the - face from the low one
      const auto face = static_cast<size_t>(2 * axis + side);
      float opacity = 0, plane = 0;
      Vec3 radiance;
      for (int column = 0; column < 4; ++column) {
        const int base = (column & 1 ? u : 0) + (column & 2 ? v : 0);
        float left = 1;
        for (const int high : {1 - side, side}) {
          const Faces* c = child[static_cast<size_t>(base + high * along)];
          if (!c) continue;
          const float w = left * c->opacity[axis];
          radiance += c->radiance[face] * w;
          plane += 0.5f * (c->plane[face] + static_cast<float>(high)) * w;
          left -= w;
        }
        opacity += 1 - left;
      }
      if (opacity > 0) {
        out.radiance[face] = radiance / opacity;
        out.plane[face] = plane / opacity;
      }
      out.opacity[axis] = opacity / 4;
    }
  }
  return out;
}

struct Working {
  RadianceLevel level;
  std::vector<Faces> faces;
};

int64_t recordAt(const RadianceLevel& level, int x, int y, int z) {
  const DirectionalVoxel* v = level.find(x, y, z);
  return v ? v - level.voxels.data() : -1;
}

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
  level.voxels.resize(voxels);
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
        out.occupied[static_cast<size_t>(oz + z / 2)] |= uint64_t{1} << ((ox + (bit & 7) / 2) + 8 * (oy + (bit >> 3) / 2));
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

void buildPyramid(const Voxels& voxels, std::span<const Vec3> slotRadiance, RadianceField& field) {
  float brightest = 0;
  for (const Vec3 r : slotRadiance) brightest = std::max(brightest, maxComponent(r));
  field.unitCdM2 = brightest > 0 ? brightest / 4096 : 1;  // s up to 6.2 keeps s L below the largest half
  field.origin = voxels.origin;
  field.levels.clear();

  Working now;
  now.level.voxelSizeM = voxels.voxelSizeM;
  now.level.brickDims = voxels.brickDims;
  now.level.brickIndex = voxels.brickIndex;
  now.level.bricks = voxels.bricks;
  now.level.voxels.resize(voxels.voxels.size());
  now.faces.resize(voxels.voxels.size());
  parallelFor(now.faces.size(), 2048, [&](size_t i) {
    now.faces[i] = baseFaces(voxels, voxels.voxels[i], slotRadiance);
    now.level.voxels[i] = pack(now.faces[i], field.unitCdM2);
  });
  while (true) {
    const Int3 dims = now.level.brickDims;
    if (dims.x <= 1 && dims.y <= 1 && dims.z <= 1) break;
    Working next;
    next.level = coarser(now.level);
    next.faces.resize(next.level.voxels.size());
    forEachVoxel(next.level, [&](size_t record, Int3 v) {
      std::array<const Faces*, 8> child{};
      for (int k = 0; k < 8; ++k) {
        const int64_t c = recordAt(now.level, 2 * v.x + (k & 1), 2 * v.y + ((k >> 1) & 1), 2 * v.z + (k >> 2));
        child[static_cast<size_t>(k)] = c < 0 ? nullptr : &now.faces[static_cast<size_t>(c)];
      }
      next.faces[record] = combine(child);
      next.level.voxels[record] = pack(next.faces[record], field.unitCdM2);
    });
    field.levels.push_back(std::move(now.level));
    now = std::move(next);
  }
  field.levels.push_back(std::move(now.level));
}

}  // namespace roomlight
