#include "base/parallel.h"
#include "base/sampling.h"
#include "baselines/lpv.h"
#include "baselines/shown_sides.h"
#include "baselines/sky_survey.h"
#include "radiance/sky_guide.h"

namespace roomlight {
namespace {

constexpr float kSmallestM = 1e-3f;   // of cells
constexpr float kCoarser = 2;         // as large at least are coarse cells
constexpr int kSurveyRays = 4;   // a surfel, to learn where the sky is seen
constexpr float kSurfelCells = 0.5f;  // edge of the voxels that surfels come from, in cells of the fine grid: two in every cell, wherever the grid lies

Bounds3 homeAround(const Bounds3& scene, const Bounds3& room, float reach) {
  const Vec3 far(reach * maxComponent(room.size()));
  return {max(scene.lo, room.lo - far), min(scene.hi, room.hi + far)};
}

std::vector<Surfel> surfelsOf(const RayScene& rays, const Voxels& voxels) {
  const std::vector<uint8_t> shown = shownSides(rays, voxels);
  std::vector<Surfel> out;
  for (size_t s = 0; s < shown.size(); ++s) {
    const FaceSlot& slot = voxels.slots[s];
    if (shown[s]) out.push_back({slot.position, slot.normal, slot.albedo, slot.areaM2});
  }
  return out;
}

// The sky has no map: every surfel asks for its light, through what lets it in.
std::vector<VirtualLight> underTheSky(const RayScene& rays, const Lights& lights, std::span<const Surfel> surfels, const LpvLight& light, const LpvSettings& settings, uint64_t& rayCount) {
  std::vector<VirtualLight> out(surfels.size());
  if (!lights.sky().present()) return {};
  const auto samples = static_cast<size_t>(settings.skySamples);
  parallelFor(surfels.size(), 256, [&](size_t i) {
    const Surfel& s = surfels[i];
    const int32_t guide = guideAt(light.guide, light.voxels, s.p, s.n);
    Vec3 lux;
    for (size_t k = 0; k < samples; ++k) {
      Sampler sampler(i, static_cast<uint32_t>(k), settings.seed);
      const Vec2 u = sampler.next2();
      const LightSample sky = sampleSkyGuided(light.guide, guide, lights, u, sampler.next1());
      const float cosine = dot(sky.wi, s.n);
      if (sky.valid() && cosine > 0) lux += sky.radiance * rays.transmittance({offsetOrigin(s.p, s.n), sky.wi, 0, kInfinity}) * cosine;
    }
    out[i] = {s.p, s.n, lux * s.albedo * (s.areaM2 / static_cast<float>(samples))};
  });
  rayCount += surfels.size() * samples;
  return out;
}

void inject(std::span<const VirtualLight> lights, LpvGrid& grid) {
  const LpvLattice& lattice = grid.lattice();
  for (const VirtualLight& v : lights) {
    // Half a cell off the surface, so that it does not light itself and leaves the cell that its wall is in.
    const Int3 cell = lattice.cellOf(v.p + v.n * (0.5f * lattice.cellM));
    if (lattice.contains(cell) && !isBlack(v.fluxLm)) grid.addLobe(lattice.index(cell), v.n, v.fluxLm);
  }
}

// Into the layer around a grid: what comes in from outside, as the coarser level has it. The same radiance is as much intensity as a cell is large.
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

LpvLight lightLpv(const RayScene& rays, const Lights& lights, const Bounds3& room, const LpvSettings& settings, const Progress& progress) {
  LpvLight out;
  const Bounds3 home = homeAround(rays.bounds(), room, settings.coarseReach);
  std::vector<LpvGrid> grids{LpvGrid(latticeAround(room, settings.cells, kSmallestM))};
  if (settings.coarseCells > 0) grids.emplace_back(latticeAround(home, settings.coarseCells, kCoarser * grids[0].lattice().cellM));

  VoxelSettings voxel;
  voxel.voxelSizeM = kSurfelCells * grids[0].lattice().cellM;
  SkySurvey survey = surveySky(rays, lights, voxel, kSurveyRays, settings.seed, {{}, progress.cancelled});
  out.voxels = lights.sky().present() ? std::move(survey.voxels) : voxelise(rays.scene(), voxel).voxels;
  out.guide = std::move(survey.guide);
  out.rays = survey.rays;
  const std::vector<Surfel> surfels = surfelsOf(rays, out.voxels);
  out.surfels = surfels.size();
  progress.at(0.3f);

  const auto take = [&](std::span<const VirtualLight> found) {
    out.virtualLights += found.size();
    parallelFor(grids.size(), 1, [&](size_t i) { inject(found, grids[i]); });
  };
  out.rays += traceShadowMaps(rays, lights, home, settings, take, {{}, progress.cancelled});
  take(underTheSky(rays, lights, surfels, out, settings, out.rays));
  progress.at(0.7f);

  for (size_t i = grids.size(); i-- > 0 && !progress.stop();) {
    LpvGeometry geometry = settings.geometry ? LpvGeometry(grids[i].lattice(), surfels) : LpvGeometry(grids[i].lattice());
    if (!out.levels.empty()) surround(grids[i], out.levels.front());
    const LpvGrid light = propagate(grids[i], geometry, settings.steps, settings.bounces);
    out.levels.emplace(out.levels.begin(), light, std::move(geometry));
  }
  return out;
}

}  // namespace roomlight
