#include "voxel/brick_builder.h"

#include "scene/surface.h"
#include "voxel/clip.h"
#include "voxel/submask.h"

namespace roomlight {
namespace {

constexpr float kSameLayer = 1e-3f;   // voxels
constexpr float kLargeShare = 0.25f;  // of the largest piece so far: large enough to stand for its side

// Running sums of one side of the surfaces in a voxel, weighted by opaque area in voxels².
struct SlotSums {
  float area = 0;
  Vec3 normal, albedo, emission;
  // Centroid of one piece, so that it really lies on a surface: of the foremost among the large ones. Light reaches the front
  // of a panel on a wall, not the plaster behind it, though both may lie in one voxel.
  Vec3 position;
  float pieceArea = 0, height = 0;
  // References come in order of instances, so the largest is known when the run of one instance ends.
  uint32_t instance = 0, bestInstance = 0;
  float instanceArea = 0, bestArea = 0;

  void add(float w, Vec3 p, Vec3 n, Vec3 rho, Vec3 le, uint32_t from, int face) {
    if (from != instance) instance = from, instanceArea = 0;
    instanceArea += w;
    if (instanceArea > bestArea) bestArea = instanceArea, bestInstance = from;
    area += w;
    const float z = dot(p, faceDirection(face));
    if (z > height + kSameLayer ? w > kLargeShare * pieceArea : z < height - kSameLayer ? kLargeShare * w > pieceArea : w > pieceArea) {
      pieceArea = w, position = p, height = z;
    }
    normal += n * w, albedo += rho * w, emission += le * w;
  }
};

struct VoxelSums {
  uint64_t mask = 0;
  Vec3 projected;  // opaque area seen along each axis, voxels²
  std::array<SlotSums, 6> slots;
};

struct Shade {
  Vec3 albedo, emission;
  float coverage = 1;  // opaque fraction
};

Shade shadeAt(const Scene& scene, const Mesh& mesh, TrianglePoint p) {
  const Material& material = scene.materials[static_cast<size_t>(mesh.material)];
  const MaterialSample m = materialAt(scene, mesh, p);
  Shade s;
  s.coverage = std::clamp(1 - luminance(straightTransmittance(material, m, 1)), 0.0f, 1.0f);
  s.albedo = min(bihemisphericalAlbedo(m), Vec3(1));
  // Light that goes straight through is not absorbed: a pane's small opaque share reflects what the whole pane does.
  if (s.coverage > 0 && s.coverage < 1 && m.alpha >= 1) s.albedo = min(s.albedo / s.coverage, Vec3(1));
  s.emission = m.emission;
  if (s.coverage > 0) s.emission = s.emission / s.coverage;  // a lamp behind alpha keeps its flux
  return s;
}

bool isUniform(const Mesh& mesh, const Material& m) {
  return m.baseColorTexture.texture < 0 && m.metallicRoughnessTexture.texture < 0 && m.emissionTexture.texture < 0 &&
         m.transmissionTexture.texture < 0 && mesh.colors.empty() && mesh.colorAlphas.empty();
}

TrianglePoint barycentric(const LatticeTriangle& t, uint32_t triangle, Vec3 p) {
  const Vec3 e1 = t.b - t.a, e2 = t.c - t.a, d = p - t.a;
  const float d11 = dot(e1, e1), d12 = dot(e1, e2), d22 = dot(e2, e2), p1 = dot(d, e1), p2 = dot(d, e2);
  const float det = d11 * d22 - d12 * d12;
  if (!(det > 0)) return {triangle, 1 / 3.f, 1 / 3.f};
  return {triangle, std::clamp((d22 * p1 - d12 * p2) / det, 0.0f, 1.0f), std::clamp((d11 * p2 - d12 * p1) / det, 0.0f, 1.0f)};
}

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
  void clear() { index_.fill(-1), used_ = 0; }

 private:
  std::array<int16_t, kBrickVoxels> index_;
  std::vector<VoxelSums> sums_;
  size_t used_ = 0;
};

// Adds what one triangle leaves in one voxel.
void addPiece(const Polygon& piece, Vec3 corner, const LatticeTriangle& t, const Shade& shade, bool emitsBack, uint32_t instance,
              VoxelSums& sums) {
  const AreaCentroid g = areaOf(piece);
  if (!(g.area > 0)) return;
  const float w = g.area * shade.coverage;
  sums.mask |= subVoxelMask(piece, corner, g.vectorArea);
  sums.projected += abs(t.front) * w;
  const int face = dominantFace(t.front);
  sums.slots[static_cast<size_t>(face)].add(w, g.centroid, t.front, shade.albedo, shade.emission, instance, face);
  sums.slots[static_cast<size_t>(face ^ 1)].add(w, g.centroid, -t.front, shade.albedo, emitsBack ? shade.emission : Vec3(0), instance, face ^ 1);
}

void addTriangle(const Scene& scene, const Lattice& lattice, Int3 brick, Voxelisation::Reference ref, Accumulators& sums) {
  const Mesh& mesh = scene.meshes[static_cast<size_t>(scene.instances[ref.instance].mesh)];
  const Material& material = scene.materials[static_cast<size_t>(mesh.material)];
  const LatticeTriangle t = latticeTriangle(scene, lattice, ref.instance, ref.triangle);
  if (!(t.area > 0)) return;
  Polygon polygon;
  polygon.add(t.a), polygon.add(t.b), polygon.add(t.c);
  if (!keepCell(polygon, 0, kBrickSize, brick.x) || !keepCell(polygon, 1, kBrickSize, brick.y) || !keepCell(polygon, 2, kBrickSize, brick.z)) return;
  const bool uniform = isUniform(mesh, material);
  Shade shade;
  if (uniform) shade = shadeAt(scene, mesh, {ref.triangle, 1 / 3.f, 1 / 3.f});
  const auto local = [](int cell, int first) { return std::clamp(cell - first * kBrickSize, 0, kBrickSize - 1); };
  cutIntoCells(polygon, 0, 1, [&](int x, const Polygon& px) {
    cutIntoCells(px, 1, 1, [&](int y, const Polygon& py) {
      cutIntoCells(py, 2, 1, [&](int z, const Polygon& pz) {
        if (!uniform) shade = shadeAt(scene, mesh, barycentric(t, ref.triangle, areaOf(pz).centroid));
        const int lx = local(x, brick.x), ly = local(y, brick.y), lz = local(z, brick.z);
        const Vec3 corner{static_cast<float>(brick.x * kBrickSize + lx), static_cast<float>(brick.y * kBrickSize + ly),
                          static_cast<float>(brick.z * kBrickSize + lz)};
        if (shade.coverage > 0) {
          addPiece(pz, corner, t, shade, material.doubleSided, ref.instance, sums.at(lx + kBrickSize * (ly + kBrickSize * lz)));
        }
      });
    });
  });
}

FaceSlot finishSlot(const SlotSums& s, int face, const Lattice& lattice) {
  FaceSlot slot;
  const float inverse = 1 / s.area;
  slot.position = lattice.toWorld(s.position);
  const float l = length(s.normal);
  slot.normal = l > 1e-6f * s.area ? s.normal / l : faceDirection(face);
  slot.albedo = s.albedo * inverse;
  slot.emission = s.emission * inverse;
  slot.areaM2 = s.area * lattice.voxelSizeM * lattice.voxelSizeM;
  slot.instance = s.bestInstance;
  slot.face = static_cast<uint8_t>(face);
  return slot;
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

BrickRecords buildBrick(const Scene& scene, const Lattice& lattice, Int3 brick, std::span<const Voxelisation::Reference> references) {
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
      if (!(s.area > 1e-6f)) continue;
      voxel.faces = static_cast<uint8_t>(voxel.faces | (1u << face));
      records.slots.push_back(finishSlot(s, face, lattice));
    }
    if (!voxel.faces) continue;
    records.occupied[static_cast<size_t>(local) / 64] |= uint64_t{1} << (local % 64);
    records.voxels.push_back(voxel);
  }
  return records;
}

}  // namespace roomlight
