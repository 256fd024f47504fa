// Scene -> voxels of 4 cm, from scratch and after one thing moved.
#include "home.h"
#include "voxel/voxelise.h"

namespace roomlight::bench {
namespace {

constexpr float kVoxelSizeM = 0.04f;

VoxelSettings settings() {
  VoxelSettings s;
  s.voxelSizeM = kVoxelSizeM;
  return s;
}

void count(benchmark::State& state, const Home& home, const Voxelisation& v) {
  state.counters["triangles"] = static_cast<double>(home.scene.triangleCount());
  state.counters["voxels"] = static_cast<double>(v.voxels.voxels.size());
  state.counters["MiB"] = static_cast<double>(v.voxels.bytes()) / 1048576;
}

void fromScratch(benchmark::State& state, const Home& home) {
  Voxelisation v;
  for (auto _ : state) v = voxelise(home.scene, settings());
  count(state, home, v);
}

// The instance whose triangles are the median in number goes a voxel to and fro.
void updateOne(benchmark::State& state, const Home& home) {
  Scene scene = home.scene;
  Voxelisation v = voxelise(scene, settings());
  std::vector<uint32_t> order;
  for (uint32_t i = 0; i < scene.instances.size(); ++i) order.push_back(i);
  const auto triangles = [&](uint32_t i) {
    return scene.meshes[static_cast<size_t>(scene.instances[i].mesh)].triangleCount();
  };
  std::sort(order.begin(), order.end(), [&](uint32_t a, uint32_t b) { return triangles(a) < triangles(b); });
  const uint32_t mover = order[order.size() / 2];
  float step = kVoxelSizeM;
  for (auto _ : state) {
    scene.instances[mover].worldFromObject.w.x += step;
    step = -step;
    update(v, scene, std::span(&mover, 1));
  }
  count(state, home, v);
  state.counters["moved"] = static_cast<double>(triangles(mover));
}

}  // namespace
}  // namespace roomlight::bench

int main(int argc, char** argv) {
  return roomlight::bench::runOnHomes(
      argc, argv, {{"voxelise", roomlight::bench::fromScratch}, {"update", roomlight::bench::updateOne}});
}
