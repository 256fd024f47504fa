// roomlight study: every technique on every scene and light, judged by path.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <memory>
#include <nlohmann/json.hpp>
#include <set>
#include <thread>

#include "arguments.h"
#include "base/image_io.h"
#include "base/platform/machine.h"
#include "base/platform/module.h"
#include "base/platform/system_facts.h"
#include "base/platform/terminal.h"
#include "base/write_file.h"
#include "commands.h"
#include "console.h"
#include "engine/settings.h"
#include "exit_status.h"
#include "output_files.h"
#include "started_programs.h"
#include "study/preparation.h"
#include "study/report.h"

namespace roomlight::cli {
namespace {

struct StudyOptions {
  std::string plan, folder, size = "640x360", walkSize = "960x540", only;
  std::vector<std::string> techniques, externals;
  int runs = 3, walkFrames = StudySettings().walkFrames;
  double mostSeconds = 60, referenceSeconds = 240;
  bool quick = false, quiet = false, reportOnly = false;
};

constexpr int kLeastPixels = 16, kMostPixels = 16384;

Status readSize(const std::string& option, const std::string& text, int& width, int& height) {
  const Result<Size> size = parseSize(option, text);
  if (!size) return Error{size.error()};
  width = size.value().width, height = size.value().height;
  if (std::min(width, height) < kLeastPixels || std::max(width, height) > kMostPixels)
    return Error{fmt::format("{} {}: from {} to {} pixels either way", option, text, kLeastPixels, kMostPixels)};
  return Ok{};
}

// NAME=picture.exr,SECONDS or NAME@SCENE/LIGHT=picture.exr,SECONDS.
Result<ExternalPicture> readExternal(const std::string& text) {
  const size_t equals = text.find('='), comma = text.rfind(',');
  const auto seconds =
      comma == std::string::npos ? std::nullopt : parseNumber<double>(std::string_view(text).substr(comma + 1));
  if (equals == std::string::npos || equals == 0 || comma == std::string::npos || comma < equals + 2 || !seconds ||
      !(*seconds > 0) || !std::isfinite(*seconds)) {
    return Error{
        fmt::format("--external {}: write NAME=picture.exr,SECONDS or NAME@SCENE/LIGHT=picture.exr,SECONDS", text)};
  }
  ExternalPicture e{text.substr(0, equals), {}, {}, text.substr(equals + 1, comma - equals - 1), *seconds};
  if (const size_t at = e.name.find('@'); at != std::string::npos) {
    const std::string where = e.name.substr(at + 1);
    const size_t slash = where.rfind('/');
    e.scene = where.substr(0, slash);
    if (slash != std::string::npos) e.light = where.substr(slash + 1);
    e.name.resize(at);
  }
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(e.file, ignored))
    return Error{fmt::format("--external {}: {}: no such file", e.name, e.file.string())};
  return e;
}

// What --only leaves of the plan: the view or walk of this name; where none is, all whose name holds the text, and
// walks of their scenes.
Status narrowToOnly(const std::string& only, StudyPlan& plan) {
  const std::vector<std::string> names = partsOf(plan);
  const bool isName = std::find(names.begin(), names.end(), only) != names.end();
  const auto isMeant = [&](const std::string& name) {
    return isName ? name == only : name.find(only) != std::string::npos;
  };
  for (StudyScene& s : plan.scenes) {
    std::erase_if(s.lights, [&](const StudyLight& light) { return !isMeant(viewName(s, light)); });
    if (!isMeant(walkName(s)) && (isName || s.lights.empty())) s.walk.clear();
  }
  std::erase_if(plan.scenes, [](const StudyScene& s) { return s.lights.empty() && s.walk.empty(); });
  if (plan.scenes.empty()) return Error{fmt::format("--only {}: no SCENE/LIGHT holds this", only)};
  return Ok{};
}

// What is left of the plan after --technique, --only and --quick.
Status narrow(const StudyOptions& o, StudyPlan& plan) {
  if (!o.techniques.empty()) {
    std::vector<StudyTechnique> kept;
    for (const std::string& wanted : o.techniques) {
      const auto found = std::find_if(plan.techniques.begin(), plan.techniques.end(),
                                      [&](const StudyTechnique& t) { return t.name == wanted; });
      std::string names;
      for (const StudyTechnique& t : plan.techniques) names += fmt::format("{}'{}'", names.empty() ? "" : ", ", t.name);
      if (found == plan.techniques.end()) return Error{fmt::format("--technique {}: there are {}", wanted, names)};
      kept.push_back(*found);
    }
    plan.techniques = kept;
  }
  if (const Status s = narrowToOnly(o.only, plan); !s) return s;
  if (!o.quick || o.reportOnly) return Ok{};  // reports tell of all that was measured
  plan.scenes.resize(std::min<size_t>(plan.scenes.size(), 2));
  for (StudyScene& s : plan.scenes) s.lights.resize(std::min<size_t>(s.lights.size(), 1));
  for (size_t i = 1; i < plan.scenes.size(); ++i) plan.scenes[i].walk.clear();
  return Ok{};
}

Result<StudySettings> settingsOf(const StudyOptions& o) {
  StudySettings s;
  s.runs = o.runs, s.mostSeconds = o.mostSeconds, s.walkFrames = o.walkFrames;
  s.reference.mostS = o.referenceSeconds;
  s.reference.roundS = std::clamp(s.reference.mostS / 8, 0.5, 30.0);
  if (const Status status = readSize("--size", o.size, s.width, s.height); !status) return Error{status.error()};
  if (const Status status = readSize("--walk-size", o.walkSize, s.walkWidth, s.walkHeight); !status)
    return Error{status.error()};
  for (const std::string& text : o.externals) {
    const Result<ExternalPicture> e = readExternal(text);
    if (!e) return Error{e.error()};
    s.externals.push_back(e.value());
  }
  const std::string processor = systemValue("/proc/cpuinfo", "model name");
  s.program = fmt::format("roomlight {} {}, {} threads of {}", version(), buildId(),
                          std::thread::hardware_concurrency(), processor.empty() ? "unknown" : processor);
  return s;
}

StudyHeader headerOf(const StudySettings& s, const StudyPlan& plan, double loadBefore) {
  const double memoryMiB = installedMemoryBytes() / 1048576;
  StudyHeader h;
  h.about = {{"program", s.program},
             {"memory", fmt::format("{:.1f} GiB", memoryMiB / 1024)},
             {"load of the machine at the start", fmt::format("{:.2f}", loadBefore)},
             {"pictures", fmt::format("{}x{}", s.width, s.height)},
             {"runs", fmt::format("{}", s.runs)},
             {"longest point", fmt::format("{:g} s", s.mostSeconds)},
             {"references", fmt::format("until a noise of {:g} or {:g} s", s.reference.noiseMse, s.reference.mostS)},
             {"frames", fmt::format("{} of {}x{}, one sample a pixel", s.walkFrames, s.walkWidth, s.walkHeight)}};
  for (const StudyTechnique& t : plan.techniques)
    h.techniques.emplace_back(t.name, fmt::format("technique {}, settings {}", t.technique, t.settings));
  return h;
}

// Each render and walk in a process of its own.
class Programs {
 public:
  Programs(std::filesystem::path folder, int walkFrames) : folder_(std::move(folder)), walkFrames_(walkFrames) {}

  Result<RenderCost> render(const StudyRender& r) const {
    std::vector<std::string> words = {"render",      r.scene.string(),
                                      "--size",      fmt::format("{}x{}", r.width, r.height),
                                      "--technique", r.technique,
                                      "--samples",   fmt::format("{}", r.samples),
                                      "--seed",      fmt::format("{}", r.seed),
                                      "-o",          r.picture.string()};
    if (r.timeLimitS > 0) words.insert(words.end(), {"--time-limit", fmt::format("{}", r.timeLimitS)});
    if (!r.camera.empty()) words.insert(words.end(), {"--camera", r.camera});
    const Result<nlohmann::json> stats = run(words, r.lighting, r.settings);
    if (!stats) return Error{stats.error()};
    RenderCost cost;
    for (const nlohmann::json& s : stats.value()["stages"]) {
      const std::string name = s["name"];
      if (name == "write") continue;
      cost.memoryMiB = std::max(cost.memoryMiB, s["peakMemoryMiB"].get<double>());
      if (name == "load") continue;
      cost.stages.emplace_back(name, s["timeMs"].get<double>() / 1e3);
      cost.seconds += s["timeMs"].get<double>() / 1e3, cost.processorSeconds += s["cpuMs"].get<double>() / 1e3;
    }
    cost.samples = stats.value()["numbers"].value("samples", 0.0);
    return cost;
  }

  Result<WalkCost> walk(const StudyWalk& w) const {
    const std::vector<std::string> words = {"walk",        w.scene.string(),
                                            "--walk",      w.walk.string(),
                                            "--size",      fmt::format("{}x{}", w.width, w.height),
                                            "--technique", w.technique,
                                            "--samples",   "1",
                                            "--frames",    fmt::format("{}", walkFrames_),
                                            "--in-a-row"};
    const Result<nlohmann::json> stats = run(words, w.lighting, w.settings);
    if (!stats) return Error{stats.error()};
    const nlohmann::json& j = stats.value();
    return WalkCost{static_cast<int>(j["frames"].size()), j["framesPerSecond"].get<double>(),
                    medianOfFrames(j["frames"], "updateMs"), medianOfFrames(j["frames"], "pictureMs")};
  }

 private:
  // Without the first where there are more, as framesPerSecond is.
  static double medianOfFrames(const nlohmann::json& frames, const char* key) {
    std::vector<double> values;
    for (size_t i = frames.size() > 1 ? 1 : 0; i < frames.size(); ++i) values.push_back(frames[i][key].get<double>());
    return medianOf(std::move(values));
  }
  Result<nlohmann::json> run(std::vector<std::string> words, const std::filesystem::path& lighting,
                             const std::string& settings) const {
    const std::filesystem::path settingsFile = folder_ / "settings.json", stats = folder_ / "stats.json";
    std::error_code ignored;
    std::filesystem::remove(stats, ignored);
    if (const Status s = writeWhole(settingsFile, settings); !s) return Error{s.error()};
    if (!lighting.empty()) words.insert(words.end(), {"--lighting", lighting.string()});
    // The study's own reading of a file: in its own unit, with the light that it holds.
    words.insert(words.end(), {"--light", "file", "--metres-per-unit", "1"});
    words.insert(words.end(), {"--settings", settingsFile.string(), "--stats", stats.string(), "--quiet"});
    if (const Status s = runThisProgram(words, interrupted()); !s) return Error{s.error()};
    const Result<std::string> text = readTextFile(stats);
    if (!text) return Error{text.error()};
    nlohmann::json read = nlohmann::json::parse(text.value(), nullptr, false);
    if (!read.is_object()) return Error{fmt::format("{}: is not what was expected", stats.string())};
    return read;
  }

  std::filesystem::path folder_;
  int walkFrames_;
};

// What measured all that is in the folder, where nothing more is measured; else this program on this machine, which is
// kept.
Status knowMachine(const RunStore& store, bool reportOnly, StudySettings& settings) {
  const RunStore::Key key{{"machine"}, ""};
  if (!reportOnly) return store.keep(key, {{"program", settings.program}});
  const auto kept = store.find(key);
  if (!kept || !kept->contains("program") || !(*kept)["program"].is_string())
    return Error{fmt::format("{}: holds nothing that was measured", store.folder().string())};
  settings.program = (*kept)["program"].get<std::string>();
  return Ok{};
}

StudyTools toolsOf(const Programs& programs, bool reportOnly) {
  if (!reportOnly) {
    return {[&](const StudyRender& r) { return programs.render(r); },
            [&](const StudyWalk& w) { return programs.walk(w); }};
  }
  const Error missing{"was not measured"};
  return {[missing](const StudyRender&) { return Result<RenderCost>(missing); },
          [missing](const StudyWalk&) { return Result<WalkCost>(missing); }};
}

// One line that says how far it is, on a terminal over the last one.
class Line {
 public:
  explicit Line(bool quiet) : quiet_(quiet), terminal_(isErrorOutputTerminal()) {}
  ~Line() {
    if (terminal_ && !quiet_ && !last_.empty()) fmt::print(stderr, "\n");
  }
  void show(const std::string& now, double done, double left) {
    if (quiet_ || (now == last_ && !terminal_)) return;
    last_ = now;
    const std::string time = left < 0    ? ""
                             : left < 90 ? fmt::format(", {:.0f} s left", left)
                                         : fmt::format(", {:.0f} min left", left / 60);
    fmt::print(stderr, "{}{:3.0f} %{}  {}{}", terminal_ ? "\r\x1b[K" : "", 100 * done, time, now,
               terminal_ ? "" : "\n");
    std::fflush(stderr);
  }

 private:
  bool quiet_, terminal_;
  std::string last_;
};

// `plots`: as of studyHtml().
Status writeStudyReports(const std::filesystem::path& folder, const StudyHeader& header, const StudyResults& results,
                         const std::string& plots) {
  const Result<std::string> html = studyHtml(header, results, folder / "runs", plots);
  if (!html) return Error{html.error()};
  if (const Status s = writeWhole(folder / "study.html", html.value()); !s) return s;
  if (const Status s = writeWhole(folder / "study.csv", studyCsv(results)); !s) return s;
  if (const Status s = writeWhole(folder / "study.md", studyMarkdown(header, results)); !s) return s;
  return writeWhole(folder / "study.json", studyJson(header, results));
}

// What --quick stands for, where nothing else is asked for.
void makeQuick(StudyOptions& o, const CLI::App& app) {
  const auto otherwise = [&](const char* option, auto& value, auto quick) {
    if (app.count(option) == 0) value = quick;
  };
  otherwise("--size", o.size, "192x108"), otherwise("--walk-size", o.walkSize, "320x180");
  otherwise("--runs", o.runs, 1), otherwise("--walk-frames", o.walkFrames, 3);
  otherwise("--most-seconds", o.mostSeconds, 2.0), otherwise("--reference-seconds", o.referenceSeconds, 16.0);
}

// Each must be of one of the plan's views, of the study's size and of finite values, before hours are spent.
Status checkExternals(const StudyPlan& plan, const StudySettings& settings) {
  size_t views = 0;
  for (const StudyScene& s : plan.scenes) views += s.lights.size();
  std::set<std::string> taken;
  for (const StudyTechnique& t : plan.techniques) taken.insert(t.name);
  for (const ExternalPicture& e : settings.externals) {
    std::string view;
    size_t meant = 0;
    for (const StudyScene& s : plan.scenes) {
      for (const StudyLight& light : s.lights) {
        if ((e.scene.empty() || e.scene == s.name) && (e.light.empty() || e.light == light.name))
          ++meant, view = s.name + "/" + light.name;
      }
    }
    if (meant != 1)
      return Error{fmt::format("--external {}: is of {} of the study's {} views; write NAME@SCENE/LIGHT=...", e.name,
                               meant, views)};
    if (taken.contains(e.name) || !taken.insert(e.name + "@" + view).second)
      return Error{fmt::format("--external {}: the name is taken in {}", e.name, view)};
    const Result<Image> image = readImage(e.file);
    if (!image) return Error{image.error()};
    if (image.value().width != settings.width || image.value().height != settings.height) {
      return Error{fmt::format("--external {}: is {}x{}, the study {}x{}; give --size", e.name, image.value().width,
                               image.value().height, settings.width, settings.height)};
    }
    const std::vector<Vec3>& pixels = image.value().pixels;
    if (!std::all_of(pixels.begin(), pixels.end(), [](Vec3 p) { return isFinite(p); }))
      return Error{fmt::format("--external {}: {}: holds values that are not finite", e.name, e.file.string())};
  }
  return Ok{};
}

std::string whyNothing(const StudyResults& results) {
  return results.remarks.empty() ? "the plan has no picture and no walk for its techniques" : results.remarks.front();
}

int runStudyCommand(StudyOptions o, const CLI::App& app) {
  interrupted();
  if (o.quick) makeQuick(o, app);
  Result<StudyPlan> plan = readStudyFile(o.plan);
  if (!plan) return failed(plan.error());
  for (const char* out : {"study.html", "study.json", "study.csv", "study.md"}) {
    if (const Status s = checkDistinct({o.plan, (std::filesystem::path(o.folder) / out).string()}); !s)
      return failed(s.error());
  }
  if (const Status s = narrow(o, plan.value()); !s) return failed(s.error());
  Result<StudySettings> settings = settingsOf(o);
  if (!settings) return failed(settings.error());
  if (const Status s = checkExternals(plan.value(), settings.value()); !s) return failed(s.error());
  const double load = machineLoad();
  if (load > 0.7 && !o.quiet && !o.reportOnly)
    printWarnings({fmt::format("the machine is busy (load {:.1f}): times will be longer than they need be", load)});

  const std::filesystem::path folder = o.folder;
  const Result<RunStore> store = RunStore::open(folder / "runs");
  if (!store) return failed(store.error(), kFailed);
  if (const Status s = knowMachine(store.value(), o.reportOnly, settings.value()); !s) return failed(s.error());
  if (const Status s = writeDimLamps(plan.value(), store.value()); !s) return failed(s.error());
  if (const Status s = checkWalks(plan.value(), store.value(), settings.value().program); !s) return failed(s.error());
  const StudyHeader header = headerOf(settings.value(), plan.value(), load);
  const Programs programs(store.value().folder(), settings.value().walkFrames);
  const StudyTools tools = toolsOf(programs, o.reportOnly);
  const std::string plots = reportPlots();
  Status written = Ok{};
  Result<StudyResults> results = Error{""};
  {
    Line line(o.quiet);
    const StudyProgress progress{[&](const std::string& now, double done, double left) { line.show(now, done, left); },
                                 &interrupted()};
    results = runStudy(plan.value(), settings.value(), store.value(), tools, progress, [&](const StudyResults& soFar) {
      if (written && !(o.reportOnly && nothingMeasured(soFar)))
        written = writeStudyReports(folder, header, soFar, plots);
    });
  }
  if (!results) return failed(results.error(), kFailed);
  if (!written) return failed(written.error(), kFailed);
  for (const StudyVerdict& v : studyVerdicts(results.value())) {
    if (!o.quiet) fmt::print("{:<7} {}: {}\n", v.met ? "met" : "missed", v.asked, v.measured);
  }
  if (!o.quiet) fmt::print("wrote {}\n", (folder / "study.html").string());
  if (!results.value().complete)
    return failed("interrupted; started again with the same folder, the study goes on", kInterrupted);
  if (nothingMeasured(results.value()))
    return failed("nothing could be measured: " + whyNothing(results.value()), kFailed);
  return kOk;
}

}  // namespace

Registered addStudy(CLI::App& program) {
  const auto o = std::make_shared<StudyOptions>();
  CLI::App* app = program.add_subcommand(
      "study", "Compare techniques: error, time, frames a second and memory, on scenes in several lights");
  app->add_option("PLAN", o->plan, "Study file: scenes, lights, walks, techniques (docs/reference/study.md)")
      ->required();
  app->add_option(
         "-o,--output", o->folder,
         "Folder for study.html, .json, .csv, .md and all pictures; what it holds of the same is not measured again")
      ->required();
  app->add_option("--technique", o->techniques, "Only this one of the plan's, by its name; may be repeated")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  app->add_option("--only", o->only,
                  "Only the view SCENE/LIGHT or the walk SCENE/walk of this name; else views whose names hold this "
                  "text, and walks of their scenes");
  app->add_option("--runs", o->runs, "Runs of every picture, in turn with the others; the median time counts")
      ->capture_default_str()
      ->check(CLI::Range(1, 100));
  app->add_option("--size", o->size, "Of pictures")->capture_default_str();
  app->add_option("--walk-size", o->walkSize, "Of frames")->capture_default_str();
  app->add_option("--walk-frames", o->walkFrames, "Of every walk: the first of them")
      ->capture_default_str()
      ->check(CLI::Range(1, 1000000));
  app->add_option("--most-seconds", o->mostSeconds, "A picture that would take longer ends the curve")
      ->capture_default_str()
      ->check(CLI::Range(0.1, 1e6));
  app->add_option("--reference-seconds", o->referenceSeconds, "For the references of one view, at most")
      ->capture_default_str()
      ->check(CLI::Range(1.0, 1e6));
  app->add_option("--external", o->externals,
                  "NAME=picture.exr,SECONDS of another renderer, linear and of the same view and size; "
                  "NAME@SCENE/LIGHT=... where there are several; may be repeated")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  app->add_flag("--quick", o->quick, "Two scenes in their first light, small: whether all works, in minutes");
  app->add_flag("--report-only", o->reportOnly, "Measure nothing: write the reports of what the folder holds");
  app->add_flag("--quiet", o->quiet, "Only errors");
  app->footer(
      "Ctrl-C stops; the same command goes on where it was.\n"
      "Example:\n"
      "  roomlight study homes.json -o out/study --runs 3");
  return {app, [o, app] { return runStudyCommand(*o, *app); }};
}

}  // namespace roomlight::cli
