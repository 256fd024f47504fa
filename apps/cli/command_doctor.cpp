// roomlight doctor: what is there, what is missing for what, and whether known pictures come out right.
#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <memory>
#include <optional>
#include <sstream>

#include "arguments.h"
#include "base/parallel.h"
#include "base/platform/files.h"
#include "base/platform/system_facts.h"
#include "commands.h"
#include "console.h"
#include "engine/settings.h"
#include "import/child_process.h"
#include "output_files.h"
#include "processor.h"
#include "started_programs.h"
#include "trace/ray_library.h"
#include "validate/self_test.h"

namespace roomlight::cli {
namespace {

namespace fs = std::filesystem;

constexpr double kGib = 1 << 30;

struct DoctorOptions {
  bool json = false, quick = false;
  double tolerance = kSelfTestPercent;
};

// Something that was looked for.
struct Finding {
  std::string name;
  fs::path place;       // empty: missing
  std::string without;  // what is not possible then
};

fs::path onPath(const std::string& program) {
  const char* path = std::getenv("PATH");
  std::istringstream folders(path ? path : "");
  for (std::string folder; std::getline(folders, folder, ':');) {
    const fs::path file = fs::path(folder) / program;
    std::error_code code;
    if (!folder.empty() && fs::is_regular_file(file, code) && isExecutable(file)) return file;
  }
  return {};
}

fs::path orNothing(const fs::path& file) {
  std::error_code code;
  return fs::exists(file, code) ? file : fs::path();
}

fs::path page(const std::string& installed, const std::string& built) {
  const fs::path folder = pageFolder(installed, built);
  return orNothing(folder / "index.html").empty() ? fs::path() : folder;
}

std::vector<Finding> lookAround() {
  const char* zones = std::getenv("TZDIR");
  return {
      {"model reader", orNothing(importers::modelReader()), "FBX, COLLADA, 3D Studio, STL and PLY files do not open"},
      {"page of view", page("viewer", "dist"), "view has nothing to show in the browser"},
      {"page of bake", page("baked", "dist-baked"), "bake cannot write a home as one page"},
      {"plots", page("reports", "dist-reports"), "pages of optimise, study and validate have tables alone"},
      {"time zones", orNothing(fs::path(zones ? zones : "/usr/share/zoneinfo") / "Europe/Paris"),
       "hours of Sweet Home 3D's homes are taken as those of their longitude"},
      {"xdg-open", onPath("xdg-open"), "view prints its link instead of opening the browser"},
      {"ffmpeg", onPath("ffmpeg"), "films of walks stay single pictures"},
      {"Node.js", onPath("node"), "pages cannot be built from their sources"},
      {"Sweet Home 3D", onPath("sweethome3d"), "homes can be lit, but not drawn here"},
      {"Blender", onPath("blender"), ".blend files cannot be saved as .glb here"},
  };
}

// Of the machine, or of the container that this runs in where that has less.
std::optional<double> memoryGib() {
  std::optional<double> bytes = memoryBytes("MemTotal");
  const std::optional<double> limit = parseNumber<double>(systemValue("/sys/fs/cgroup/memory.max", ""));
  if (limit) bytes = std::min(bytes.value_or(kInfinity), *limit);
  return bytes ? std::optional(*bytes / kGib) : std::nullopt;
}

Json machineJson() {
  const std::string name = systemValue("/proc/cpuinfo", "model name");
  const std::optional<double> memory = memoryGib();
  std::optional<double> available = memoryBytes("MemAvailable");
  if (available) available = std::min(*available / kGib, memory.value_or(kInfinity));
  return {{"version", version()},
          {"builtFor", builtForProcessor()},
          {"processor", name.empty() ? Json() : Json(name)},
          {"processorLevel", processorLevel()},
          {"cores", threadCount()},
          {"memoryGiB", memory ? Json(*memory) : Json()},
          {"availableGiB", available ? Json(*available) : Json()},
          {"embree", rayLibraryVersion()}};
}

Json findingJson(const Finding& f) {
  if (f.place.empty()) return {{"name", f.name}, {"place", nullptr}, {"without", f.without}};
  return {{"name", f.name}, {"place", f.place.string()}};
}

Json testJson(const SelfTest& t) {
  return {{"technique", t.technique},
          {"expectedCdM2", t.expectedCdM2},
          {"meanCdM2", t.meanCdM2},
          {"errorPercent", t.errorPercent},
          {"pass", t.pass},
          {"seconds", t.seconds},
          {"samplesPerSecond", t.samplesPerSecond}};
}

void printMachine(const Json& j) {
  const auto line = [](const char* name, const std::string& value) { fmt::print("{:<16} {}\n", name, value); };
  const auto gib = [&](const char* key) {
    return j[key].is_null() ? "unknown" : fmt::format("{:.1f} GiB", j[key].get<double>());
  };
  line("roomlight", fmt::format("{}, for processors of level {}", j["version"].get<std::string>(),
                                j["builtFor"].get<std::string>()));
  line("processor",
       fmt::format("{}, level {}", j["processor"].is_null() ? "unknown" : j["processor"].get<std::string>(),
                   j["processorLevel"].get<std::string>()));
  line("cores", fmt::format("{}", j["cores"].get<int>()));
  line("memory", fmt::format("{}, {} free", gib("memoryGiB"), gib("availableGiB")));
  line("Embree", j["embree"].get<std::string>());
}

// Found first, so that what is missing stands together.
void printFindings(const std::vector<Finding>& findings) {
  for (const Finding& f : findings) {
    if (!f.place.empty()) fmt::print("{:<16} {}\n", f.name, f.place.string());
  }
  for (const Finding& f : findings) {
    if (f.place.empty()) fmt::print("{}: missing; {}\n", f.name, f.without);
  }
}

void printTest(const SelfTest& t) {
  fmt::print("{:<16} {}: {:.4f} cd/m2 where {:.4f} is right ({:+.2f} %); {:.1f} s, {:.2f} million samples a second{}\n",
             "self-test", t.technique, t.meanCdM2, t.expectedCdM2, t.errorPercent, t.seconds, t.samplesPerSecond / 1e6,
             t.pass ? "" : "  FAILED");
}

int runDoctor(const DoctorOptions& o) {
  interrupted();
  Json j = machineJson();
  const std::vector<Finding> findings = lookAround();
  for (const Finding& f : findings) j["findings"].push_back(findingJson(f));
  if (!o.json) printMachine(j), printFindings(findings);
  bool pass = true;
  for (const char* technique : {technique::kPath, technique::kHybrid}) {
    if (o.quick) break;
    Progress progress;
    progress.cancelled = &interrupted();
    const Result<SelfTest> test = selfTest(technique, o.tolerance, progress);
    if (!test) return failed(test.error(), kFailed);
    if (!test.value().complete) return failed("interrupted", interruptStatus());
    pass = pass && test.value().pass;
    j["selfTest"].push_back(testJson(test.value()));
    if (!o.json) printTest(test.value());
  }
  if (o.json) fmt::print("{}\n", j.dump(2, ' ', false, Json::error_handler_t::replace));
  if (!pass) printError("a known picture came out wrong; do not trust others from this machine");
  return pass ? kOk : kFailed;
}

}  // namespace

Registered addDoctor(CLI::App& program) {
  const auto o = std::make_shared<DoctorOptions>();
  CLI::App* app = program.add_subcommand("doctor", "Say what this machine has, what is missing for what, and test it");
  app->add_flag("--quick", o->quick, "Without the self-test, which takes some ten seconds");
  app->add_option("--tolerance", o->tolerance, "Per cent that a known picture's mean luminance may be off")
      ->capture_default_str()
      ->check(CLI::Range(0.0, 100.0));
  app->add_flag("--json", o->json, "Print JSON");
  app->footer("Exit status: 0 if known pictures come out right, else 1.\nExample:\n  roomlight doctor --quick");
  return {app, [o] { return runDoctor(*o); }};
}

}  // namespace roomlight::cli
