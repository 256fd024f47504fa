// roomlight optimise: goals in, lighting designs on the best trade-offs out.
#include <fmt/format.h>
#include <unistd.h>

#include <memory>

#include "arguments.h"
#include "base/parallel.h"
#include "commands.h"
#include "console.h"
#include "engine/lit_scene.h"
#include "engine/quality.h"
#include "engine/version.h"
#include "import/import.h"
#include "interrupt.h"
#include "optimise/relaxation.h"
#include "optimise/report.h"
#include "optimise/store.h"
#include "optimise/timing.h"
#include "output_files.h"
#include "scene/find_camera.h"
#include "search/search.h"

namespace roomlight::cli {
namespace {

using namespace optimise;

struct Options {
  std::string home, study, folder, method = "hybrid", quality, seed;
  std::vector<std::string> baselines;
  std::optional<int> threads, evaluations, certify;
  double seconds = 0;
  bool quiet = false;
};

constexpr double kKeepEveryS = 10;    // the state of the search
constexpr size_t kTracePoints = 200;  // of the hypervolume over a search
constexpr double kTraceS = 2, kTraceShare = 0.05;  // what the trace may take: so long, and so much of the search's time
constexpr size_t kRelaxedShare = 5;   // hybrid: of the first generation, one in so many
constexpr double kPolishShare = 0.25; // hybrid: of all evaluations; linear programs are dear beside evaluations of designs

int bad(const std::string& message, int code = kBadInput) {
  printError(message);
  return code;
}

// The hypervolume over a search, now and then.
class Trace {
 public:
  explicit Trace(const Model& model) : model_(model) {}
  // `last`: in any case.
  void see(const search::State& s, bool last) {
    if (!points_.empty() && s.evaluations == points_.back().evaluations) return;
    const bool due = points_.empty() || search::fractionDone(s) >= done_ + 1.0 / kTracePoints;
    if (!last && (!due || takenS_ > kTraceS + kTraceShare * s.seconds)) return;
    const Stopwatch watch;
    done_ = search::fractionDone(s);
    points_.push_back({s.evaluations, s.seconds, hypervolumeOf(model_, s.archive)});
    takenS_ += watch.seconds();
  }
  double hypervolume() const { return points_.empty() ? 0 : points_.back().hypervolume; }
  const std::vector<TracePoint>& points() const { return points_; }

 private:
  const Model& model_;
  std::vector<TracePoint> points_;
  double done_ = 0, takenS_ = 0;
};

// One line that says how far the search is, on a terminal over the last one; elsewhere now and then.
class SearchLine {
 public:
  explicit SearchLine(bool quiet) : quiet_(quiet), terminal_(isatty(STDERR_FILENO) != 0) {}
  ~SearchLine() {
    if (terminal_ && shown_) fmt::print(stderr, "\n");
  }
  void show(const std::string& method, const search::State& s, double hypervolume, bool last) {
    if (quiet_ || (!last && watch_.seconds() - at_ < (terminal_ ? 0.3 : 10) && shown_)) return;
    at_ = watch_.seconds(), shown_ = true;
    fmt::print(stderr, "{}{}: {:3.0f} %  {} evaluations, {} designs on the front, hypervolume {:.4f}{}{}", terminal_ ? "\r\x1b[K" : "", method, 100 * search::fractionDone(s), s.evaluations, s.archive.size(),
               hypervolume, last ? "" : fmt::format(", {:.0f} s left", search::secondsLeft(s)), terminal_ ? "" : "\n");
    std::fflush(stderr);
  }

 private:
  bool quiet_, terminal_, shown_ = false;
  Stopwatch watch_;
  double at_ = 0;
};

struct Work {
  Options options;
  std::filesystem::path folder;
  RenderSettings render;
  Scene home;
  StudyFile study;
  Candidates candidates;
  Meters meters;
  Response response;
  Model model;
  std::vector<Camera> cameras;
  std::string hash;
};

Status readInputs(Work& w) {
  Result<Imported> imported = importScene(w.options.home);
  if (!imported) return Error{imported.error()};
  w.home = std::move(imported.value().scene);
  Result<StudyFile> study = readStudy(w.options.study, w.home.rooms);
  if (!study) return Error{study.error()};
  w.study = std::move(study.value());
  for (const std::string& name : w.study.cameras) {
    const Result<Camera> camera = findCamera(w.home, name);
    if (!camera) return Error{fmt::format("{}: cameras: {}", w.options.study, camera.error())};
    w.cameras.push_back(camera.value());
  }
  if (w.cameras.empty()) w.cameras.push_back(defaultCamera(w.home));
  const ResponseSettings response{};
  const std::string settings = fmt::format("{} {} {} {} {} {}", version(), settingsToJson(w.render), response.tolerance, response.fewestSamples, response.mostSamples, response.atOnce);
  w.hash = inputHash(w.options.home, w.study, settings + hashOfScene(w.home));
  return checkConditions(w.home, w.study);
}

// From the folder, where it is of the same inputs.
Status respond(Work& w, Stages& stages, ProgressDisplay& display) {
  {
    const RayScene rays = stages.run("bvh", [&](const Progress&) { return RayScene(w.home); });
    Result<Candidates> candidates = findCandidates(w.study, rays);
    if (!candidates) return Error{candidates.error()};
    w.candidates = std::move(candidates.value());
    Result<Meters> meters = placeMeters(w.study, rays);
    if (!meters) return Error{meters.error()};
    w.meters = std::move(meters.value());
  }
  display.line(fmt::format("{} places, {} candidate lamps, {} points, {} eyes", w.candidates.places.size(), w.candidates.candidates.size(), w.meters.points(), w.study.eyes.size()));
  const std::filesystem::path file = w.folder / "response.bin";
  if (auto known = optimise::findResponse(file, w.hash, {w.candidates.candidates.size(), w.meters.elements.size(), w.study.eyes.size(), w.study.conditions.size()})) {
    display.line("the response of all candidates is known from before");
    w.response = std::move(*known);
  } else {
    ResponseSettings settings;
    settings.render = w.render;
    Result<std::optional<Response>> found = findResponse(w.home, w.study, w.candidates, w.meters, settings, stages);
    if (!found) return Error{found.error()};
    if (!found.value()) return Ok{};
    w.response = std::move(*found.value());
    display.line(fmt::format("response of {} candidates at {} points in {:.1f} s, conditions without them in {:.1f} s", w.candidates.candidates.size(), w.meters.points(), w.response.seconds, w.response.baseSeconds));
    if (const Status s = keepResponse(file, w.hash, w.response); !s) printWarnings({s.error()});
  }
  w.model = makeModel(w.study, w.candidates, w.meters, w.response);
  return Ok{};
}

search::Settings settingsOf(const Work& w, search::Method method) {
  search::Settings s;
  s.method = method, s.seed = w.study.seed, s.evaluations = w.study.evaluations, s.population = w.study.population, s.seconds = w.options.seconds;
  s.polishShare = kPolishShare;
  return s;
}

// The hybrid begins with what linear programs over all lamps at once say, and pays for it.
search::State startSearch(const Work& w, const search::Problem& problem, const search::Settings& settings) {
  if (settings.method != search::Method::hybrid) return search::start(problem, settings);
  const Stopwatch watch;
  const RelaxedDesigns relaxed = relaxedDesigns(w.model, settings.population / kRelaxedShare);
  const double seconds = watch.seconds();
  search::State state = search::start(problem, settings, relaxed.designs);
  state.evaluations += relaxed.evaluations, state.seconds += seconds;
  return state;
}

// One that was kept is no use where it has gone beyond a smaller budget: the same seed gives the same front.
bool isWithin(const search::State& known, const search::Settings& settings) { return known.evaluations <= settings.evaluations || known.settings.evaluations == settings.evaluations; }

// Goes on where a run of the same inputs and settings was stopped. What cannot be kept is a warning.
Result<search::State> searchBy(const Work& w, const search::Problem& problem, search::Method method, Trace& trace) {
  const search::Settings settings = settingsOf(w, method);
  if (const Status s = search::check(problem, settings); !s) return Error{s.error()};
  const std::filesystem::path file = w.folder / fmt::format("search_{}.json", search::nameOf(method));
  const std::string hash = hashOf(w.hash + fmt::format(" {} {} {}", search::nameOf(method), settings.seed, settings.population));
  search::State state;
  if (auto known = findSearch(file, hash, problem); known && isWithin(*known, settings)) {
    state = std::move(*known);
    state.settings.evaluations = settings.evaluations, state.settings.seconds = settings.seconds;
  } else {
    state = startSearch(w, problem, settings);
  }
  SearchLine line(w.options.quiet);
  const Stopwatch watch;
  double kept = 0;
  Status written = Ok{};
  search::run(problem, state, {{}, &interrupted()}, [&](const search::State& s) {
    trace.see(s, false);
    line.show(search::nameOf(method), s, trace.hypervolume(), false);
    if (watch.seconds() - kept < kKeepEveryS || !written) return;
    kept = watch.seconds();
    written = keepSearch(file, hash, s);
  });
  trace.see(state, true);
  line.show(search::nameOf(method), state, trace.hypervolume(), true);
  if (written) written = keepSearch(file, hash, state);
  if (!written) printWarnings({written.error()});
  return state;
}

// Lighting files of an earlier run would look like designs of this one: "design_" and a number.
void removeOldDesigns(const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> old;
  std::error_code ignored;
  for (const auto& entry : std::filesystem::directory_iterator(folder, ignored)) {
    const std::string name = entry.path().filename().string(), begin = "design_";
    if (name.starts_with(begin) && name.ends_with(".json") && name.find_first_of("0123456789") == begin.size()) old.push_back(entry.path());
  }
  for (const std::filesystem::path& file : old) std::filesystem::remove(file, ignored);
}

Status writeDesign(const Work& w, search::ConstGenome design, size_t number, Proposed& out) {
  const std::vector<std::string> names = fileNamesOf(w.study.conditions);
  for (size_t c = 0; c < names.size(); ++c) {
    const Result<std::string> text = lightingFileOf(w.study, lampsOf(w.study, w.candidates, w.model, design, c), w.study.conditions[c].daylight);
    if (!text) return Error{text.error()};
    out.lightingFiles.push_back(names.size() == 1 ? fmt::format("design_{}.json", number) : fmt::format("design_{}_{}.json", number, names[c]));
    if (const Status s = writeTextFile(w.folder / out.lightingFiles.back(), text.value()); !s) return s;
  }
  return Ok{};
}

Status writeDesigns(const Work& w, Report& report) {
  removeOldDesigns(w.folder);
  for (const size_t index : spreadOf(w.model, report.front, static_cast<size_t>(std::max(w.study.certified, 8)))) {
    const size_t number = report.designs.size() + 1;
    const search::ConstGenome design = std::as_const(report.front.designs)[index];
    Proposed d{index, fmt::format("design {}", number), billOf(w.study, w.candidates, w.model, design), resultOf(w.model, design), {}, {}};
    if (const Status s = writeDesign(w, design, number, d); !s) return s;
    report.designs.push_back(std::move(d));
  }
  return Ok{};
}

Status certifyAll(const Work& w, const search::Archive& front, Report& report, Stages& stages, ProgressDisplay& display) {
  for (size_t i = 0; i < report.designs.size() && !interrupted(); ++i) {
    Proposed& d = report.designs[i];
    if (static_cast<int>(i) >= w.study.certified) break;
    Result<std::optional<Certificate>> c = certify(w.home, w.study, w.candidates, w.meters, w.model, front.designs[d.index], w.cameras, w.render, stages);
    if (!c) return Error{c.error()};
    d.certificate = std::move(c.value());
    if (!d.certificate) break;
    std::string differences;
    for (size_t k = 0; k < w.study.conditions.size(); ++k) {
      const Certificate::OfCondition& r = d.certificate->conditions[k];
      differences += fmt::format("{}{}: {} points, mean {:.2f} %, {}", k ? "; " : "", w.study.conditions[k].name, r.judged, r.meanPercent, largestDifference(r));
    }
    display.line(fmt::format("{} certified in {:.1f} s: prediction against full solution {}", d.name, d.certificate->seconds, differences));
  }
  return Ok{};
}

Status writeReports(const Work& w, const Report& report) {
  const Result<std::string> html = reportHtml(report, w.home);
  if (!html) return Error{html.error()};
  if (const Status s = writeTextFile(w.folder / "index.html", html.value()); !s) return s;
  if (const Status s = writeTextFile(w.folder / "run.json", runJson(report)); !s) return s;
  if (const Status s = writeTextFile(w.folder / "points.csv", pointsCsv(report)); !s) return s;
  return writeTextFile(w.folder / "front.csv", frontCsv(report));
}

void printFront(const Work& w, const Report& report) {
  fmt::print("{:<10}", "design");
  for (const Objective o : w.model.objectives) fmt::print("{:>22}", fmt::format("{} {}", infoOf(o).name, o == Objective::Cost ? w.study.catalogue.currency : infoOf(o).unit));
  fmt::print("{:>10}{:>8}\n", "fittings", "W");
  for (const Proposed& d : report.designs) {
    fmt::print("{:<10}", d.name);
    for (const Objective o : w.model.objectives) fmt::print("{:>22.4g}", d.result.of(o));
    fmt::print("{:>10}{:>8.4g}\n", d.result.fittings, d.result.installedW);
  }
}

// What the command line says instead of the study.
Status applyOptions(Work& w) {
  if (w.options.evaluations) w.study.evaluations = static_cast<size_t>(*w.options.evaluations);
  if (w.options.certify) w.study.certified = *w.options.certify;
  if (w.options.seed.empty()) return Ok{};
  const auto seed = parseNumber<uint64_t>(w.options.seed);
  if (!seed) return Error{fmt::format("--seed {}: write a whole number from 0 to 18446744073709551615", w.options.seed)};
  w.study.seed = *seed;
  return Ok{};
}

// The method asked for, then baselines; stopped, those so far. The front is the first's.
Status searchAll(const Work& w, const search::Problem& problem, Report& report) {
  std::vector<std::string> names = {w.options.method};
  names.insert(names.end(), w.options.baselines.begin(), w.options.baselines.end());
  for (size_t i = 0; i < names.size() && !interrupted(); ++i) {
    const Result<search::Method> method = search::methodNamed(names[i]);
    if (!method) return Error{method.error()};
    Trace trace(w.model);
    Result<search::State> state = searchBy(w, problem, method.value(), trace);
    if (!state) return Error{state.error()};
    report.methods.push_back({names[i], state.value().evaluations, state.value().polished, state.value().seconds, trace.hypervolume(), trace.points()});
    if (i == 0) report.front = std::move(state.value().archive);
  }
  return Ok{};
}

int work(Work& w) {
  ProgressDisplay display(w.options.quiet);
  const RenderProgress progress{[&](const std::string& stage, float f) { display.report(stage, f); }, &interrupted(), {}};
  RenderStats stats;
  Stages stages(progress, stats);
  const auto stopped = [] { return bad("interrupted; started again with the same folder, it goes on", kInterrupted); };
  const Status read = stages.run("load", [&](const Progress&) { return readInputs(w); });
  if (!read) return bad(read.error());
  if (const Status s = applyOptions(w); !s) return bad(s.error());
  if (interrupted()) return stopped();
  if (const Status s = respond(w, stages, display); !s) return bad(s.error());
  if (interrupted()) return stopped();

  const search::Problem problem = problemOf(w.model);
  Report report{w.study, w.candidates, w.meters, w.model, {}, {}, {}, {}};
  report.responseSeconds = w.response.seconds, report.baseSeconds = w.response.baseSeconds, report.designsASecond = designsASecond(w.model);
  display.line(fmt::format("{:.0f} designs are evaluated a second", report.designsASecond));
  if (const Status s = searchAll(w, problem, report); !s) return bad(s.error());
  // Stopped amid the search there is a front all the same: it is written, without certificates.
  if (report.front.size() == 0) return stopped();
  report.lookUpsASecond = lookUpsASecond(w.model, report.front);
  report.facts = {{"program", "roomlight " + std::string(version())}, {"home", w.options.home}, {"seed", fmt::format("{}", w.study.seed)}, {"technique", w.render.technique + ", quality " + w.render.quality}, {"candidates' standard error", fmt::format("{:.2f} % at the worst point", w.response.worstErrorPercent)}, {"a second", fmt::format("{:.0f} designs evaluated; {:.0f} looked up among those of the front, as a surrogate would", report.designsASecond, report.lookUpsASecond)}};
  if (const Status s = writeDesigns(w, report); !s) return bad(s.error(), kFailed);
  const Status certified = certifyAll(w, report.front, report, stages, display);
  if (const Status s = writeReports(w, report); !s) return bad(s.error(), kFailed);
  if (!certified) return bad(certified.error(), kFailed);
  printFront(w, report);
  display.line(fmt::format("wrote {}", (w.folder / "index.html").string()));
  return interrupted() ? stopped() : kOk;
}

int runOptimise(const Options& o) {
  interrupted();  // from here on Ctrl-C is ours
  Work w;
  w.options = o, w.folder = o.folder;
  if (!o.quality.empty()) {
    if (const Status s = applyQuality(o.quality, w.render); !s) return bad("--" + s.error());
  }
  for (const std::string& name : o.baselines) {
    if (const auto m = search::methodNamed(name); !m) return bad("--baseline: " + m.error());
  }
  if (const auto m = search::methodNamed(o.method); !m) return bad("--method: " + m.error());
  std::error_code code;
  std::filesystem::create_directories(w.folder, code);
  if (code) return bad(fmt::format("{}: cannot be made: {}", o.folder, code.message()));
  for (const char* out : {"index.html", "front.csv", "points.csv", "run.json"}) {
    if (const Status s = checkWritable(w.folder / out); !s) return bad(s.error());
  }
  int result = kFailed;
  withThreads(o.threads.value_or(0), [&] { result = work(w); });
  return result;
}

}  // namespace

Registered addOptimise(CLI::App& program) {
  const auto o = std::make_shared<Options>();
  CLI::App* app = program.add_subcommand("optimise", "Propose lighting: places, kinds, aims and dimming of lamps on the best trade-offs between goals");
  app->add_option("HOME", o->home, "Home or room: .glb, .gltf, .obj, .sh3d or .sh3f")->required();
  app->add_option("STUDY", o->study, "Study file: goals, places, catalogue, limits (docs/formats/optimise.md)")->required();
  app->add_option("-o,--output", o->folder, "Folder for index.html, front.csv and lighting files; what it holds of the same inputs is not found again")->required();
  std::vector<std::pair<std::string, std::string>> methods;
  for (const search::MethodInfo& m : search::methodTable()) methods.emplace_back(m.name, m.summary);
  app->add_option("--method", o->method, listed("How designs are searched:", methods));
  app->add_option("--baseline", o->baselines, "Search by this method too, with as many evaluations, and tell its hypervolume; may be repeated")->expected(1)->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  app->add_option("--evaluations", o->evaluations, "Instead of the study's")->check(CLI::Range(100, 1000000000));
  app->add_option("--seconds", o->seconds, "End the search after so long; 0: never")->check(CLI::Range(0.0, 1e6));
  app->add_option("--certify", o->certify, "Designs that are solved in full, instead of the study's")->check(CLI::Range(0, 1000));
  app->add_option("--quality", o->quality, listed("How much is done for light:", qualities()));
  app->add_option("--seed", o->seed, "Instead of the study's; the same seed gives the same front");
  app->add_option("--threads", o->threads, "Threads; 0: all cores");
  app->add_flag("--quiet", o->quiet, "Only the table and errors");
  app->footer(
      "Ctrl-C stops; the same command goes on where it was.\n"
      "Example:\n"
      "  roomlight optimise flat.sh3d flat.toml -o out/flat");
  return {app, [o] { return runOptimise(*o); }};
}

}  // namespace roomlight::cli
