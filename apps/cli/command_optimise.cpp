// roomlight optimise: goals in, lighting designs on the best trade-offs out.
#include <fmt/format.h>

#include <memory>

#include "arguments.h"
#include "base/parallel.h"
#include "base/platform/terminal.h"
#include "base/write_file.h"
#include "commands.h"
#include "console.h"
#include "engine/settings.h"
#include "exit_status.h"
#include "import/import.h"
#include "optimise/run.h"
#include "output_files.h"
#include "started_programs.h"

namespace roomlight::cli {
namespace {

constexpr size_t kMostParts = 100000;

struct OptimiseOptions {
  std::string home, study, folder, method = "hybrid", quality, seed, part;
  std::vector<std::string> baselines;
  std::optional<int> threads, evaluations, certify;
  std::optional<float> metresPerUnit;
  double seconds = 0;
  bool quiet = false;
};

// One line that says how far the search is, on a terminal over the last one; elsewhere now and then.
class SearchLine {
 public:
  explicit SearchLine(bool quiet) : quiet_(quiet), terminal_(isErrorOutputTerminal()) {}
  ~SearchLine() { end(); }
  void show(const char* method, const search::State& s, double hypervolume, bool last) {
    if (quiet_ || (!last && watch_.seconds() - at_ < (terminal_ ? 0.3 : 10) && shown_)) return;
    at_ = watch_.seconds(), shown_ = true;
    fmt::print(stderr, "{}{}: {:3.0f} %  {} evaluations, {} designs on the front, hypervolume {:.4f}{}{}",
               terminal_ ? "\r\x1b[K" : "", method, 100 * search::fractionDone(s), s.evaluations, s.archive.size(),
               hypervolume, last ? "" : fmt::format(", {:.0f} s left", search::secondsLeft(s)), terminal_ ? "" : "\n");
    std::fflush(stderr);
    if (last) end();
  }

 private:
  void end() {
    if (terminal_ && shown_) fmt::print(stderr, "\n");
    shown_ = false;
  }

  bool quiet_, terminal_, shown_ = false;
  Stopwatch watch_;
  double at_ = 0;
};

void printFront(const optimise::Report& report) {
  fmt::print("{:<10}", "design");
  for (const optimise::Objective o : report.model.objectives)
    fmt::print("{:>22}",
               fmt::format("{} {}", infoOf(o).name,
                           o == optimise::Objective::Cost ? report.study.catalogue.currency : infoOf(o).unit));
  fmt::print("{:>10}{:>8}\n", "fittings", "W");
  for (const optimise::Proposed& d : report.designs) {
    fmt::print("{:<10}", d.name);
    for (const optimise::Objective o : report.model.objectives) fmt::print("{:>22.4g}", d.result.of(o));
    fmt::print("{:>10}{:>8.4g}\n", d.result.fittings, d.result.installedW);
  }
}

// I of N, as --part takes it: from 1.
Status readPart(const std::string& text, optimise::RunWish& wish) {
  const size_t slash = std::min(text.find('/'), text.size());
  const auto part = parseNumber<size_t>(std::string_view(text).substr(0, slash));
  const auto parts = parseNumber<size_t>(std::string_view(text).substr(std::min(slash + 1, text.size())));
  if (!part || !parts || *part < 1 || *part > *parts || *parts > kMostParts)
    return Error{fmt::format("--part {}: write I/N, such as 2/8: the second of eight", text)};
  wish.part = *part - 1, wish.parts = *parts;
  return Ok{};
}

int stoppedOptimise() { return failed("interrupted; started again with the same folder, it goes on", kInterrupted); }

// Home and study are read; a part of the response is found.
int workPart(const OptimiseOptions& o, optimise::Run& run, Stages& stages, ProgressDisplay& display) {
  if (const Status s = run.respondPart(stages); !s) return failed(s.error(), kFailed);
  if (run.stopped()) return stoppedOptimise();
  display.line(fmt::format("when all parts are there, go on with the same command without --part {}", o.part));
  return kOk;
}

int workOptimise(const OptimiseOptions& o, const optimise::RunWish& wish) {
  ProgressDisplay display(o.quiet);
  SearchLine searching(o.quiet);
  const RenderProgress progress{
      [&](const std::string& stage, float f) { display.report(stage, f); }, &interrupted(), {}};
  RenderStats stats;
  Stages stages(progress, stats);
  optimise::Run run(wish, {[&](const std::string& line) { display.line(line); },
                           [](const std::string& warning) { printWarnings({warning}); },
                           [&](const char* method, const search::State& s, double hypervolume, bool last) {
                             searching.show(method, s, hypervolume, last);
                           }});
  const Status read = stages.run("load", [&](const Progress&) { return run.read(); });
  if (!read) return failed(read.error());
  if (run.stopped()) return stoppedOptimise();
  if (!o.part.empty()) return workPart(o, run, stages, display);
  if (const Status s = run.respond(stages); !s) return failed(s.error());
  if (run.stopped()) return stoppedOptimise();
  if (const Status s = run.searchAll(); !s) return failed(s.error());
  // Stopped amid the search there is a front all the same: it is written, without certificates.
  if (run.report().front.size() == 0) return stoppedOptimise();
  if (const Status s = run.propose(); !s) return failed(s.error(), kFailed);
  const Status certified = run.certifyAll(stages);
  if (const Status s = run.write(reportPlots()); !s) return failed(s.error(), kFailed);
  if (!certified) return failed(certified.error(), kFailed);
  printFront(run.report());
  display.line(fmt::format("wrote {}", (wish.folder / "index.html").string()));
  return run.stopped() ? stoppedOptimise() : kOk;
}

// What the command line asks for.
Result<optimise::RunWish> wishOf(const OptimiseOptions& o) {
  optimise::RunWish wish;
  wish.home = o.home, wish.metresPerUnit = o.metresPerUnit, wish.study = o.study, wish.folder = o.folder,
  wish.seconds = o.seconds, wish.certified = o.certify, wish.stop = &interrupted();
  if (!o.part.empty()) {
    if (const Status s = readPart(o.part, wish); !s) return Error{s.error()};
  }
  if (o.evaluations) wish.evaluations = static_cast<size_t>(*o.evaluations);
  if (!o.quality.empty()) {
    if (const Status s = applyQuality(o.quality, wish.render); !s) return Error{"--" + s.error()};
  }
  const auto method = search::methodNamed(o.method);
  if (!method) return Error{"--method: " + method.error()};
  wish.methods = {method.value()};
  for (const std::string& name : o.baselines) {
    const auto baseline = search::methodNamed(name);
    if (!baseline) return Error{"--baseline: " + baseline.error()};
    wish.methods.push_back(baseline.value());
  }
  if (o.seed.empty()) return wish;
  wish.seed = parseNumber<uint64_t>(o.seed);
  if (!wish.seed) return Error{fmt::format("--seed {}: write a whole number from 0 to 18446744073709551615", o.seed)};
  return wish;
}

// Beside others that find theirs in the same folder: nothing is held.
int runPart(const OptimiseOptions& o, const optimise::RunWish& wish) {
  std::error_code code;
  std::filesystem::create_directories(wish.folder, code);
  if (code) return failed(cannotWrite(wish.folder, code.value()).message);
  const std::filesystem::path file = wish.folder / optimise::Run::partFile(wish.part, wish.parts);
  if (const Status s = checkWritable(file); !s) return failed(s.error());
  int result = kFailed;
  withThreads(o.threads.value_or(0), [&] { result = workOptimise(o, wish); });
  return result;
}

int runOptimise(const OptimiseOptions& o) {
  interrupted();  // from here on Ctrl-C is ours
  const Result<optimise::RunWish> wish = wishOf(o);
  if (!wish) return failed(wish.error());
  if (!o.part.empty()) return runPart(o, wish.value());
  // Held until all is written; where nothing was, the folder goes again.
  const Result<HeldFolder> held = holdFolder(o.folder);
  if (!held) return failed(held.error());
  if (!held.value())
    return failed(fmt::format("{}: is in use by another run of optimise; wait for it or name another", o.folder),
                  kFailed);
  for (const char* out : optimise::Run::kFiles) {
    if (const Status s = checkWritable(wish.value().folder / out); !s) return failed(s.error());
  }
  int result = kFailed;
  withThreads(o.threads.value_or(0), [&] { result = workOptimise(o, wish.value()); });
  return result;
}

}  // namespace

Registered addOptimise(CLI::App& program) {
  const auto o = std::make_shared<OptimiseOptions>();
  CLI::App* app = program.add_subcommand(
      "optimise", "Propose lighting: places, kinds, aims and dimming of lamps on the best trade-offs between goals");
  app->add_option("HOME", o->home, "Home or room: " + supportedFiles())->required();
  app->add_option("STUDY", o->study, "Study file: goals, places, catalogue, limits (docs/reference/optimise.md)")
      ->required();
  app->add_option(
         "-o,--output", o->folder,
         "Folder for index.html, front.csv and lighting files; what it holds of the same inputs is not found again")
      ->required();
  std::vector<std::pair<std::string, std::string>> methods;
  for (const search::MethodInfo& m : search::methodTable()) methods.emplace_back(m.name, m.summary);
  app->add_option("--method", o->method, listed("How designs are searched:", methods));
  app->add_option("--baseline", o->baselines,
                  "Search by this method too, with as many evaluations, and tell its hypervolume; may be repeated")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  app->add_option("--evaluations", o->evaluations, "Instead of the study's")->check(CLI::Range(100, 1000000000));
  app->add_option("--seconds", o->seconds, "End the search after so long; 0: never")->check(CLI::Range(0.0, 1e6));
  app->add_option("--certify", o->certify, "Designs that are solved in full, instead of the study's")
      ->check(CLI::Range(0, 1000));
  app->add_option("--part", o->part,
                  "I/N: of the response, which takes most of the time, only this part; once N processes have found "
                  "theirs in the same folder, the command without --part goes on");
  app->add_option("--quality", o->quality, listed("How much is done for light:", qualities()));
  app->add_option("--metres-per-unit", o->metresPerUnit,
                  "Length of the home's unit in metres; without it the file's, or guessed")
      ->check(CLI::Range(1e-9, 1e6));
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
