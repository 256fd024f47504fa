#include "baselines/lpv_cache.h"

#include "base/parallel.h"
#include "base/sampling.h"
#include "baselines/scene_survey.h"
#include "radiance/direct_light.h"
#include "radiance/sky_guide.h"
#include "voxel/voxelise.h"

namespace roomlight {
namespace {

constexpr float kSmallestM = 1e-3f;   // of cells
constexpr float kCoarser = 2;         // as large at least are coarse cells
constexpr int kSurveyRays = 4;   // a surfel, to learn where the sky is seen
constexpr float kSurfelCells = 0.5f;  // edge of the voxels that surfels come from, in cells of the fine grid: two in
 // every cell, wherever the grid lies

Bounds3 homeAround(const Bounds3& scene, const Bounds3& room, float reach) {
  const Vec3 far(reach * maxComponent(room.size()));
  return {max(scene.lo, room.lo - far), min(scene.hi, room.hi + far)};
}

void inject(std::span<const VirtualLight> lights, LpvGrid& grid) {
  const LpvLattice& lattice = grid.lattice();
  for (const VirtualLight& v : lights) {
    // Half a cell off the surface, so that it does not light itself and leaves the cell that its wall is in.
    const Int3 cell = lattice.cellOf(v.p + v.n * (0.5f * lattice.cellM));
    if (lattice.contains(cell) && !isBlack(v.fluxLm)) grid.addLobe(lattice.index(cell), v.n, v.fluxLm);
  }
}

// Into the layer around a grid: what comes in from outside, as the coarser level has it. The same radiance is as much
// intensity as a cell is large.
void surround(LpvGrid& grid, const LpvLevel& coarser) {
  const LpvLattice& lattice = grid.lattice();
  const float ratio = lattice.cellM / coarser.lattice().cellM, scale = ratio * ratio;
  const Int3 n = lattice.padded();
  for (int z = 0; z < n.z; ++z) {
    for (int y = 0; y < n.y; ++y) {
      for (int x = 0; x < n.x; ++x) {
        const Int3 cell{x, y, z};
        if (!lattice.isBorder(cell)) continue;
        LpvIntensity i = coarser.at(lattice.centre(cell));
        for (auto& channel : i) {
          for (float& c : channel) c *= scale;
        }
        grid.set(lattice.index(cell), i);
      }
    }
  }
}

}  // namespace

LpvCache::LpvCache(const RayScene& rays, const Lights& lights, const Bounds3& room, const LpvSettings& settings,
                   const Progress& progress)
    : settings_(settings),
      room_(room),
      home_(homeAround(rays.bounds(), room, settings.coarseReach)),
      fine_(latticeAround(room, settings.cells, kSmallestM)) {
  VoxelSettings voxel;
  voxel.voxelSizeM = kSurfelCells * fine_.cellM;
  voxels_ = voxelise(rays.scene(), voxel);
  marks_ = marksOf(voxels_.voxels);
  followVoxels(rays, lights, remapSlots({}, marks_, voxels_.voxels, {}), {}, progress);
  light(rays, lights, progress);
}

void LpvCache::update(const RayScene& rays, const Lights& lights, const SceneChange& change, const Progress& progress) {
  light_.rays = 0;
  if (!change.moved.empty()) {
    const std::vector<Bounds3> places = followMoves(voxels_, rays.scene(), change);
    std::vector<BrickMark> marks = marksOf(voxels_.voxels);
    const SlotRemap remap = remapSlots(marks_, marks, voxels_.voxels, places);
    marks_ = std::move(marks);
    followVoxels(rays, lights, remap, places, progress);
  }
  light(rays, lights, progress);
}

LpvLight LpvCache::take() {
  light_.voxels = std::move(voxels_.voxels);
  return std::move(light_);
}

// Sides that materials show, and the sky's light on them: of those in bricks that are carried what crosses none of the
// changed places stays.
void LpvCache::followVoxels(const RayScene& rays, const Lights& lights, const SlotRemap& remap,
                            std::span<const Bounds3> places, const Progress& progress) {
  const Voxels& voxels = voxels_.voxels;
  if (lights.sky().present())
    light_.guide = keptGuide(
        light_.guide, surveySky({rays, lights}, voxels, &remap, {kSurveyRays, settings_.seed}, light_.rays, progress),
        remap);
  light_.voxels = voxels;  // for guideAt
  shown_ = shownSides(rays, voxels);
  std::vector<UnderSky> now(lights.sky().present() ? voxels.slots.size() : 0);
  std::atomic<size_t> asked = 0;
  parallelFor(now.empty() ? 0 : voxels.bricks.size(), 4, [&](size_t b) {
    if (progress.stop()) return;
    const auto [first, last] = slotsOfBrick(voxels, b);
    const float reach = SkyDirection::kOff * length(home_.size());
    std::vector<Bounds3> ahead;
    for (size_t s = first; s < last; ++s) {
      if (!shown_[s]) continue;
      bool anew = !remap.keeps(b);
      if (!anew) {
        UnderSky& before = underSky_[remap.firstOld[b] + (s - first)];
        const FaceSlot& slot = voxels.slots[s];
        inFront(slot, places, voxels.voxelSizeM, ahead);
        for (const SkyDirection way : before.ways)
          anew = anew || (!ahead.empty() && crosses({slot.position, way.direction(), 0, kInfinity}, ahead, reach));
        if (!anew) now[s] = std::move(before);
      }
      if (anew) now[s] = askSky(rays, lights, s), ++asked;
    }
  });
  underSky_ = std::move(now);
  light_.rays += asked * static_cast<size_t>(settings_.skySamples);
}

// The sky has no map: every surfel asks for its light, through what lets it in.
LpvCache::UnderSky LpvCache::askSky(const RayScene& rays, const Lights& lights, size_t slot) const {
  const FaceSlot& s = voxels_.voxels.slots[slot];
  const int32_t guide = guideAt(light_.guide, light_.voxels, s.position, s.normal);
  UnderSky out;
  Vec3 lux;
  for (int k = 0; k < settings_.skySamples; ++k) {
    Sampler sampler(slot, static_cast<uint32_t>(k), settings_.seed);
    const Vec2 u = sampler.next2();
    const LightSample sky = sampleSkyGuided(light_.guide, guide, lights, u, sampler.next1());
    const float cosine = dot(sky.wi, s.normal);
    if (!sky.valid() || cosine <= 0) continue;
    lux += sky.radiance * rays.transmittance({offsetOrigin(s.position, s.normal), sky.wi, 0, kInfinity}) * cosine;
    out.ways.emplace_back(sky.wi);
  }
  out.fluxLm = lux * s.albedo * (s.areaM2 / static_cast<float>(settings_.skySamples));
  return out;
}

void LpvCache::light(const RayScene& rays, const Lights& lights, const Progress& progress) {
  std::vector<Surfel> surfels;
  std::vector<VirtualLight> skyLit;
  for (size_t s = 0; s < shown_.size(); ++s) {
    const FaceSlot& slot = voxels_.voxels.slots[s];
    if (!shown_[s]) continue;
    surfels.push_back({slot.position, slot.normal, slot.albedo, slot.areaM2});
    if (!underSky_.empty()) skyLit.push_back({slot.position, slot.normal, underSky_[s].fluxLm});
  }
  light_.surfels = surfels.size(), light_.virtualLights = 0;
  light_.levels.clear();
  std::vector<LpvGrid> grids{LpvGrid(fine_)};
  if (settings_.coarseCells > 0)
    grids.emplace_back(latticeAround(home_, settings_.coarseCells, kCoarser * fine_.cellM));
  progress.at(0.3f);

  const auto take = [&](std::span<const VirtualLight> found) {
    light_.virtualLights += found.size();
    parallelFor(grids.size(), 1, [&](size_t i) { inject(found, grids[i]); });
  };
  light_.rays += traceShadowMaps(rays, lights, home_, settings_, take, {{}, progress.cancelled});
  take(skyLit);
  progress.at(0.7f);

  for (size_t i = grids.size(); i-- > 0 && !progress.stop();) {
    LpvGeometry geometry =
        settings_.geometry ? LpvGeometry(grids[i].lattice(), surfels) : LpvGeometry(grids[i].lattice());
    if (!light_.levels.empty()) surround(grids[i], light_.levels.front());
    const LpvGrid light = propagate(grids[i], geometry, settings_.steps, settings_.bounces);
    light_.levels.emplace(light_.levels.begin(), light, std::move(geometry));
  }
}

LpvLight lightLpv(const RayScene& rays, const Lights& lights, const Bounds3& room, const LpvSettings& settings,
                  const Progress& progress) {
  return LpvCache(rays, lights, room, settings, progress).take();
}

}  // namespace roomlight
