#include "roomlight/optimise.h"

#include <fmt/format.h>

#include <filesystem>

#include "base/write_file.h"
#include "cli/output_files.h"
#include "cli/started_programs.h"
#include "conversions.h"
#include "engine/stages.h"
#include "optimise/run.h"

namespace roomlight::v1 {
namespace {

Result<optimise::RunWish> wishOf(const std::string& home, const std::string& study, const std::string& folder,
                                 const OptimiseOptions& o) {
  optimise::RunWish wish;
  wish.home = home, wish.study = study, wish.folder = folder;
  if (o.metresPerUnit) wish.metresPerUnit = static_cast<float>(*o.metresPerUnit);
  if (!(o.seconds >= 0)) return badInput("seconds: must not be negative");
  wish.seconds = o.seconds, wish.evaluations = o.evaluations, wish.certified = o.certified, wish.seed = o.seed;
  if (const auto s = applyQuality(o.quality, wish.render); !s) return badInput(s.error());
  const auto method = search::methodNamed(o.method);
  if (!method) return badInput("method: " + method.error());
  wish.methods = {method.value()};
  return wish;
}

std::vector<Design> designsOf(const optimise::Report& report, const std::filesystem::path& folder) {
  std::vector<Design> designs;
  for (const optimise::Proposed& d : report.designs) {
    Design design;
    design.name = d.name, design.fittings = d.result.fittings, design.installedW = d.result.installedW;
    for (const std::string& name : d.lightingFiles) design.lightingFiles.push_back((folder / name).string());
    for (const optimise::Objective o : report.model.objectives)
      design.objectives[optimise::infoOf(o).name] = d.result.of(o);
    if (d.certificate) design.largestDifferencePercent = d.certificate->worst().maxPercent;
    designs.push_back(std::move(design));
  }
  return designs;
}

// Every step of a run, in order; which may be cancelled between and within them.
Status work(optimise::Run& run, Stages& stages) {
  const auto step = [&](const roomlight::Status& s) -> Status {
    if (!s) return badInput(s.error());
    return run.stopped() ? Status(interrupted()) : Done{};
  };
  if (const Status s = step(run.read()); !s) return s;
  if (const Status s = step(run.respond(stages)); !s) return s;
  if (const Status s = step(run.searchAll()); !s) return s;
  if (const Status s = step(run.propose()); !s) return s;
  if (const Status s = step(run.certifyAll(stages)); !s) return s;
  const roomlight::Result<std::string> plots =
      cli::readTextFile(cli::pageFolder("reports", "dist-reports") / "index.html");
  return step(run.write(plots ? plots.value() : std::string()));
}

}  // namespace

Result<std::vector<Design>> optimise(const std::string& home, const std::string& study, const std::string& folder,
                                     const OptimiseOptions& options, const Progress& progress) {
  return guardedOn(options.threads, [&]() -> Result<std::vector<Design>> {
    Result<optimise::RunWish> wish = wishOf(home, study, folder, options);
    if (!wish) return wish.error();
    std::atomic<bool> never{false};
    wish->stop = progress.cancelled ? progress.cancelled : &never;
    const roomlight::Result<HeldFolder> held = holdFolder(folder);
    if (!held) return badInput(held.error());
    if (!held.value()) return badInput(fmt::format("{}: is in use by another run of optimise", folder));
    const RenderProgress inner = toInternal(progress);
    RenderStats stats;
    Stages stages(inner, stats);
    const auto searching = [&](const char*, const search::State& s, double, bool) {
      if (progress.report) progress.report("search", static_cast<float>(search::fractionDone(s)));
    };
    optimise::Run run(*wish, {[](const std::string&) {}, [](const std::string&) {}, searching});
    if (const Status s = work(run, stages); !s) return s.error();
    return designsOf(run.report(), folder);
  });
}

}  // namespace roomlight::v1
