// Bricks, from the triangles that reach into each to its voxel records and on to the flat arrays of a Voxelisation.
#pragma once

#include <span>
#include <vector>

#include "scene/scene.h"
#include "scene/surface.h"
#include "voxel/clip.h"
#include "voxel/lattice.h"
#include "voxel/voxelise.h"

namespace roomlight {

// Triangle in voxel coordinates; `front` is its unit
// front normal in world space.
struct LatticeTriangle {
  Vec3 a, b, c, front;
  float area = 0;  // in voxels²
};
LatticeTriangle latticeTriangle(const Scene& scene, const Lattice& lattice, uint32_t instance, uint32_t triangle);

struct BrickRecords {
  std::array<uint64_t, 8> occupied{};
  std::vector<SurfaceVoxel> voxels;  // firstSlot relative to this brick
  std::vector<FaceSlot> slots;
};

// Turns the triangles that touch one brick into its voxel records. `brick` in bricks from the world's origin, like
// `references` of the triangles that reach into it.
BrickRecords buildBrick(const Scene& scene, const Lattice& lattice, Int3 brick,
                        std::span<const Voxelisation::Reference> references);

// What a piece of surface reflects, emits and blocks on average.
struct Shade {
  Vec3 albedo, emission;  // mean over the opaque part; emission in cd/m², so that emission * coverage is what leaves
  float coverage = 1;  // opaque fraction
};

// Shades the pieces of one triangle. A piece is sampled at points spread evenly over it, as many as its texels ask for.
class TriangleShader {
 public:
  TriangleShader(const Scene& scene, const Mesh& mesh, uint32_t triangle, const LatticeTriangle& lattice);
  Shade operator()(const Polygon& piece) const;

 private:
  Shade at(Vec3 p) const;

  const Scene& scene_;
  const Mesh& mesh_;
  const LatticeTriangle& lattice_;
  uint32_t triangle_;
  float texelsPerArea_ = 0;  // of the finest texture, per voxel²
  bool uniform_ = false;
  Shade shade_;  // where uniform
};

// Which triangles reach into which brick.
struct BrickReference {
  uint32_t place;  // of the brick in the dense index
  Voxelisation::Reference triangle;
};

// All references of the listed instances (in ascending order), sorted by brick, within a brick by instance and
// triangle. Cost: triangles plus bricks they touch plus places in the dense index.
std::vector<BrickReference> referencesOf(const Scene& scene, const Lattice& lattice,
                                         std::span<const uint32_t> instances);

// A brick's records wherever they lie: freshly built, or
// in an older Voxelisation.
struct BrickView {
  uint32_t place = 0;  // in the dense index of the lattice it goes to
  std::array<uint64_t, 8> occupied{};
  std::span<const SurfaceVoxel> voxels;
  std::span<const FaceSlot> slots;
  uint32_t slotBase = 0;  // what the voxels' firstSlot counts from
  std::span<const Voxelisation::Reference> references;
};

BrickView viewOf(const BrickRecords& records, uint32_t place, std::span<const Voxelisation::Reference> references);
BrickView viewOf(const Voxelisation& v, size_t brick, uint32_t place);

// Puts bricks together into the flat arrays of a Voxelisation, in ascending order of place. Fills all but
// `instanceBounds`.
Voxelisation assemble(const Lattice& lattice, std::span<const BrickView> bricks);

}  // namespace roomlight
