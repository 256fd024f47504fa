// File -> scene: parsing, decoding of textures, validation.
#include "home.h"
#include "import/import.h"

namespace roomlight::bench {
namespace {

void importHome(benchmark::State& state, const Home& home) {
  for (auto _ : state) benchmark::DoNotOptimize(importScene(home.file));
  state.counters["triangles"] = static_cast<double>(home.scene.triangleCount());
  state.counters["fileMiB"] = static_cast<double>(std::filesystem::file_size(home.file)) / 1048576;
}

}  // namespace
}  // namespace roomlight::bench

int main(int argc, char** argv) {
  return roomlight::bench::runOnHomes(argc, argv, {{"import", roomlight::bench::importHome}});
}
