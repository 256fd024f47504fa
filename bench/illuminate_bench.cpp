// Voxels + lights -> radiance field, at the size the settings choose.
#include "home.h"
#include "radiance/light_cache.h"
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

// The lamp moves to and fro, or changes colour.
void relightHome(benchmark::State& state, const Home& home, bool moves) {
  Scene scene = home.scene;
  const RayScene rays(scene);
  const Voxelisation v = voxelise(scene, {});
  RadianceSettings settings;
  settings.pyramid = false;
  LightCache cache(rays, Lights(scene), v.voxels, settings);
  scene.lamps[0].intensityCd *= Vec3(1.2f, 1, 0.8f);
  float step = 0.15f;
  for (auto _ : state) {
    Lamp& lamp = scene.lamps[0];
    if (moves) {
      lamp.position += Vec3(step += 1e-4f, 0, 0), step = -step;
    } else {
      lamp.intensityCd = {lamp.intensityCd.y, lamp.intensityCd.z, lamp.intensityCd.x};
    }
    cache.relight(rays, Lights(scene), v.voxels);
  }
  state.counters["bounces"] = cache.field().bounces;
  state.counters["MiB"] = static_cast<double>(cache.bytes()) / 1048576;
}

}  // namespace
}  // namespace roomlight::bench

int main(int argc, char** argv) {
  using namespace roomlight::bench;
  return runOnHomes(
      argc, argv,
      {{"illuminate", illuminateHome},
       {"lampColoured", [](benchmark::State& state, const Home& home) { relightHome(state, home, false); }},
       {"lampMoved", [](benchmark::State& state, const Home& home) { relightHome(state, home, true); }}});
}
