#include "voxel/bricks.h"

#include "voxel/clip.h"
#include "voxel/slot_sums.h"
#include "voxel/submask.h"

namespace roomlight {
namespace {

struct VoxelSums {
  uint64_t mask = 0;
  Vec3 projected;  // opaque area seen along each axis, voxels²
  std::array<SlotSums, 6> slots;
};

// Scratch of one brick: sums only for the voxels that are touched.
class Accumulators {
 public:
  Accumulators() { index_.fill(-1); }
  VoxelSums& at(int local) {
    int16_t& i = index_[static_cast<size_t>(local)];
    if (i < 0) {
      i = static_cast<int16_t>(used_++);
      if (sums_.size() < used_) sums_.emplace_back();
      sums_[used_ - 1] = VoxelSums{};
    }
    return sums_[static_cast<size_t>(i)];
  }
  const VoxelSums* find(int local) const {
    const int16_t i = index_[static_cast<size_t>(local)];
    return i < 0 ? nullptr : &sums_[static_cast<size_t>(i)];
  }
  std::vector<Layer>& layers() { return layers_; }
  void clear() { index_.fill(-1), used_ = 0, layers_.clear(); }

 private:
  std::array<int16_t, kBrickVoxels> index_;
  std::vector<VoxelSums> sums_;
  std::vector<Layer> layers_;
  size_t used_ = 0;
};

// Walls often stand on the middle of a floor's voxels: in their plane a place would be on neither side.
constexpr float kOffCentre = 0.04f;  // of the way to a corner

// Where a piece comes from.
struct Origin {
  uint32_t instance = 0;
  bool emitsBack = false;  // its material's emission leaves both sides
};

// Where it goes to.
struct Target {
  VoxelSums& sums;
  std::vector<Layer>& layers;
};

// Adds what one triangle leaves in one voxel, whose lowest corner is `corner`: to the side its front faces, and to the
// opposite one.
void addPiece(const Polygon& polygon, Vec3 corner, const LatticeTriangle& t, const Shade& shade, Origin from,
              Target to) {
  const AreaCentroid g = areaOf(polygon);
  if (!(g.area > 0)) return;
  to.sums.mask |= subVoxelMask(polygon, corner, g.vectorArea);
  const int face = dominantFace(t.front);
  SlotPiece piece;
  piece.area = g.area * shade.coverage, piece.wholeArea = g.area;
  const Vec3 projected = abs(t.front) * piece.area;
  to.sums.projected += projected;
  piece.projected = projected[face / 2];
  piece.place = g.centroid + (polygon.v[0] - g.centroid) * kOffCentre, piece.normal = t.front;
  piece.albedo = shade.albedo, piece.emission = shade.emission;
  piece.instance = from.instance;
  to.sums.slots[static_cast<size_t>(face)].add(piece, face, to.layers);
  piece.normal = -t.front;
  if (!from.emitsBack) piece.emission = Vec3(0);
  to.sums.slots[static_cast<size_t>(face ^ 1)].add(piece, face ^ 1, to.layers);
}

void addTriangle(const Scene& scene, const Lattice& lattice, Int3 brick, Voxelisation::Reference ref,
                 Accumulators& sums) {
  const Mesh& mesh = scene.meshes[static_cast<size_t>(scene.instances[ref.instance].mesh)];
  const bool emitsBack = scene.materials[static_cast<size_t>(mesh.material)].doubleSided;
  const LatticeTriangle t = latticeTriangle(scene, lattice, ref.instance, ref.triangle);
  if (!(t.area > 0)) return;
  Polygon polygon;
  polygon.add(t.a), polygon.add(t.b), polygon.add(t.c);
  if (!keepCell(polygon, 0, kBrickSize, brick.x) || !keepCell(polygon, 1, kBrickSize, brick.y) ||
      !keepCell(polygon, 2, kBrickSize, brick.z))
    return;
  const TriangleShader shader(scene, mesh, ref.triangle, t);
  const auto local = [](int cell, int first) { return std::clamp(cell - first * kBrickSize, 0, kBrickSize - 1); };
  cutIntoCells(polygon, 0, 1, [&](int x, const Polygon& px) {
    cutIntoCells(px, 1, 1, [&](int y, const Polygon& py) {
      cutIntoCells(py, 2, 1, [&](int z, const Polygon& pz) {
        const Shade shade = shader(pz);
        if (!(shade.coverage > 0)) return;
        const int lx = local(x, brick.x), ly = local(y, brick.y), lz = local(z, brick.z);
        const Vec3 corner{static_cast<float>(brick.x * kBrickSize + lx), static_cast<float>(brick.y * kBrickSize + ly),
                          static_cast<float>(brick.z * kBrickSize + lz)};
        addPiece(pz, corner, t, shade, {ref.instance, emitsBack},
                 {sums.at(lx + kBrickSize * (ly + kBrickSize * lz)), sums.layers()});
      });
    });
  });
}

}  // namespace

LatticeTriangle latticeTriangle(const Scene& scene, const Lattice& lattice, uint32_t instanceIndex, uint32_t triangle) {
  const Instance& instance = scene.instances[instanceIndex];
  const Mesh& mesh = scene.meshes[static_cast<size_t>(instance.mesh)];
  const uint32_t* i = &mesh.indices[size_t{3} * triangle];
  const Affine& m = instance.worldFromObject;
  LatticeTriangle t;
  t.a = lattice.toVoxels(m.point(mesh.positions[i[0]]));
  t.b = lattice.toVoxels(m.point(mesh.positions[i[1]]));
  t.c = lattice.toVoxels(m.point(mesh.positions[i[2]]));
  const Vec3 n = cross(t.b - t.a, t.c - t.a);
  const float l = length(n);
  t.area = 0.5f * l;
  // Front is counter-clockwise in object space; a mirroring transform turns the world winding around.
  if (l > 0) t.front = n * ((m.determinant() < 0 ? -1.0f : 1.0f) / l);
  return t;
}

BrickRecords buildBrick(const Scene& scene, const Lattice& lattice, Int3 brick,
                        std::span<const Voxelisation::Reference> references) {
  thread_local Accumulators sums;
  sums.clear();
  for (const Voxelisation::Reference& ref : references) addTriangle(scene, lattice, brick, ref, sums);

  BrickRecords records;
  for (int local = 0; local < kBrickVoxels; ++local) {
    const VoxelSums* v = sums.find(local);
    if (!v) continue;
    SurfaceVoxel voxel;
    voxel.mask = v->mask;
    voxel.opacity = min(columnCoverage(v->mask), min(v->projected, Vec3(1)));
    voxel.firstSlot = static_cast<uint32_t>(records.slots.size());
    for (int face = 0; face < 6; ++face) {
      const SlotSums& s = v->slots[static_cast<size_t>(face)];
      if (s.empty()) continue;
      voxel.faces = static_cast<uint8_t>(voxel.faces | (1u << face));
      records.slots.push_back(s.finish(face, lattice, sums.layers()));
    }
    if (!voxel.faces) continue;
    records.occupied[static_cast<size_t>(local) / 64] |= uint64_t{1} << (local % 64);
    records.voxels.push_back(voxel);
  }
  return records;
}

}  // namespace roomlight
