// Homes that benchmarks run on: glTF files of the folder ROOMLIGHT_SCENES, or of ../shared/scenes beside the sources.
#pragma once

#include <benchmark/benchmark.h>

#include <filesystem>
#include <functional>
#include <string>

#include "scene/scene.h"

namespace roomlight::bench {

struct Home {
  std::string name;
  std::filesystem::path file;
  Scene scene;
  Camera camera;
};

using HomeBenchmark = std::function<void(benchmark::State&, const Home&)>;

// Runs each named benchmark on every home, one home in memory at a time; without homes it says so and succeeds. Homes
// are lit by an even sky and a lamp of 1000 lm in the middle.
int runOnHomes(int argc, char** argv, const std::vector<std::pair<std::string, HomeBenchmark>>& benchmarks);

// Seconds of processor time of this process: ratios of it hold on a busy machine too.
double cpuSeconds();

}  // namespace roomlight::bench
