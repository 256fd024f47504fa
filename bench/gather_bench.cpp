// Radiance field -> picture of 480 x 270 pixels: by cones, and by rays with what that leaves of Embree's speed.
#include "base/parallel.h"
#include "gather/cone_gather.h"
#include "gather/ray_gather.h"
#include "home.h"
#include "voxel/voxelise.h"

namespace roomlight::bench {
namespace {

void gatherHome(benchmark::State& state, const Home& home) {
  const RayScene rays(home.scene);
  const Lights lights(home.scene);
  const Voxelisation v = voxelise(home.scene, {});
  const RadianceField field = illuminate(rays, lights, v.voxels, {});
  ConeGatherSettings settings;
  settings.width = 480, settings.height = 270;
  double traced = 0, cones = 0;
  for (auto _ : state) {
    const GatheredPicture result = gatherCones({rays, lights}, v.voxels, field, home.camera, settings);
    traced += static_cast<double>(result.rays), cones += static_cast<double>(result.cones);
  }
  state.counters["MraysPerS"] = benchmark::Counter(traced / 1e6, benchmark::Counter::kIsRate);
  state.counters["MconesPerS"] = benchmark::Counter(cones / 1e6, benchmark::Counter::kIsRate);
}

// Processor time of the same rays, in the same batches, with nothing done about them.
double bareSeconds(const RayScene& rays, const RayLog& log) {
  size_t most = 0;
  for (const RayLog::Batch& b : log.batches) most = std::max(most, b.count);
  std::vector<Hit> hits(most);
  std::vector<Vec3> left(most);
  const double start = cpuSeconds();
  for (const RayLog::Batch& b : log.batches) {
    const std::span<const Ray> some = std::span(log.rays).subspan(b.first, b.count);
    switch (b.kind) {
      case RayLog::Kind::Nearest: rays.intersect(some, hits); break;
      case RayLog::Kind::NearestClose: rays.intersectClose(some, hits); break;
      case RayLog::Kind::Shadow: rays.transmittance(some, left); break;
    }
  }
  benchmark::DoNotOptimize(hits.data());
  benchmark::DoNotOptimize(left.data());
  return cpuSeconds() - start;
}

// One thread, without the filter; in turns, so that a busy machine disturbs both alike.
void gatherByRays(benchmark::State& state, const Home& home) {
  RayScene rays(home.scene);
  const Lights lights(home.scene, true);
  const Voxels voxels = voxelise(home.scene, {}).voxels;
  RadianceSettings radiance;
  radiance.pyramid = false;
  const RadianceField field = illuminate(rays, lights, voxels, radiance);
  RayGatherSettings settings;
  settings.width = 480, settings.height = 270, settings.filterPasses = 0;
  withThreads(1, [&] {
    RayLog log;
    rays.record(&log);
    gatherRays({rays, lights}, voxels, field, home.camera, settings);
    rays.record(nullptr);
    double gatherS = 0, bareS = 0;
    for (auto _ : state) {
      const double start = cpuSeconds();
      benchmark::DoNotOptimize(gatherRays({rays, lights}, voxels, field, home.camera, settings).image.pixels.data());
      gatherS += cpuSeconds() - start;
      bareS += bareSeconds(rays, log);
    }
    const double traced = static_cast<double>(log.rays.size()) * static_cast<double>(state.iterations()) / 1e6;
    state.counters["Mrays"] = static_cast<double>(log.rays.size()) / 1e6;
    state.counters["bareMraysPerS"] = traced / bareS;
    state.counters["MraysPerS"] = traced / gatherS;
    state.counters["percentOfBare"] = 100 * bareS / gatherS;
  });
}

}  // namespace
}  // namespace roomlight::bench

int main(int argc, char** argv) {
  using namespace roomlight::bench;
  return runOnHomes(argc, argv, {{"gather", gatherHome}, {"rays", gatherByRays}});
}
