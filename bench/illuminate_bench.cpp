// Voxels + lights -> radiance field, at the size the settings choose.
#include "home.h"
#include "radiance/radiance_field.h"
#include "voxel/voxelise.h"

namespace roomlight::bench {
namespace {

void illuminateHome(benchmark::State& state, const Home& home) {
  const RayScene rays(home.scene);
  const Lights lights(home.scene);
  const Voxelisation v = voxelise(home.scene, {});
  RadianceField field;
  double traced = 0;
  for (auto _ : state) {
    field = illuminate(rays, lights, v.voxels, {});
    traced += static_cast<double>(field.rays);
  }
  state.counters["slots"] = static_cast<double>(v.voxels.slots.size());
  state.counters["bounces"] = field.bounces;
  state.counters["MraysPerS"] = benchmark::Counter(traced / 1e6, benchmark::Counter::kIsRate);
  state.counters["MiB"] = static_cast<double>(field.bytes()) / 1048576;
}

}  // namespace
}  // namespace roomlight::bench

int main(int argc, char** argv) { return roomlight::bench::runOnHomes(argc, argv, {{"illuminate", roomlight::bench::illuminateHome}}); }
