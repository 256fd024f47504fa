#include "voxel/bricks.h"

#include <numeric>

#include "base/parallel.h"
#include "voxel/clip.h"

namespace roomlight {
namespace {

constexpr size_t kTriangleChunk = 4096;

// Every brick in which a piece of the triangle lies, by the same cuts that buildBrick() makes.
void bricksOfTriangle(const Scene& scene, const Lattice& lattice, Voxelisation::Reference ref,
                      std::vector<BrickReference>& out) {
  const LatticeTriangle t = latticeTriangle(scene, lattice, ref.instance, ref.triangle);
  if (!(t.area > 0)) return;
  Polygon polygon;
  polygon.add(t.a), polygon.add(t.b), polygon.add(t.c);
  cutIntoCells(polygon, 0, kBrickSize, [&](int x, const Polygon& px) {
    cutIntoCells(px, 1, kBrickSize, [&](int y, const Polygon& py) {
      cutIntoCells(py, 2, kBrickSize, [&](int z, const Polygon&) { out.push_back({lattice.place({x, y, z}), ref}); });
    });
  });
}

}  // namespace

std::vector<BrickReference> referencesOf(const Scene& scene, const Lattice& lattice,
                                         std::span<const uint32_t> instances) {
  std::vector<size_t> first(instances.size() + 1, 0);
  for (size_t i = 0; i < instances.size(); ++i) {
    first[i + 1] = first[i] + scene.meshes[static_cast<size_t>(scene.instances[instances[i]].mesh)].triangleCount();
  }
  const size_t total = first.back(), chunks = (total + kTriangleChunk - 1) / kTriangleChunk;
  std::vector<std::vector<BrickReference>> parts(chunks);
  parallelFor(chunks, 1, [&](size_t c) {
    const size_t begin = c * kTriangleChunk, end = std::min(total, begin + kTriangleChunk);
    size_t i = static_cast<size_t>(std::upper_bound(first.begin(), first.end(), begin) - first.begin()) - 1;
    parts[c].reserve((end - begin) + (end - begin) / 2);
    for (size_t g = begin; g < end; ++g) {
      while (g >= first[i + 1]) ++i;
      bricksOfTriangle(scene, lattice, {instances[i], static_cast<uint32_t>(g - first[i])}, parts[c]);
    }
  });
  // Counting sort by brick; parts come in order, so the order within a brick is that of the instances.
  std::vector<uint32_t> start(lattice.places() + 1, 0);
  for (const auto& part : parts) {
    for (const BrickReference& r : part) ++start[r.place + 1];
  }
  std::partial_sum(start.begin(), start.end(), start.begin());
  std::vector<BrickReference> sorted(start.back());
  for (const auto& part : parts) {
    for (const BrickReference& r : part) sorted[start[r.place]++] = r;
  }
  return sorted;
}

}  // namespace roomlight
