#include "home.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <ctime>
#include <memory>

#include "import/import.h"

namespace roomlight::bench {
namespace {

std::vector<std::filesystem::path> homeFiles() {
  const char* given = std::getenv("ROOMLIGHT_SCENES");
  const std::filesystem::path folder = given ? given : ROOMLIGHT_SOURCE_DIR "/../shared/scenes";
  std::vector<std::filesystem::path> files;
  std::error_code ignored;
  for (const auto& entry : std::filesystem::directory_iterator(folder, ignored)) {
    const std::filesystem::path file = entry.path() / "scene.glb";
    if (std::filesystem::exists(file, ignored)) files.push_back(file);
  }
  std::sort(files.begin(), files.end());
  if (files.empty())
    fmt::print("no homes in {}: set ROOMLIGHT_SCENES to a folder of <name>/scene.glb\n", folder.string());
  return files;
}

void light(Scene& scene) {
  scene.lamps.clear();
  scene.suns.clear();
  scene.sky = {};
  scene.sky.luminanceCdM2 = Vec3(2000);
  Lamp lamp;
  lamp.position = scene.bounds().centre();
  lamp.intensityCd = Vec3(1000 / (4 * kPi));
  scene.lamps.push_back(lamp);
}

// The home asked for; the one before is freed.
const Home& openHome(const std::filesystem::path& file) {
  static std::unique_ptr<Home> current;
  if (current && current->file == file) return *current;
  current.reset();
  auto imported = importScene(file);
  if (!imported) {
    fmt::print("{}\n", imported.error());
    std::exit(1);
  }
  current = std::make_unique<Home>();
  current->name = file.parent_path().filename().string();
  current->file = file;
  current->scene = std::move(imported.value().scene);
  current->camera = defaultCamera(current->scene);
  light(current->scene);
  return *current;
}

}  // namespace

int runOnHomes(int argc, char** argv, const std::vector<std::pair<std::string, HomeBenchmark>>& benchmarks) {
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 1;
  const auto files = homeFiles();
  if (files.empty()) return 0;
  for (const auto& file : files) {
    for (const auto& [name, run] : benchmarks) {
      const std::string title = name + "/" + file.parent_path().filename().string();
      benchmark::RegisterBenchmark(title.c_str(), [file, run](benchmark::State& state) { run(state, openHome(file)); })
          ->Unit(benchmark::kMillisecond)
          ->UseRealTime()
          ->MeasureProcessCPUTime();  // of all threads: half of it is the time on two quiet cores
    }
  }
  benchmark::RunSpecifiedBenchmarks();
  benchmark::Shutdown();
  return 0;
}

double cpuSeconds() {
  timespec t{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

}  // namespace roomlight::bench
