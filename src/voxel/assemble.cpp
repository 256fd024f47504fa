#include "voxel/bricks.h"

#include "base/parallel.h"

namespace roomlight {

BrickView viewOf(const BrickRecords& records, uint32_t place, std::span<const Voxelisation::Reference> references) {
  return {place, records.occupied, records.voxels, records.slots, 0, references};
}

BrickView viewOf(const Voxelisation& v, size_t brick, uint32_t place) {
  BrickView view;
  view.place = place;
  view.occupied = v.voxels.bricks[brick].occupied;
  const size_t firstVoxel = v.voxels.bricks[brick].firstVoxel;
  const size_t endVoxel =
      brick + 1 < v.voxels.bricks.size() ? v.voxels.bricks[brick + 1].firstVoxel : v.voxels.voxels.size();
  view.voxels = std::span(v.voxels.voxels).subspan(firstVoxel, endVoxel - firstVoxel);
  if (!view.voxels.empty()) {
    const SurfaceVoxel& last = view.voxels.back();
    view.slotBase = view.voxels.front().firstSlot;
    const size_t endSlot = last.firstSlot + static_cast<size_t>(std::popcount(last.faces));
    view.slots = std::span(v.voxels.slots).subspan(view.slotBase, endSlot - view.slotBase);
  }
  view.references =
      std::span(v.references).subspan(v.firstReference[brick], v.firstReference[brick + 1] - v.firstReference[brick]);
  return view;
}

Voxelisation assemble(const Lattice& lattice, std::span<const BrickView> bricks) {
  Voxelisation result;
  Voxels& v = result.voxels;
  v.voxelSizeM = lattice.voxelSizeM;
  v.origin = lattice.originM();
  v.brickDims = lattice.brickDims;
  v.brickIndex.assign(lattice.places(), -1);
  v.bricks.resize(bricks.size());
  result.firstReference.resize(bricks.size() + 1);
  size_t voxels = 0, slots = 0, references = 0;
  std::vector<uint32_t> firstSlot(bricks.size());
  for (size_t i = 0; i < bricks.size(); ++i) {
    const BrickView& from = bricks[i];
    const Int3 b = lattice.brick(from.place);
    Brick& brick = v.bricks[i];
    brick.coord = {b.x - lattice.firstBrick.x, b.y - lattice.firstBrick.y, b.z - lattice.firstBrick.z};
    brick.firstVoxel = static_cast<uint32_t>(voxels);
    brick.occupied = from.occupied;
    uint16_t before = 0;
    for (size_t w = 0; w < brick.occupied.size(); ++w) {
      brick.before[w] = before;
      before = static_cast<uint16_t>(before + std::popcount(brick.occupied[w]));
    }
    v.brickIndex[from.place] = static_cast<int32_t>(i);
    firstSlot[i] = static_cast<uint32_t>(slots);
    result.firstReference[i] = static_cast<uint32_t>(references);
    voxels += from.voxels.size();
    slots += from.slots.size();
    references += from.references.size();
  }
  result.firstReference.back() = static_cast<uint32_t>(references);
  v.voxels.resize(voxels);
  v.slots.resize(slots);
  result.references.resize(references);
  parallelFor(bricks.size(), 64, [&](size_t i) {
    const BrickView& from = bricks[i];
    SurfaceVoxel* out = v.voxels.data() + v.bricks[i].firstVoxel;
    for (SurfaceVoxel voxel : from.voxels) {
      voxel.firstSlot += firstSlot[i] - from.slotBase;
      *out++ = voxel;
    }
    std::copy(from.slots.begin(), from.slots.end(), v.slots.begin() + firstSlot[i]);
    std::copy(from.references.begin(), from.references.end(), result.references.begin() + result.firstReference[i]);
  });
  return result;
}

}  // namespace roomlight
