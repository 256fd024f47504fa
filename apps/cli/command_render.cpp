// roomlight render: a scene and light in, pictures out.
#include <fmt/format.h>

#include <memory>

#include "arguments.h"
#include "base/image_io.h"
#include "base/parallel.h"
#include "base/write_file.h"
#include "commands.h"
#include "console.h"
#include "light_options.h"
#include "picture_options.h"
#include "engine/settings.h"
#include "engine/render.h"
#include "engine/technique.h"
#include "engine/stages.h"
#include "home/cameras.h"
#include "exit_status.h"
#include "output_files.h"
#include "still/cameras.h"
#include "still/developed.h"
#include "still/layers_file.h"
#include "still/picture_file.h"
#include "look/exposure.h"
#include "measure/false_colour.h"
#include "scene/find_named.h"

namespace roomlight::cli {
namespace {

struct RenderOptions : SettingsOptions, SceneOptions {
  std::vector<std::string> cameras;
  std::string kind = "picture", stats;
  DisplayOptions display;
  std::vector<std::string> outputs;
  std::optional<double> timeLimitS, noiseLevel;
  std::optional<float> voxelSizeM;
  bool layers = false;
  std::optional<std::string> layerGroups;
  bool quiet = false, reproducible = false;
  ViewOptions view;
  LightOptions light;
};

// Everything that can be known to be wrong before any work is done.
struct RenderPlan {
  RenderSettings settings;
  Display display;
  ViewWish view;
  home::OpenWish open;
  std::optional<LightStore> store;
};

Status checkRenderOutputs(const RenderOptions& o) {
  for (const std::string& out : o.outputs) {
    const std::string e = lowerExtension(out);
    if (e != ".exr" && e != ".png" && e != ".jpg")
      return Error{fmt::format("{}: unknown kind of picture '{}'; use .exr, .png or .jpg", out, e)};
    if (e == ".jpg" && o.kind != "picture")
      return Error{fmt::format("{}: .jpg would blur what can be read off the colours; use .png", out)};
    if (e == ".exr" && o.kind == "falsecolour")
      return Error{
          fmt::format("{}: false colours are for looking at; use .png, or --output-kind luminance for .exr", out)};
    if (const Status s = checkWritable(out); !s) return s;
  }
  if (!o.stats.empty()) {
    if (const Status s = checkWritable(o.stats); !s) return s;
  }
  std::vector<std::string> files = {o.scene, o.lighting, o.settingsFile, o.stats, o.writeLighting};
  files.insert(files.end(), o.outputs.begin(), o.outputs.end());
  return checkDistinct(files);
}

Status applyLayerGroups(const RenderOptions& o, RenderSettings& settings) {
  if (o.layerGroups) {
    if (!o.layers) return Error{"--layer-groups goes with --layers"};
    if (*o.layerGroups != "name" && *o.layerGroups != "room")
      return Error{fmt::format("--layer-groups {}: write name or room", *o.layerGroups)};
    settings.layersByRoom = *o.layerGroups == "room";
  }
  if (!settings.layers) return Ok{};
  if (o.kind != "picture") return Error{fmt::format("--output-kind {}: is of one picture; leave out --layers", o.kind)};
  const bool any = std::any_of(o.outputs.begin(), o.outputs.end(),
                               [](const std::string& out) { return lowerExtension(out) == ".exr"; });
  return any ? Status(Ok{}) : Error{"--layers: layers are written into .exr; add -o FILE.exr"};
}

// The cameras that light is found for decide, as they would in a process that takes pictures of them all.
Result<home::OpenWish> openWishOf(const RenderOptions& o) {
  std::vector<std::string> cameras = o.light.lightFor.empty() ? o.cameras : o.light.lightFor;
  const std::string first = cameras.empty() || meansAllCameras(cameras) ? "" : cameras.front();
  Result<home::OpenWish> open = readSceneOptions(o, first);
  if (!open) return open;
  open.value().allCameras = meansAllCameras(cameras) || meansAllCameras(o.cameras);
  if (!o.light.lightFor.empty()) cameras.insert(cameras.end(), o.cameras.begin(), o.cameras.end());
  if (!open.value().allCameras && cameras.size() > 1)
    open.value().moreCameras.assign(cameras.begin() + 1, cameras.end());
  return open;
}

Result<RenderPlan> planRender(const RenderOptions& o) {
  RenderPlan plan;
  Result<RenderSettings> settings = readSettings(o, plan.settings);
  if (!settings) return Error{settings.error()};
  plan.settings = std::move(settings.value());
  RenderSettings& s = plan.settings;
  s.timeLimitS = o.timeLimitS.value_or(s.timeLimitS);
  s.noiseLevel = o.noiseLevel.value_or(s.noiseLevel);
  s.layers = s.layers || o.layers;
  if (const Status status = applyLayerGroups(o, s); !status) return Error{status.error()};
  s.voxel.voxelSizeM = o.voxelSizeM.value_or(s.voxel.voxelSizeM);
  if (const Status status = checkSettings(s); !status) return Error{status.error()};
  Result<home::OpenWish> open = openWishOf(o);
  if (!open) return Error{open.error()};
  plan.open = std::move(open.value());
  const Result<Display> display = readDisplay(o.display);
  if (!display) return Error{display.error()};
  plan.display = display.value();
  if (o.kind != "picture" && o.kind != "luminance" && o.kind != "falsecolour")
    return Error{fmt::format("--output-kind {}: write picture, luminance or falsecolour", o.kind)};
  if (o.kind != "picture" && o.display != DisplayOptions()) {
    return Error{fmt::format(
        "--output-kind {} has a scale of luminance instead of --look, --exposure and the like; leave them out",
        o.kind)};
  }
  if (const Status status = checkTechnique(s.technique); !status) return Error{status.error()};
  Result<std::optional<LightStore>> store = readLightStore(o.light, s);
  if (!store) return Error{store.error()};
  plan.store = std::move(store.value());
  if (s.layers && !findTechnique(s.technique)->layers)
    return Error{fmt::format("--layers: technique {} does not keep lamps apart; use {}", s.technique,
                             techniquesWith(&Technique::layers))};
  const Result<ViewWish> view = readViewWish(o.view, !o.cameras.empty());
  if (!view) return Error{view.error()};
  plan.view = view.value();
  const RenderSettings usual;
  if (!o.size.empty() || s.width != usual.width || s.height != usual.height) plan.view.size = {s.width, s.height};
  return plan;
}

std::string dump(const nlohmann::ordered_json& json, int indent) {
  return json.dump(indent, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
}

// What all pictures of a call have in common.
struct RenderTask {
  const RenderOptions& options;
  const RenderPlan& plan;
  const Scene& scene;  // as opened, whole
};

// A picture, and the files it goes into.
struct Shot {
  Camera camera;
  std::vector<std::string> outputs;
  std::string stats;
};

// How bright things are: .exr in cd/m², .png in grey up to a round luminance or in false colours.
Status writeLuminance(const RenderOptions& o, const Shot& shot, const Rendered& rendered, Metadata metadata) {
  const LightScale scale = luminanceScale(rendered.image);
  metadata["roomlight.lowCdM2"] = fmt::format("{:g}", scale.low);
  metadata["roomlight.highCdM2"] = fmt::format("{:g}", scale.high);
  for (const std::string& out : shot.outputs) {
    const bool exr = lowerExtension(out) == ".exr";
    const Status s = exr                       ? writeExr(out, luminanceOnly(rendered.image), metadata)
                     : o.kind == "falsecolour" ? writePng(out, falseColourPicture(rendered.image, scale), metadata)
                                               : writePng(out, greyPicture(rendered.image, scale.high), metadata);
    if (!s) return s;
  }
  return Ok{};
}

// Writes all outputs; returns the EV100 that they are exposed for.
Result<float> writePictures(const RenderTask& task, const Shot& shot, Rendered& rendered) {
  const RenderOptions& o = task.options;
  const RenderPlan& plan = task.plan;
  const Camera& camera = shot.camera;
  const Development development = developmentOf(task.scene, camera, rendered, plan.display);
  const float ev100 = development.ev100;
  const Metadata metadata =
      metadataOf({plan.settings, o.scene, o.lighting, o.view.view, o.reproducible}, camera, rendered, development);
  if (o.kind != "picture") {
    const Status s = writeLuminance(o, shot, rendered, metadata);
    return s ? Result<float>(ev100) : Error{s.error()};
  }
  std::optional<LayeredImage> layered;
  if (plan.settings.layers) layered = layeredImage(task.scene, camera, rendered, metadata);
  for (const std::string& out : shot.outputs) {
    const Status s = layered && lowerExtension(out) == ".exr"
                         ? writeLayers(out, *layered)
                         : writePicture(out, camera, rendered, development, metadata);
    if (!s) return Error{s.error()};
  }
  return ev100;
}

Status writeStats(const std::string& file, const RenderStats& stats, double totalMs) {
  auto numbers = nlohmann::ordered_json::object();
  for (const auto& [name, value] : stats.numbers) numbers[name] = value;
  return writeWhole(file,
                    dump({{"stages", stagesJson(stats.stages)}, {"numbers", numbers}, {"totalMs", totalMs}}, 2) + "\n");
}

// Of the camera's view: what a first picture is judged by.
void addView(const Scene& scene, const Camera& camera, RenderStats& stats) {
  const RayScene rays(scene);
  const home::Sights sights = home::sightsOf(rays, camera);
  stats.numbers.emplace_back("view.surfaceShare", sights.share(0, kInfinity));
  stats.numbers.emplace_back("view.halfToTenMetresShare", sights.share(0.5f, 10));
  stats.numbers.emplace_back("view.indoors", home::isIndoors(rays, scene.rooms, camera, sights) ? 1 : 0);
}

// What is rendered: the scene under its light, and from where.
struct HomeInView {
  home::OpenedHome opened;
  std::vector<Camera> cameras;   // of the pictures
  std::vector<Camera> lightFor;  // that light is found for
};

Result<HomeInView> loadHomeInView(const RenderOptions& o, RenderPlan& plan) {
  Result<home::OpenedHome> opened = home::openHome(plan.open);
  if (!opened) return Error{opened.error()};
  HomeInView out{std::move(opened.value()), {}, {}};
  if (out.opened.photo)
    takePhotoWish(*out.opened.photo, plan.view.size.has_value(), !o.quality.empty() || !o.settingsFile.empty(),
                  plan.settings);
  // A picture that is taken from elsewhere than where a camera stands leaves these as they are placed.
  const ViewWish& wish = plan.view;
  Result<std::vector<Viewed>> views = std::vector<Viewed>();
  if (!o.light.lightFor.empty()) {
    views = viewsOf(o.light.lightFor, out.opened, plan.settings, isElsewhere(wish) ? ViewWish() : wish);
    if (!views) return Error{fmt::format("{}: --light-for: {}", o.scene, views.error())};
    for (const Viewed& v : views.value()) out.lightFor.push_back(v.camera);
  }
  views = viewsOf(o.cameras, out.opened, plan.settings, wish);
  if (!views) return Error{fmt::format("{}: {}", o.scene, views.error())};
  for (const Viewed& v : views.value()) out.cameras.push_back(v.camera);
  if (o.light.lightFor.empty()) out.lightFor = out.cameras;
  const Viewed& last = views.value().back();
  plan.settings.width = last.width, plan.settings.height = last.height;  // the same for all
  if (const Status s = checkSettings(plan.settings); !s) return Error{s.error()};
  return out;
}

// Its name, or its number in the scene.
std::string nameInFiles(const Scene& scene, const Camera& camera) {
  if (!camera.name.empty()) return camera.name;
  const auto same = std::find_if(scene.cameras.begin(), scene.cameras.end(),
                                 [&](const Camera& c) { return c.name.empty() && seeTheSame(c, camera); });
  return std::to_string(same - scene.cameras.begin());
}

// With names of files that differ from one another and from what is read, and can be written.
Result<std::vector<Shot>> shotsOf(const RenderOptions& o, const Scene& scene, const std::vector<Camera>& cameras) {
  std::vector<std::string> names;
  for (const Camera& c : cameras) names.push_back(nameInFiles(scene, c));
  std::vector<Shot> shots;
  for (const Camera& c : cameras) shots.push_back({c, {}, {}});
  for (const std::string& out : o.outputs) {
    const std::vector<std::string> files = filesNamedAfter(out, names);
    for (size_t i = 0; i < files.size(); ++i) shots[i].outputs.push_back(files[i]);
  }
  if (!o.stats.empty()) {
    const std::vector<std::string> files = filesNamedAfter(o.stats, names);
    for (size_t i = 0; i < files.size(); ++i) shots[i].stats = files[i];
  }
  if (shots.size() == 1) return shots;
  std::vector<std::string> files = {o.scene, o.lighting, o.settingsFile, o.writeLighting};
  for (const Shot& shot : shots) {
    files.insert(files.end(), shot.outputs.begin(), shot.outputs.end());
    if (!shot.stats.empty()) files.push_back(shot.stats);
  }
  if (const Status s = checkDistinct(files); !s) return Error{s.error()};
  for (size_t i = 4; i < files.size(); ++i) {
    if (const Status s = checkWritable(files[i]); !s) return Error{s.error()};
  }
  return shots;
}

// What all pictures have of the first camera.
void tellSharedLight(const RenderOptions& o, const home::OpenedHome& opened, const Camera& first,
                     ProgressDisplay& display) {
  if (!opened.added.empty() || (!opened.daylight.empty() && o.lighting.empty()))
    display.line(fmt::format("all pictures have the light of the first, '{}': {}", first.name,
                             opened.added.empty() ? "its time of day" : "what was added"));
}

// Writes what was rendered and says so; returns the exit status.
int keepPicture(const RenderTask& task, const Shot& shot, Rendered& rendered, const Stopwatch& total,
                ProgressDisplay& display) {
  // The times inside a picture cannot hold the time it takes to write it; the statistics can.
  RenderStats writeStage;
  RenderProgress silent;
  Stages writing(silent, writeStage);
  const Result<float> written =
      writing.run("write", [&](const Progress&) { return writePictures(task, shot, rendered); });
  if (!written) return failed(written.error(), kFailed);
  rendered.stats.stages.push_back(writeStage.stages.front());
  for (const auto& [name, value] : rendered.stats.numbers) {
    if (name == "brokenPixels" && value > 0)
      printWarnings({fmt::format("{} pixels are negative or not finite: a defect, please report it", value)});
  }
  if (!shot.stats.empty()) {
    addView(task.scene, shot.camera, rendered.stats);
    if (const Status s = writeStats(shot.stats, rendered.stats, total.seconds() * 1e3); !s)
      return failed(s.error(), kFailed);
  }
  display.lineOfEstimate();
  if (shot.camera.projection == Projection::Orthographic)
    display.line(fmt::format("one pixel is {:.4g} m",
                             CameraRays(shot.camera, rendered.image.width, rendered.image.height).metresPerPixel()));
  for (const std::string& out : shot.outputs) {
    const std::string exposed = task.options.kind == "picture" && lowerExtension(out) != ".exr"
                                    ? fmt::format(", exposed for EV100 {:.1f}", written.value())
                                    : "";
    display.line(
        fmt::format("wrote {}{}{}", out, exposed, rendered.complete ? "" : " (stopped early: the best so far)"));
  }
  return rendered.complete ? kOk : kInterrupted;
}

// "render" with everything checked; stages of loading come first in the statistics of the first picture.
int workRender(const RenderOptions& o, RenderPlan plan) {
  std::optional<Stopwatch> watch(std::in_place);  // of the picture under way
  ProgressDisplay display(o.quiet);
  RenderProgress progress{[&](const std::string& stage, float f) { display.report(stage, f); }, &interrupted(),
                          [&](double relativeError, double mse) { display.estimate(relativeError, mse); }};
  RenderStats loadStats;
  Stages loading(progress, loadStats);

  Result<HomeInView> home = loading.run("load", [&](const Progress&) { return loadHomeInView(o, plan); });
  if (!home) return failed(home.error());
  const Scene& scene = home.value().opened.scene;
  const Result<std::vector<Shot>> shots = shotsOf(o, scene, home.value().cameras);
  if (!shots) return failed(shots.error());
  if (const Status s = writeAddedLight(o, home.value().opened); !s) return failed(s.error());
  if (!o.quiet) printOpened(o, home.value().opened);
  const std::vector<Camera>& lightFor = home.value().lightFor;
  if (lightFor.size() > 1) tellSharedLight(o, home.value().opened, lightFor.front(), display);
  bool any = false;
  const auto noPicture = [&] {
    return failed(any ? "interrupted; pictures of the other cameras were not begun"
                      : "interrupted before there was a picture; nothing was written",
                  kInterrupted);
  };
  if (interrupted()) return noPicture();

  const std::optional<Scene> part = loading.run(
      "reach", [&](const Progress&) { return partInReach(scene, plan.settings, home.value().cameras, lightFor); });
  if (part)
    display.line(fmt::format("of {} triangles those are used whose light comes to the camera{}: {}",
                             scene.triangleCount(), lightFor.size() > 1 ? "s" : "", part->triangleCount()));
  const bool ranksLight = findTechnique(plan.settings.technique)->sharesLight;
  Result<Renderer> renderer =
      Renderer::of(part ? *part : scene, plan.settings, ranksLight ? lightFor : home.value().cameras, plan.store);
  if (!renderer) return failed(renderer.error());
  const RenderTask task{o, plan, scene};
  for (const Shot& shot : shots.value()) {
    if (interrupted()) return noPicture();
    if (any) watch.emplace();
    Result<Rendered> rendered = renderer.value().picture(shot.camera, progress);
    if (!rendered) return failed(rendered.error());
    if (rendered.value().image.pixels.empty()) return noPicture();
    if (!any)
      rendered.value().stats.stages.insert(rendered.value().stats.stages.begin(), loadStats.stages.begin(),
                                           loadStats.stages.end());
    any = true;
    if (const int status = keepPicture(task, shot, rendered.value(), *watch, display); status != kOk) return status;
  }
  return kOk;
}

int runRender(const RenderOptions& o) {
  interrupted();  // from here on Ctrl-C is ours
  const Result<RenderPlan> plan = planRender(o);
  if (!plan) return failed(plan.error());
  if (const Status s = checkRenderOutputs(o); !s) return failed(s.error());
  int code = kFailed;
  withThreads(plan.value().settings.threads, [&] { code = workRender(o, plan.value()); });
  return code;
}

}  // namespace

Registered addRender(CLI::App& program) {
  const auto o = std::make_shared<RenderOptions>();
  CLI::App* app = program.add_subcommand("render", "Light a scene and write the picture");
  addSceneOptions(*app, *o, "SCENE");
  app->add_option("-o,--output", o->outputs,
                  "Picture: .exr (linear, cd/m2), .png or .jpg (tone-mapped); may be repeated")
      ->required()
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  app->add_option("--camera", o->cameras,
                  "Name of a camera in the scene (capital or small letters; its beginning where only one fits), or its "
                  "number from 0; repeated, or all: a picture of each, named after it, from light that is found once")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  addLightOptions(*app, o->light);
  addViewOptions(*app, o->view);
  app->add_option("--size", o->size,
                  "Width and height in pixels, for example 960x540; views other than camera choose their own");
  app->add_option("--technique", o->technique, listed("How light is computed:", describedTechniques()));
  app->add_option("--quality", o->quality,
                  listed("How much is done for a picture, if nothing else says so:", qualities()));
  app->add_option("--samples", o->samples, "Samples per pixel; 0: the technique's default");
  app->add_option(
      "--time-limit", o->timeLimitS,
      "Be done this many seconds after loading, with the best picture for that; every pixel has light in any case");
  app->add_option("--noise-level", o->noiseLevel,
                  "Stop when noise is below this part of the light, for example 0.02: of the mean over pixels "
                  "(technique path), of every pixel (hybrid)");
  app->add_flag("--layers", o->layers,
                "The light of every lamp, emissive mesh, sun and sky apart: .exr with a layer for each, which add up "
                "to the picture (docs/reference/layers.md)");
  app->add_option("--layer-groups", o->layerGroups,
                  "name: lamps of one name, or of one group in the lighting file, are one layer (the default); room: "
                  "those of one room are");
  app->add_option("--seed", o->seed, "Random seed; the same seed gives the same picture");
  app->add_option("--threads", o->threads, "Threads; 0: all cores");
  app->add_option("--voxel-size", o->voxelSizeM, "Edge of a voxel in metres; 0: chosen from the memory budget");
  addDisplayOptions(*app, o->display, ".png");
  app->add_option("--output-kind", o->kind,
                  "picture; luminance: .exr in cd/m2 without colour, .png in grey; or falsecolour: .png in colours "
                  "that tell luminance, with a legend")
      ->capture_default_str();
  app->add_option("--settings", o->settingsFile, "JSON with settings; options given here go first");
  app->add_option("--stats", o->stats, "Write time and memory of each stage to this JSON file");
  app->add_flag("--reproducible", o->reproducible,
                "Leave times and the number of threads out of the files: the same command writes the same bytes");
  app->add_flag("--quiet", o->quiet, "Only errors");
  app->footer(
      "Ctrl-C ends the work and keeps the best picture so far, if there is one (exit status 130); a second one ends at "
      "once.\n"
      "Examples:\n"
      "  roomlight render flat.glb -o flat.png\n"
      "  roomlight render flat.glb --camera Kitchen --camera Bath -o flat.png      # flat_Kitchen.png, flat_Bath.png\n"
      "  roomlight render flat.glb --technique path --time-limit 60 -o flat.exr -o flat.png --stats flat.json");
  return {app, [o] { return runRender(*o); }};
}

}  // namespace roomlight::cli
