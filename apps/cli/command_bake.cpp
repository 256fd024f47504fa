// roomlight bake: a home and its light in, one page for any browser out.
#include <fmt/format.h>

#include <algorithm>
#include <memory>

#include "arguments.h"
#include "bake/bake.h"
#include "bake/seen_sides.h"
#include "base/hash.h"
#include "base/parallel.h"
#include "base/write_file.h"
#include "commands.h"
#include "console.h"
#include "engine/settings.h"
#include "exit_status.h"
#include "home/light.h"
#include "json/json_file.h"
#include "output_files.h"
#include "started_programs.h"

namespace roomlight::cli {
namespace {

struct BakeOptions : SceneOptions {
  std::string output, quality = "good", hours, stats;
  std::optional<int> threads;
  bool quiet = false;
};

struct BakePlan {
  bake::BakeSettings settings;
  home::OpenWish open;
  std::vector<float> hours;
  std::string page;   // the built page; empty for a .glb
  HeldFolder folder;  // that is written into
};

// The home's file without its folder and extension.
std::string titleOf(const BakeOptions& o) { return std::filesystem::path(o.scene).stem().string(); }

bool isPage(const BakeOptions& o) { return lowerExtension(o.output) == ".html"; }
bool isFolder(const BakeOptions& o) { return lowerExtension(o.output).empty(); }

Result<std::vector<float>> parseHours(const std::string& text) {
  Result<std::vector<float>> hours =
      parseList("--hours", text, "hours of the day with commas between, such as 8,12,16.5", {1, 2, 3, 4, 5, 6, 7, 8});
  if (!hours) return hours;
  for (const float hour : hours.value()) {
    if (!(hour >= 0 && hour <= 24)) return Error{fmt::format("--hours {}: an hour is from 0 to 24", text)};
  }
  std::sort(hours.value().begin(), hours.value().end());
  hours.value().erase(std::unique(hours.value().begin(), hours.value().end()), hours.value().end());
  return hours;
}

Result<BakePlan> planBake(const BakeOptions& o) {
  if (!isPage(o) && !isFolder(o) && lowerExtension(o.output) != ".glb")
    return Error{fmt::format("{}: unknown kind of file; use .html, .glb or the name of a folder", o.output)};
  BakePlan plan;
  Result<bake::BakeSettings> settings = bake::bakeSettings(o.quality);
  if (!settings) return Error{"--" + settings.error()};
  plan.settings = std::move(settings.value());
  plan.settings.layers.render.threads = o.threads.value_or(0);
  if (const Status s = checkSettings(plan.settings.layers.render); !s) return Error{s.error()};
  Result<home::OpenWish> open = readSceneOptions(o);
  if (!open) return Error{open.error()};
  plan.open = std::move(open.value());
  plan.open.allCameras = true;
  if (!o.hours.empty()) {
    Result<std::vector<float>> hours = parseHours(o.hours);
    if (!hours) return Error{hours.error()};
    plan.hours = std::move(hours.value());
  }
  if (!o.stats.empty()) {
    if (const Status s = checkWritable(o.stats); !s) return Error{s.error()};
  }
  if (isFolder(o)) {
    Result<HeldFolder> held = holdFolder(o.output);
    if (!held) return Error{held.error()};
    if (!held.value()) return Error{fmt::format("{}: another run writes into it", o.output)};
    plan.folder = std::move(held.value());
  } else if (const Status s = checkWritable(o.output); !s) {
    return Error{s.error()};
  }
  if (const Status s = checkDistinct({o.scene, o.lighting, o.output, o.stats, o.writeLighting}); !s)
    return Error{s.error()};
  if (lowerExtension(o.output) == ".glb") return plan;
  Result<std::string> page = readTextFile(pageFolder("baked", "dist-baked") / "index.html");
  if (!page) return Error{page.error() + "; build the page with scripts/build"};
  plan.page = std::move(page.value());
  return plan;
}

// The daylight of the home by place and time: its lighting file's, that which was added, its own, else one assumed.
Result<nlohmann::json> daylightOf(const BakeOptions& o, const home::OpenedHome& home) {
  nlohmann::json document = home.lighting;
  if (!o.lighting.empty()) {
    Result<nlohmann::json> read = readJsonFile(o.lighting);
    if (!read) return read;
    if (read.value().is_object() && read.value().contains("daylight")) document = std::move(read.value());
  }
  if (document.is_object() && document.contains("daylight")) return nlohmann::json(document["daylight"]);
  if (!home.daylight.empty()) return parseJson(home.daylight);
  return nlohmann::json(home::assumedDaylight());
}

// Those asked for; else the home's own sun and sky, where it has any.
Result<std::vector<bake::DaylightHour>> hoursOf(const BakeOptions& o, const BakePlan& plan,
                                                const home::OpenedHome& home) {
  const Result<nlohmann::json> daylight = daylightOf(o, home);
  if (!daylight) return Error{daylight.error()};
  std::vector<bake::DaylightHour> out;
  const Scene& scene = home.scene;
  if (plan.hours.empty() && (!scene.suns.empty() || scene.sky.present()))
    out.push_back({bake::hourOf(daylight.value()).value_or(12), scene.suns, scene.sky});
  for (const float hour : plan.hours) {
    Result<bake::DaylightHour> at =
        bake::daylightAt(daylight.value(), std::filesystem::path(o.lighting).parent_path(), hour);
    if (!at) return Error{"--hours: " + at.error()};
    out.push_back(std::move(at.value()));
  }
  return out;
}

// Into a folder: the home's file is named by what is in it, so that browsers may keep it for ever.
Status writeFolder(const BakeOptions& o, const BakePlan& plan, const std::string& glb) {
  Hash hash;
  hash.bytes(glb);
  const std::string file = fmt::format("home-{}.glb", hash.text());
  const Result<std::string> page = bake::pageWithLink(plan.page, titleOf(o), file);
  if (!page) return Error{page.error()};
  if (const Status s = writeWhole(std::filesystem::path(o.output) / file, glb); !s) return s;
  return writeWhole(std::filesystem::path(o.output) / "index.html", page.value());
}

Status writeBaked(const BakeOptions& o, const BakePlan& plan, const std::string& glb) {
  if (isFolder(o)) return writeFolder(o, plan, glb);
  if (!isPage(o)) return writeWhole(o.output, glb);
  const Result<std::string> page = bake::pageWithHome(plan.page, titleOf(o), glb);
  return page ? writeWhole(o.output, page.value()) : Status(Error{page.error()});
}

std::string statsJson(const Scene& scene, const bake::BakedHome& b, const RenderStats& stats) {
  const auto vector = [](Vec3 v) { return Json({v.x, v.y, v.z}); };
  Json cameras = Json::array();
  for (const Camera& c : bake::camerasInside(scene)) {
    cameras.push_back({{"name", c.name},
                       {"position", vector(c.worldFromCamera.w)},
                       {"forward", vector(-c.worldFromCamera.z)},
                       {"yFovDeg", c.yFovRad * 180 / kPi}});
  }
  const Json json = {{"bytes", b.glb.bytes.size()},
                     {"lightBytes", b.glb.lightBytes},
                     {"triangles", b.triangles},
                     {"places", b.places},
                     {"layers", b.layers},
                     {"atlas", {b.atlasWidth, b.atlasHeight}},
                     {"ev100", b.shown.ev100},
                     {"cameras", cameras},
                     {"stages", stagesJson(stats.stages)}};
  return json.dump(2) + "\n";
}

int workBake(const BakeOptions& o, const BakePlan& plan) {
  ProgressDisplay display(o.quiet);
  const RenderProgress progress{
      [&](const std::string& stage, float f) { display.report(stage, f); }, &interrupted(), {}};
  RenderStats stats;
  Stages stages(progress, stats);
  Result<home::OpenedHome> home = stages.run("load", [&](const Progress&) { return home::openHome(plan.open); });
  if (!home) return failed(home.error());
  if (const Status s = writeAddedLight(o, home.value()); !s) return failed(s.error());
  if (!o.quiet) printOpened(o, home.value());
  const Scene& scene = home.value().scene;
  Result<std::vector<bake::DaylightHour>> hours = hoursOf(o, plan, home.value());
  if (!hours) return failed(hours.error());
  const bake::BakeWish wish{home.value().offLamps, std::move(hours.value())};
  const Result<bake::BakedHome> baked = bake::bakeHome(scene, wish, plan.settings, stages);
  if (!baked) return failed(baked.error());
  if (interrupted()) return failed("interrupted before all light was found; nothing was written", kInterrupted);
  const bake::BakedHome& b = baked.value();
  if (const Status s = writeBaked(o, plan, b.glb.bytes); !s) return failed(s.error(), kFailed);
  if (!o.stats.empty()) {
    if (const Status s = writeWhole(o.stats, statsJson(scene, b, stats)); !s) return failed(s.error(), kFailed);
  }
  display.line(fmt::format("wrote {}: {:.1f} MB, {} layers of light on {} places", o.output,
                           static_cast<double>(b.glb.bytes.size()) / 1e6, b.layers, b.places));
  return kOk;
}

int runBake(const BakeOptions& o) {
  interrupted();  // from here on Ctrl-C is ours
  const Result<BakePlan> plan = planBake(o);
  if (!plan) return failed(plan.error());
  int code = kFailed;
  withThreads(plan.value().settings.layers.render.threads, [&] { code = workBake(o, plan.value()); });
  return code;
}

}  // namespace

Registered addBake(CLI::App& program) {
  const auto o = std::make_shared<BakeOptions>();
  CLI::App* app = program.add_subcommand("bake", "Make a page in which a lit home is walked, every lamp on a dimmer");
  addSceneOptions(*app, *o, "HOME");
  app->add_option("-o,--output", o->output,
                  "home.html: one page with everything inside; home.glb: geometry and light alone; a name without "
                  "extension: a folder for a web server")
      ->required();
  app->add_option("--quality", o->quality, listed("How much is done:", qualities()))->capture_default_str();
  app->add_option("--hours", o->hours,
                  "Daylight at these hours of the home's day, such as 8,12,16; without it at its own hour alone");
  app->add_option("--stats", o->stats, "Write sizes, and time and memory of each stage, to this JSON file");
  app->add_option("--threads", o->threads, "Threads; 0: all cores");
  app->add_flag("--quiet", o->quiet, "Only errors");
  app->footer(
      "Examples:\n"
      "  roomlight bake flat.sh3d -o flat.html\n"
      "  roomlight bake flat.sh3d --lighting evening.json --quality draft -o public/flat");
  return {app, [o] { return runBake(*o); }};
}

}  // namespace roomlight::cli
