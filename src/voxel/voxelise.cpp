#include "voxel/voxelise.h"

#include <numeric>

#include "base/parallel.h"
#include "voxel/brick_builder.h"
#include "voxel/clip.h"

namespace roomlight {
namespace {

constexpr size_t kTriangleChunk = 4096;
constexpr double kLargestGrid = 16e6;    // bricks in the dense index: 64 MiB
constexpr double kBytesPerVoxel = 320;   // record, 1.7 slots, light on them and its share of the mips
constexpr double kVoxelsPerCrossSection = 1.6;  // voxels that a surface of one voxel's cross-section touches

bool isHidden(std::span<const uint8_t> hidden, size_t instance) { return instance < hidden.size() && hidden[instance]; }

Bounds3 visibleBounds(const Scene& scene, std::span<const uint8_t> hidden) {
  std::vector<Bounds3> each(scene.instances.size());
  parallelFor(each.size(), 4, [&](size_t i) {
    if (!isHidden(hidden, i)) each[i] = instanceBounds(scene, scene.instances[i]);
  });
  Bounds3 bounds;
  for (const Bounds3& b : each) bounds.add(b);
  return bounds;
}

// Whole bricks of the world's own lattice, one voxel of margin: a brick keeps its place when the bounds change.
Lattice fitLattice(const Bounds3& bounds, float voxelSizeM) {
  const double h = voxelSizeM, edge = h * kBrickSize;
  const auto first = [&](float lo) { return std::floor((lo - h) / edge); };
  const auto last = [&](float hi) { return std::floor((hi + h) / edge); };
  Lattice lattice;
  lattice.voxelSizeM = voxelSizeM;
  if (bounds.empty()) return lattice;
  int* dims = &lattice.brickDims.x;
  for (int k = 0; k < 3; ++k) {
    lattice.origin[k] = static_cast<float>(first(bounds.lo[k]) * edge);
    dims[k] = static_cast<int>(last(bounds.hi[k]) - first(bounds.lo[k])) + 1;
  }
  return lattice;
}

struct BrickTriangle {
  uint32_t brick;
  Voxelisation::Reference reference;
};

uint32_t linear(const Lattice& lattice, int x, int y, int z) {
  return static_cast<uint32_t>((static_cast<int64_t>(z) * lattice.brickDims.y + y) * lattice.brickDims.x + x);
}
Int3 brickCoord(const Lattice& lattice, uint32_t b) {
  const auto dx = static_cast<uint32_t>(lattice.brickDims.x), dy = static_cast<uint32_t>(lattice.brickDims.y);
  return {static_cast<int>(b % dx), static_cast<int>(b / dx % dy), static_cast<int>(b / dx / dy)};
}

// Every brick in which a piece of the triangle lies, by the same cuts that buildBrick() makes.
void bricksOfTriangle(const Scene& scene, const Lattice& lattice, Voxelisation::Reference ref, std::vector<BrickTriangle>& out) {
  const LatticeTriangle t = latticeTriangle(scene, lattice, ref.instance, ref.triangle);
  if (!(t.area > 0)) return;
  Polygon polygon;
  polygon.add(t.a), polygon.add(t.b), polygon.add(t.c);
  cutIntoCells(polygon, 0, kBrickSize, [&](int x, const Polygon& px) {
    cutIntoCells(px, 1, kBrickSize, [&](int y, const Polygon& py) {
      cutIntoCells(py, 2, kBrickSize, [&](int z, const Polygon&) { out.push_back({linear(lattice, x, y, z), ref}); });
    });
  });
}

// References of the listed instances, sorted by brick, within a brick by instance and triangle.
std::vector<BrickTriangle> referencesOf(const Scene& scene, const Lattice& lattice, std::span<const uint32_t> instances) {
  std::vector<size_t> first(instances.size() + 1, 0);
  for (size_t i = 0; i < instances.size(); ++i) {
    first[i + 1] = first[i] + scene.meshes[static_cast<size_t>(scene.instances[instances[i]].mesh)].triangleCount();
  }
  const size_t total = first.back(), chunks = (total + kTriangleChunk - 1) / kTriangleChunk;
  std::vector<std::vector<BrickTriangle>> parts(chunks);
  parallelFor(chunks, 1, [&](size_t c) {
    const size_t begin = c * kTriangleChunk, end = std::min(total, begin + kTriangleChunk);
    size_t i = static_cast<size_t>(std::upper_bound(first.begin(), first.end(), begin) - first.begin()) - 1;
    parts[c].reserve(kTriangleChunk + kTriangleChunk / 2);
    for (size_t g = begin; g < end; ++g) {
      while (g >= first[i + 1]) ++i;
      bricksOfTriangle(scene, lattice, {instances[i], static_cast<uint32_t>(g - first[i])}, parts[c]);
    }
  });
  // Counting sort by brick; parts come in order, so the order within a brick is that of the instances.
  const size_t grid = static_cast<size_t>(lattice.brickDims.x) * lattice.brickDims.y * lattice.brickDims.z;
  std::vector<uint32_t> start(grid + 1, 0);
  for (const auto& part : parts) {
    for (const BrickTriangle& r : part) ++start[r.brick + 1];
  }
  std::partial_sum(start.begin(), start.end(), start.begin());
  std::vector<BrickTriangle> sorted(start.back());
  for (const auto& part : parts) {
    for (const BrickTriangle& r : part) sorted[start[r.brick]++] = r;
  }
  return sorted;
}

// Puts bricks' records, in order of their place in the grid, into flat arrays.
Voxels assemble(const Lattice& lattice, std::span<const uint32_t> places, std::span<const BrickRecords> records) {
  Voxels v;
  v.voxelSizeM = lattice.voxelSizeM;
  v.origin = lattice.origin;
  v.brickDims = lattice.brickDims;
  v.brickIndex.assign(static_cast<size_t>(lattice.brickDims.x) * lattice.brickDims.y * lattice.brickDims.z, -1);
  v.bricks.resize(records.size());
  size_t voxels = 0, slots = 0;
  std::vector<uint32_t> firstSlot(records.size());
  for (size_t i = 0; i < records.size(); ++i) {
    Brick& brick = v.bricks[i];
    brick.coord = brickCoord(lattice, places[i]);
    brick.firstVoxel = static_cast<uint32_t>(voxels);
    brick.occupied = records[i].occupied;
    uint16_t before = 0;
    for (size_t w = 0; w < 8; ++w) {
      brick.before[w] = before;
      before = static_cast<uint16_t>(before + std::popcount(brick.occupied[w]));
    }
    v.brickIndex[places[i]] = static_cast<int32_t>(i);
    firstSlot[i] = static_cast<uint32_t>(slots);
    voxels += records[i].voxels.size();
    slots += records[i].slots.size();
  }
  v.voxels.resize(voxels);
  v.slots.resize(slots);
  parallelFor(records.size(), 64, [&](size_t i) {
    SurfaceVoxel* out = v.voxels.data() + v.bricks[i].firstVoxel;
    for (SurfaceVoxel voxel : records[i].voxels) {
      voxel.firstSlot += firstSlot[i];
      *out++ = voxel;
    }
    std::copy(records[i].slots.begin(), records[i].slots.end(), v.slots.begin() + firstSlot[i]);
  });
  return v;
}

}  // namespace

size_t Voxels::bytes() const {
  return brickIndex.size() * sizeof(int32_t) + bricks.size() * sizeof(Brick) + voxels.size() * sizeof(SurfaceVoxel) +
         slots.size() * sizeof(FaceSlot);
}

float chooseVoxelSize(const Scene& scene, const VoxelSettings& settings) {
  if (settings.voxelSizeM > 0) return settings.voxelSizeM;
  std::vector<double> areas(scene.instances.size(), 0);
  parallelFor(areas.size(), 4, [&](size_t i) {
    const Instance& instance = scene.instances[i];
    const Mesh& mesh = scene.meshes[static_cast<size_t>(instance.mesh)];
    for (size_t t = 0; t + 2 < mesh.indices.size(); t += 3) {
      const Vec3 a = mesh.positions[mesh.indices[t]], b = mesh.positions[mesh.indices[t + 1]], c = mesh.positions[mesh.indices[t + 2]];
      areas[i] += 0.5 * length(instance.worldFromObject.normal(cross(b - a, c - a)));
    }
  });
  const double area = std::accumulate(areas.begin(), areas.end(), 0.0);
  const double budget = settings.memoryBudgetMiB * 1048576.0;
  double h = std::sqrt(area * kVoxelsPerCrossSection * kBytesPerVoxel / budget);
  h = std::clamp(h, static_cast<double>(settings.smallestM), static_cast<double>(settings.largestM));
  // A small home on a huge ground plane: the dense index must stay small too, whatever the limits say.
  const Vec3 size = scene.bounds().size();
  const auto bricks = [&](double v) {
    const double e = v * kBrickSize;
    return (size.x / e + 3) * (size.y / e + 3) * (size.z / e + 3);
  };
  while (bricks(h) > kLargestGrid || area / (h * h) * kBytesPerVoxel > 4 * budget) h *= 1.1;
  return static_cast<float>(h);
}

Voxelisation voxelise(const Scene& scene, const VoxelSettings& settings, std::span<const uint8_t> hidden) {
  const Lattice lattice = fitLattice(visibleBounds(scene, hidden), chooseVoxelSize(scene, settings));
  std::vector<uint32_t> instances;
  for (uint32_t i = 0; i < scene.instances.size(); ++i) {
    if (!isHidden(hidden, i)) instances.push_back(i);
  }
  const std::vector<BrickTriangle> sorted = referencesOf(scene, lattice, instances);
  Voxelisation v;
  std::vector<uint32_t> places;
  v.references.resize(sorted.size());
  for (size_t i = 0; i < sorted.size(); ++i) {
    v.references[i] = sorted[i].reference;
    if (i == 0 || sorted[i].brick != sorted[i - 1].brick) {
      places.push_back(sorted[i].brick);
      v.firstReference.push_back(static_cast<uint32_t>(i));
    }
  }
  v.firstReference.push_back(static_cast<uint32_t>(sorted.size()));
  std::vector<BrickRecords> records(places.size());
  parallelFor(places.size(), 4, [&](size_t i) {
    const std::span<const Voxelisation::Reference> all(v.references);
    records[i] = buildBrick(scene, lattice, brickCoord(lattice, places[i]),
                            all.subspan(v.firstReference[i], v.firstReference[i + 1] - v.firstReference[i]));
  });
  v.voxels = assemble(lattice, places, records);
  return v;
}

}  // namespace roomlight
