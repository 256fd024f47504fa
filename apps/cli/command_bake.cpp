// roomlight bake: a home and its light in, one page for any browser out.
#include <fmt/format.h>

#include <algorithm>
#include <memory>

#include "arguments.h"
#include "bake/bake.h"
#include "bake/page.h"
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
#include "scene/find_named.h"
#include "started_programs.h"

namespace roomlight::cli {
namespace {

struct BakeOptions : SceneOptions {
  std::string output, quality = "good", hours, rooms, budget, stats;
  std::optional<int> threads;
  bool quiet = false;
};

struct BakePlan {
  bake::BakeSettings settings;
  home::OpenWish open;
  std::vector<float> hours;
  std::vector<std::string> rooms;  // as typed; none: all
  double budgetBytes = 0;          // 0: none
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
  plan.rooms = CLI::detail::split(o.rooms, ',');
  if (o.rooms.empty()) plan.rooms.clear();
  for (std::string& name : plan.rooms) CLI::detail::trim(name);
  if (!o.budget.empty()) {
    plan.budgetBytes = parseBytes(o.budget).value_or(0);
    if (!(plan.budgetBytes > 0)) return Error{fmt::format("--budget {}: write a size such as 20MB", o.budget)};
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
  if (lowerExtension(o.output) == ".glb") {
    plan.settings.glb.lightMap = true;
    return plan;
  }
  plan.settings.glb.compressed = true;
  Result<std::string> page = readTextFile(pageFolder("baked", "dist-baked") / "index.html");
  if (!page) return Error{page.error() + "; build the page with scripts/build"};
  plan.page = std::move(page.value());
  return plan;
}

// Where the light found so far is kept until all of it is written.
std::filesystem::path keptIn(const BakeOptions& o) {
  std::string name = o.output;
  while (name.size() > 1 && name.back() == '/') name.pop_back();
  return name + ".light";
}

Result<std::vector<size_t>> roomsOf(const BakePlan& plan, const Scene& scene) {
  std::vector<size_t> out;
  for (const std::string& name : plan.rooms) {
    const Result<size_t> room = findRoom(scene.rooms, name);
    if (!room) return Error{"--rooms: " + room.error()};
    out.push_back(room.value());
  }
  std::sort(out.begin(), out.end());
  out.erase(std::unique(out.begin(), out.end()), out.end());
  return out;
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

// Which file of a home a page written before names; empty: none.
std::string fileOfPage(const std::filesystem::path& index) {
  const Result<std::string> page = readTextFile(index);
  if (!page) return {};
  const std::string_view text = page.value();
  constexpr std::string_view kLink = "<link id=\"roomlight-home\" href=\"";
  const size_t at = text.find(kLink);
  if (at == text.npos) return {};
  const std::string_view rest = text.substr(at + kLink.size());
  const std::string name(rest.substr(0, rest.find('"')));
  return name.starts_with("home-") && name.ends_with(".glb") && name.find('/') == name.npos ? name : std::string();
}

// Into a folder: the home's file is named by what is in it, so that browsers may keep it for ever. That of a
// page before goes.
Status writeFolder(const BakeOptions& o, const BakePlan& plan, const std::string& glb) {
  Hash hash;
  hash.bytes(glb);
  const std::string file = fmt::format("home-{}.glb", hash.text());
  const Result<std::string> page = bake::pageWithLink(plan.page, titleOf(o), file);
  if (!page) return Error{page.error()};
  const std::filesystem::path folder = o.output, index = folder / "index.html";
  const std::string before = std::filesystem::exists(index) ? fileOfPage(index) : "";
  if (const Status s = writeWhole(folder / file, glb); !s) return s;
  if (const Status s = writeWhole(index, page.value()); !s) return s;
  std::error_code left;
  if (!before.empty() && before != file) std::filesystem::remove(folder / before, left);
  return Ok{};
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

std::string interruptedLine(const BakeOptions& o, const bake::KeptLight& kept) {
  return kept.any() ? fmt::format(
                          "interrupted before all light was found; what was found is kept in {}: the same "
                          "command goes on from there",
                          keptIn(o).string())
                    : "interrupted before all light was found; nothing was written";
}

// Of all that was written for the home.
size_t writtenBytes(const BakeOptions& o, const bake::BakedHome& b) {
  std::error_code code;
  if (!isFolder(o)) return std::filesystem::file_size(o.output, code);
  return b.glb.bytes.size() + std::filesystem::file_size(std::filesystem::path(o.output) / "index.html", code);
}

// What it took to keep to the budget, or that it was not kept.
void tellBudget(const BakePlan& plan, const bake::BakedHome& b, double bytes, ProgressDisplay& display) {
  if (plan.budgetBytes <= 0) return;
  const bake::BakeSettings &was = plan.settings, &is = b.settings;
  std::string coarser;
  if (is.charts.texelM > was.charts.texelM)
    coarser += fmt::format(", texels of light of {:.0f} cm", static_cast<double>(100 * is.charts.texelM));
  if (is.glb.mostTexturePixels < was.glb.mostTexturePixels)
    coarser += fmt::format(", textures of {} pixels", is.glb.mostTexturePixels);
  if (is.simplifyM > was.simplifyM)
    coarser += fmt::format(", surfaces up to {:.0f} mm off", static_cast<double>(1000 * is.simplifyM));
  if (!coarser.empty()) display.line("for the budget: " + coarser.substr(2));
  if (bytes > plan.budgetBytes)
    display.line(fmt::format("above the budget of {:.1f} MB: it cannot get smaller; leave out rooms or hours",
                             plan.budgetBytes / 1e6));
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
  Result<std::vector<size_t>> rooms = roomsOf(plan, scene);
  if (!rooms) return failed(rooms.error());
  bake::BakeWish wish{home.value().offLamps, std::move(hours.value()), std::move(rooms.value()), 0, isPage(o)};
  // A page is a part of what it is written into.
  if (plan.budgetBytes > 0) {
    const double left = plan.budgetBytes - static_cast<double>(plan.page.size());
    wish.budgetBytes = static_cast<size_t>(std::max(1.0, left));
  }
  bake::BakeSettings settings = plan.settings;
  settings.layers.kept = bake::KeptLight(keptIn(o));
  const Result<bake::BakedHome> baked = bake::bakeHome(scene, wish, settings, stages);
  if (!baked) return failed(baked.error());
  if (interrupted()) return failed(interruptedLine(o, settings.layers.kept), kInterrupted);
  const bake::BakedHome& b = baked.value();
  if (const Status s = writeBaked(o, plan, b.glb.bytes); !s) return failed(s.error(), kFailed);
  if (!o.stats.empty()) {
    if (const Status s = writeWhole(o.stats, statsJson(scene, b, stats)); !s) return failed(s.error(), kFailed);
  }
  settings.layers.kept.forget();
  const double bytes = static_cast<double>(writtenBytes(o, b));
  display.line(fmt::format("wrote {}: {:.1f} MB, {} layer{} of light on {} places", o.output, bytes / 1e6, b.layers,
                           b.layers == 1 ? "" : "s", b.places));
  tellBudget(plan, b, bytes, display);
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
                  "home.html: one page with everything inside; home.glb: glTF with a light map, for other "
                  "programs; a name without extension: a folder for a web server")
      ->required();
  app->add_option("--quality", o->quality, listed("How much is done:", qualities()))->capture_default_str();
  app->add_option("--hours", o->hours,
                  "Daylight at these hours of the home's day, such as 8,12,16; without it at its own hour alone");
  app->add_option("--rooms", o->rooms,
                  "Names or numbers of the rooms to be walked in, such as Kitchen,Bath; without it all");
  app->add_option("--budget", o->budget,
                  "The size to keep to, such as 20MB: textures, texels of light and simplification are coarser for it");
  app->add_option("--stats", o->stats, "Write sizes, and time and memory of each stage, to this JSON file");
  app->add_option("--threads", o->threads, "Threads; 0: all cores");
  app->add_flag("--quiet", o->quiet, "Only errors");
  app->footer(
      "Ctrl-C ends the work (exit status 130); the light found so far is kept beside the output, and the same command "
      "goes on from there.\n"
      "Examples:\n"
      "  roomlight bake flat.sh3d -o flat.html\n"
      "  roomlight bake flat.sh3d --lighting evening.json --quality draft -o public/flat");
  return {app, [o] { return runBake(*o); }};
}

}  // namespace roomlight::cli
