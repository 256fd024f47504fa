// roomlight batch: many commands as tasks that any number of machines share.
#include <fmt/format.h>

#include <cstdlib>
#include <memory>

#include "arguments.h"
#include "base/platform/machine.h"
#include "base/platform/module.h"
#include "batch/durable.h"
#include "batch/merge.h"
#include "batch/plan_file.h"
#include "batch/runner.h"
#include "batch/slurm.h"
#include "batch/status.h"
#include "commands.h"
#include "console.h"
#include "engine/settings.h"
#include "exit_status.h"
#include "started_programs.h"

namespace roomlight::cli {
namespace {

namespace fs = std::filesystem;

struct BatchOptions {
  std::string plan, folder, list, lightCache;
  bool all = false, again = false, noWait = false, json = false, quiet = false, slurm = false, dryRun = false;
  std::optional<size_t> index;
  size_t chunk = 1;
  int jobs = 1;
  double timeoutS = 0, staleMinutes = batch::Claims::kUsualStaleS / 60;
  batch::SlurmWish submit;
};

Result<batch::TaskList> openBatch(const BatchOptions& o) {
  std::error_code code;
  const fs::path whole = fs::weakly_canonical(fs::absolute(o.folder, code), code);
  return batch::TaskList::open(batch::Folder(whole.has_filename() ? whole : whole.parent_path()));
}

// Cores that this process may use; Slurm and containers leave it a few of a machine's.
int coresHere() {
  const int cores = coresAllowed();
  const char* given = std::getenv("SLURM_CPUS_PER_TASK");
  const auto slurm = given ? parseNumber<int>(given) : std::nullopt;
  return slurm && *slurm > 0 ? std::min(*slurm, cores) : cores;
}

// Of the array job that this process is a part of.
Result<std::optional<size_t>> indexFromEnvironment() {
  for (const char* name : {"SLURM_ARRAY_TASK_ID", "AWS_BATCH_JOB_ARRAY_INDEX", "JOB_COMPLETION_INDEX"}) {
    const char* value = std::getenv(name);
    if (!value || !*value) continue;
    const auto index = parseNumber<size_t>(value);
    if (!index) return Error{fmt::format("{}={}: is no whole number from 0", name, value)};
    return index;
  }
  return std::optional<size_t>();
}

Result<std::vector<size_t>> tasksToRun(const BatchOptions& o, const batch::TaskList& list) {
  std::optional<size_t> index = o.index;
  if (!o.all && !index) {
    const auto found = indexFromEnvironment();
    if (!found) return Error{found.error()};
    index = found.value();
    if (!index)
      return Error{
          "say which tasks: --all or --index N; array jobs of Slurm, AWS Batch and Kubernetes tell it by themselves"};
  }
  std::vector<size_t> tasks;
  if (!o.list.empty())
    return batch::readTaskNumbers(o.list, index.value_or(0) * o.chunk, o.all ? list.size() : o.chunk);
  const size_t first = index ? std::min(*index, list.size()) * o.chunk : 0;
  const size_t last = index ? std::min(first + o.chunk, list.size()) : list.size();
  if (index && first >= list.size())
    return Error{fmt::format("--index {}: there are {} tasks, numbered from 0{}", *index, list.size(),
                             o.chunk > 1 ? fmt::format(", in chunks of {}", o.chunk) : "")};
  for (size_t i = first; i < last; ++i) tasks.push_back(i);
  return tasks;
}

// Two builds of one version may differ in the last bit of a picture.
std::string thisBuild() { return fmt::format("{} (build {})", version(), buildId()); }

std::string plural(size_t count, const std::string& what) {
  return fmt::format("{} {}{}", count, what, count == 1 ? "" : "s");
}

int runPlan(const BatchOptions& o) {
  const auto planned = batch::planBatch(o.plan, o.folder, thisBuild(), checkCommandLine);
  if (!planned) return failed(planned.error());
  for (const batch::SectionInfo& s : planned.value().sections) fmt::print("{}: {}\n", s.name, plural(s.tasks, "task"));
  fmt::print("{}{} planned in {}\n", plural(planned.value().tasks, "task"),
             planned.value().done > 0 ? fmt::format(", {} of them done already,", planned.value().done) : "", o.folder);
  return kOk;
}

int runRun(const BatchOptions& o) {
  interrupted();  // from here on signals are ours
  const Result<batch::TaskList> list = openBatch(o);
  if (!list) return failed(list.error());
  Result<std::vector<size_t>> tasks = tasksToRun(o, list.value());
  if (!tasks) return failed(tasks.error());
  for (const size_t task : tasks.value()) {
    if (task >= list.value().size()) return failed(fmt::format("{}: is of an earlier plan; submit again", o.list));
  }
  batch::RunWish wish;
  wish.program = runningProgram(), wish.version = thisBuild(), wish.tasks = std::move(tasks.value());
  wish.jobs = o.jobs, wish.cores = coresHere(), wish.timeoutS = o.timeoutS, wish.staleS = o.staleMinutes * 60;
  std::error_code code;
  if (!o.lightCache.empty()) wish.lightCache = fs::absolute(o.lightCache, code).string();
  wish.again = o.again, wish.wait = !o.noWait, wish.stop = &interrupted();
  wish.tell = [](const std::string& line) { fmt::print(stderr, "failed: {}\n", line); };
  const size_t all = wish.tasks.size();
  const Result<batch::RunResult> result = batch::runTasks(list.value(), wish);
  if (!result) return failed(result.error(), kFailed);
  const batch::RunResult& r = result.value();
  if (r.stopped)
    return failed(fmt::format("stopped: {} of {} done, what was being done is given back; run again to go on",
                              r.done + r.already, plural(all, "task")),
                  interruptStatus());
  if (!o.quiet)
    fmt::print("{}: {} done now, {} before, {} failed{}\n", plural(all, "task"), r.done, r.already, r.failed,
               r.left > 0 ? fmt::format(", {} run by others", r.left) : "");
  if (r.failed > 0)
    return failed(fmt::format("{} failed; see roomlight batch status {}", plural(r.failed, "task"), o.folder), kFailed);
  return kOk;
}

int runStatus(const BatchOptions& o) {
  const Result<batch::TaskList> list = openBatch(o);
  if (!list) return failed(list.error());
  const batch::BatchStatus status = batch::statusOf(list.value(), o.staleMinutes * 60);
  if (o.json) {
    fmt::print("{}", batch::statusJson(list.value(), status));
    return kOk;
  }
  fmt::print("{}", batch::statusText(list.value(), status));
  const std::string slurm = batch::slurmStatus(list.value().folder());
  if (!slurm.empty()) fmt::print("{}\n", slurm);
  return kOk;
}

int runMerge(const BatchOptions& o) {
  const Result<batch::TaskList> list = openBatch(o);
  if (!list) return failed(list.error());
  const Result<batch::Merged> merged = batch::mergeBatch(list.value(), runningProgram());
  if (!merged) return failed(merged.error(), kFailed);
  const batch::Merged& m = merged.value();
  printWarnings(m.remarks);
  for (const batch::Film& film : m.films) {
    if (film.file.empty()) printNotes({fmt::format("no ffmpeg here; to make the film: {}", film.command)});
  }
  for (const batch::Whole& whole : m.wholes) {
    if (!whole.missing.empty()) printWarnings({fmt::format("{}: {}", whole.group, whole.missing)});
    if (!whole.command.empty()) printNotes({fmt::format("{}: to go on: {}", whole.group, whole.command)});
  }
  for (const batch::SeedMean& mean : m.means)
    fmt::print("{}: mean of {} seeds, standard error {:.3g} % of the mean luminance\n", mean.group, mean.seeds,
               100 * mean.standardError);
  fmt::print("{} of {} merged: {}\n", m.done, plural(m.tasks, "task"),
             (list.value().folder().merged() / "index.html").string());
  return kOk;
}

int runSubmit(const BatchOptions& o) {
  if (!o.slurm) return failed("say where to: --slurm; for others see docs/reference/batch.md");
  const Result<batch::TaskList> list = openBatch(o);
  if (!list) return failed(list.error());
  const std::vector<size_t> left = batch::tasksLeft(list.value(), true);
  if (left.empty()) {
    fmt::print("nothing to submit: every task is done or being run\n");
    return kOk;
  }
  batch::SlurmWish wish = o.submit;
  std::error_code code;
  wish.program = fs::read_symlink(runningProgram(), code);
  const batch::SlurmPlan plan = batch::slurmPlan(list.value(), left, wish);
  fmt::print("{} in {} of {}, about {:.0f} min each\n", plural(plan.tasks, "task"), plural(plan.chunks, "chunk"),
             plan.chunk, plan.seconds / static_cast<double>(plan.chunks) / 60);
  if (o.dryRun) {
    for (size_t i = 0; i < plan.contents.size(); ++i)
      fmt::print("\n# {}\n{}", (i < plan.arrays.size() ? plan.arrays[i] : plan.merge).string(), plan.contents[i]);
    return kOk;
  }
  if (const Result<bool> queued = batch::isQueued(list.value().folder()); queued && queued.value())
    return failed("jobs of an earlier submit are still in the queue; wait for them or scancel them", kFailed);
  if (const Status s = batch::writeSlurm(plan, left); !s) return failed(s.error(), kFailed);
  const auto jobs = batch::submitSlurm(list.value().folder(), plan);
  if (!jobs) return failed(jobs.error(), kFailed);
  std::string numbers;
  for (const std::string& job : jobs.value()) numbers += " " + job;
  fmt::print("submitted: jobs{}; the last merges\n", numbers);
  return kOk;
}

// What is bound to a subcommand of batch.
struct Part {
  CLI::App* app;
  int (*run)(const BatchOptions&);
};

CLI::App* addPart(CLI::App& batch, const std::string& name, const std::string& about, BatchOptions& o) {
  CLI::App* app = batch.add_subcommand(name, about);
  if (name == "plan") {
    app->add_option("PLAN", o.plan, "Plan file: which tasks there are (docs/reference/batch.md)")->required();
    app->add_option("-o,--output", o.folder, "Folder of the batch; what it holds of the same tasks is kept")
        ->required();
  } else {
    app->add_option("DIR", o.folder, "Folder of the batch")->required();
  }
  return app;
}

void addRunOptions(CLI::App& app, BatchOptions& o) {
  app.add_flag("--all", o.all, "Every task that is neither done nor being run");
  app.add_option("--index", o.index, "This task alone, from 0; without it, that of the array job this is part of");
  app.add_option("--chunk", o.chunk, "Tasks in a row for each index")->check(CLI::Range(1, 1000000000));
  app.add_option("--list", o.list, "File with numbers of tasks, as submit writes it; --index counts its chunks");
  app.add_option("--jobs", o.jobs, "Tasks at once; they share the cores")
      ->capture_default_str()
      ->check(CLI::Range(1, 1024));
  app.add_option("--timeout", o.timeoutS, "Seconds after which a task is stopped and has failed; 0: never")
      ->check(CLI::Range(0.0, 1e7));
  app.add_option("--light-cache", o.lightCache,
                 "Folder of this machine where tasks with shareLight share the light of a home");
  app.add_flag("--again", o.again, "Try again what has failed for good");
  app.add_flag("--no-wait", o.noWait, "Do not wait for tasks that other processes run");
  app.add_option("--stale", o.staleMinutes, "Minutes without a sign of life after which another machine's task is free")
      ->capture_default_str()
      ->check(CLI::Range(1.0, 1e5));
  app.add_flag("--quiet", o.quiet, "Only errors");
}

void addSubmitOptions(CLI::App& app, BatchOptions& o) {
  app.add_flag("--slurm", o.slurm, "To Slurm: array jobs of what is not done, then the merge");
  app.add_option("--partition", o.submit.partition, "Of Slurm");
  app.add_option("--time", o.submit.time, "Most time of a chunk, as Slurm writes it: 30, 2:00:00");
  app.add_option("--array-limit", o.submit.arrayLimit, "Chunks at once; 0: no limit")->check(CLI::Range(0, 1000000));
  app.add_option("--cpus", o.submit.cpus, "Cores of each chunk")->capture_default_str()->check(CLI::Range(1, 1024));
  app.add_option("--chunk-minutes", o.submit.chunkMinutes, "Work of a chunk, at least")
      ->capture_default_str()
      ->check(CLI::Range(0.0, 1e5));
  app.add_option("--array-size", o.submit.mostInArray, "Most chunks of one array: the cluster's MaxArraySize less one")
      ->capture_default_str()
      ->check(CLI::Range(1, 10000000));
  app.add_flag("--dry-run", o.dryRun, "Print the scripts; write and submit nothing");
}

}  // namespace

Registered addBatch(CLI::App& program) {
  const auto o = std::make_shared<BatchOptions>();
  CLI::App* app = program.add_subcommand("batch", "Share many commands among processes and machines");
  app->require_subcommand(1);
  const std::vector<Part> parts = {
      {addPart(*app, "plan", "Write the tasks of a plan file into a folder", *o), runPlan},
      {addPart(*app, "run", "Run tasks of a folder; any number of processes and machines may", *o), runRun},
      {addPart(*app, "status", "Tell how far it is", *o), runStatus},
      {addPart(*app, "merge", "Put together what is done: means, sheets, films, tables, a page", *o), runMerge},
      {addPart(*app, "submit", "Give what is not done to a cluster", *o), runSubmit}};
  addRunOptions(*parts[1].app, *o);
  parts[2].app->add_flag("--json", o->json, "As JSON");
  addSubmitOptions(*parts[4].app, *o);
  app->footer(
      "Example:\n"
      "  roomlight batch plan street.toml -o out/street\n"
      "  roomlight batch run out/street --all --jobs 4\n"
      "  roomlight batch merge out/street");
  return {app, [o, parts] {
            for (const Part& part : parts) {
              if (part.app->parsed()) return part.run(*o);
            }
            return kBadInput;
          }};
}

}  // namespace roomlight::cli
