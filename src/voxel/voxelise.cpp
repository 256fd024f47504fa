#include "voxel/voxelise.h"

#include <cassert>
#include <numeric>

#include "base/parallel.h"
#include "voxel/bricks.h"

namespace roomlight {
namespace {

using Reference = Voxelisation::Reference;

// A brick of the result: made of the old brick in the same place, if any, and of the changed instances' triangles.
struct Plan {
  uint32_t place = 0;
  int64_t oldBrick = -1;
  bool serves = false;  // the old brick stays as it is
  std::span<const BrickReference> entering;
  std::vector<Reference> references;  // where it does not serve: what to build from; none: the brick disappears
  BrickRecords records;
};

void refreshBounds(Voxelisation& v, const Scene& scene, std::span<const uint32_t> changed,
                   std::span<const uint8_t> hidden) {
  v.instanceBounds.resize(scene.instances.size());
  parallelFor(changed.size(), 1, [&](size_t k) {
    const uint32_t i = changed[k];
    const bool isHidden = i < hidden.size() && hidden[i];
    v.instanceBounds[i] = isHidden ? Bounds3{} : instanceBounds(scene, scene.instances[i]);
  });
}

Bounds3 unionOf(std::span<const Bounds3> each) {
  Bounds3 bounds;
  for (const Bounds3& b : each) bounds.add(b);
  return bounds;
}

// For every brick of `v`, whether a triangle of a changed instance is in it.
std::vector<uint8_t> bricksLeft(const Voxelisation& v, std::span<const uint8_t> isChanged) {
  std::vector<uint8_t> left(v.voxels.bricks.size(), 0);
  parallelFor(left.size(), 256, [&](size_t b) {
    for (uint32_t r = v.firstReference[b]; r < v.firstReference[b + 1] && !left[b]; ++r)
      left[b] = isChanged[v.references[r].instance];
  });
  return left;
}

// Old bricks and those the changed instances enter, merged in order of their place in the new lattice.
std::vector<Plan> planBricks(const Voxelisation& v, const Lattice& lattice, std::span<const uint8_t> left,
                             std::span<const BrickReference> entering) {
  const Lattice old = latticeOf(v.voxels);
  std::vector<Plan> plans;
  size_t next = 0;
  const auto enterBrick = [&](Plan& plan) {
    const size_t first = next;
    while (next < entering.size() && entering[next].place == plan.place) ++next;
    plan.entering = entering.subspan(first, next - first);
  };
  const auto enterBricksBefore = [&](uint64_t place) {
    while (next < entering.size() && entering[next].place < place) {
      plans.emplace_back().place = entering[next].place;
      enterBrick(plans.back());
    }
  };
  for (size_t b = 0; b < v.voxels.bricks.size(); ++b) {
    const Int3 brick = old.brickOf(v.voxels.bricks[b].coord);
    // Outside the new grid: only what left the scene's bounds was there.
    if (!lattice.contains(brick)) continue;
    const uint32_t place = lattice.place(brick);
    enterBricksBefore(place);
    Plan& plan = plans.emplace_back();
    plan.place = place;
    plan.oldBrick = static_cast<int64_t>(b);
    enterBrick(plan);
    plan.serves = !left[b] && plan.entering.empty();
  }
  enterBricksBefore(lattice.places());
  return plans;
}

void gatherReferences(const Voxelisation& v, std::span<const uint8_t> isChanged, Plan& plan) {
  std::vector<Reference> entering;
  for (const BrickReference& r : plan.entering) entering.push_back(r.triangle);
  if (plan.oldBrick < 0) {
    plan.references = std::move(entering);
    return;
  }
  std::vector<Reference> staying;
  const auto b = static_cast<size_t>(plan.oldBrick);
  for (uint32_t r = v.firstReference[b]; r < v.firstReference[b + 1]; ++r) {
    if (!isChanged[v.references[r].instance]) staying.push_back(v.references[r]);
  }
  std::merge(staying.begin(), staying.end(), entering.begin(), entering.end(), std::back_inserter(plan.references));
}

// `v` in the grid `lattice` with the changed instances taken out and, where visible, put in as they are now.
Voxelisation rebuilt(const Voxelisation& v, const Scene& scene, const Lattice& lattice,
                     std::span<const uint32_t> changed) {
  std::vector<uint8_t> isChanged(scene.instances.size(), 0);
  for (const uint32_t i : changed) isChanged[i] = 1;
  std::vector<uint32_t> visible;
  for (uint32_t i = 0; i < isChanged.size(); ++i) {
    if (isChanged[i] && !v.instanceBounds[i].empty()) visible.push_back(i);
  }
  const std::vector<BrickReference> entering = referencesOf(scene, lattice, visible);
  std::vector<Plan> plans = planBricks(v, lattice, bricksLeft(v, isChanged), entering);
  parallelFor(plans.size(), 4, [&](size_t i) {
    if (plans[i].serves) return;
    gatherReferences(v, isChanged, plans[i]);
    plans[i].records = buildBrick(scene, lattice, lattice.brick(plans[i].place), plans[i].references);
  });
  std::vector<BrickView> views;
  views.reserve(plans.size());
  for (const Plan& plan : plans) {
    if (plan.serves) {
      views.push_back(viewOf(v, static_cast<size_t>(plan.oldBrick), plan.place));
    } else if (!plan.references.empty()) {
      views.push_back(viewOf(plan.records, plan.place, plan.references));
    }
  }
  return assemble(lattice, views);
}

}  // namespace

size_t Voxels::bytes() const {
  return brickIndex.size() * sizeof(int32_t) + bricks.size() * sizeof(Brick) + voxels.size() * sizeof(SurfaceVoxel) +
         slots.size() * sizeof(FaceSlot);
}

Voxelisation voxelise(const Scene& scene, const VoxelSettings& settings, std::span<const uint8_t> hidden) {
  // An update of nothing after which every instance is new.
  Voxelisation v;
  v.voxels.voxelSizeM = v.wantedM = chooseVoxelSize(scene, settings);
  std::vector<uint32_t> all(scene.instances.size());
  std::iota(all.begin(), all.end(), 0u);
  update(v, scene, all, hidden);
  return v;
}

void update(Voxelisation& v, const Scene& scene, std::span<const uint32_t> changedInstances,
            std::span<const uint8_t> hidden) {
  assert(v.instanceBounds.size() <= scene.instances.size());
  refreshBounds(v, scene, changedInstances, hidden);
  const Bounds3 bounds = unionOf(v.instanceBounds);
  const float wanted = v.wantedM, size = feasibleVoxelSizeM(bounds, wanted);
  if (size != v.voxels.voxelSizeM) {  // the grid grew out of all proportion, or no longer is: start again
    VoxelSettings settings;
    settings.voxelSizeM = size;
    v = voxelise(scene, settings, hidden);
    v.wantedM = wanted;
    return;
  }
  Voxelisation next = rebuilt(v, scene, fitLattice(bounds, size), changedInstances);
  next.wantedM = wanted;
  next.instanceBounds = std::move(v.instanceBounds);
  v = std::move(next);
}

}  // namespace roomlight
