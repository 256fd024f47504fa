// Radiance field -> picture of 480 x 270 pixels.
#include "gather/cone_gather.h"
#include "home.h"
#include "voxel/voxelise.h"

namespace roomlight::bench {
namespace {

void gatherHome(benchmark::State& state, const Home& home) {
  const RayScene rays(home.scene);
  const Lights lights(home.scene);
  const Voxelisation v = voxelise(home.scene, {});
  const RadianceField field = illuminate(rays, lights, v.voxels, {});
  GatherSettings settings;
  settings.width = 480, settings.height = 270;
  double traced = 0, cones = 0;
  for (auto _ : state) {
    const GatheredPicture result = gatherCones(rays, lights, v.voxels, field, home.camera, settings);
    traced += static_cast<double>(result.rays), cones += static_cast<double>(result.cones);
  }
  state.counters["MraysPerS"] = benchmark::Counter(traced / 1e6, benchmark::Counter::kIsRate);
  state.counters["MconesPerS"] = benchmark::Counter(cones / 1e6, benchmark::Counter::kIsRate);
}

}  // namespace
}  // namespace roomlight::bench

int main(int argc, char** argv) { return roomlight::bench::runOnHomes(argc, argv, {{"gather", roomlight::bench::gatherHome}}); }
