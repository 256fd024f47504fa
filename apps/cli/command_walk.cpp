// roomlight walk: a recorded walk through a home in which things move, frame by frame.
#include <fmt/format.h>

#include <memory>

#include "arguments.h"
#include "base/image_io.h"
#include "base/parallel.h"
#include "base/write_file.h"
#include "commands.h"
#include "console.h"
#include "engine/live_walk.h"
#include "engine/settings.h"
#include "engine/sights.h"
#include "engine/stages.h"
#include "engine/technique.h"
#include "exit_status.h"
#include "import/walk_file.h"
#include "output_files.h"
#include "picture_options.h"
#include "walk_stills.h"

namespace roomlight::cli {
namespace {

struct WalkOptions : SettingsOptions, SceneOptions {
  std::string walk, output, stats, stills;
  DisplayOptions display;
  int frames = 0;
  bool inARow = false;
  bool quiet = false;
};

struct WalkPlan {
  RenderSettings settings;
  Display display;
  home::OpenWish open;
};

Result<RenderSettings> frameSettingsOf(const WalkOptions& o) {
  Result<RenderSettings> settings = readSettings(o, o.stills.empty() ? frameSettings({}) : RenderSettings());
  if (!settings) return Error{settings.error()};
  const RenderSettings& s = settings.value();
  if (const Status status = checkSettings(s); !status) return Error{status.error()};
  if (const Status status = checkTechnique(s.technique); !status) return Error{status.error()};
  return s;
}

// The frame's number stands where the name says %d, %03d or the like.
Result<std::string> frameFile(const std::string& pattern, int number) {
  const size_t percent = pattern.find('%'), d = percent == std::string::npos ? percent : pattern.find('d', percent);
  const std::string digits = d == std::string::npos ? "" : pattern.substr(percent + 1, d - percent - 1);
  const auto width = digits.empty() ? std::optional(0) : parseNumber<int>(digits);
  if (d == std::string::npos || !width || *width < 0 || *width > 9 || pattern.find('%', d) != std::string::npos)
    return Error{fmt::format("{}: has no place for the frame's number; write it as in frame_%03d.png", pattern)};
  return fmt::format("{}{:0{}}{}", pattern.substr(0, percent), number, *width, pattern.substr(d + 1));
}

Status checkFiles(const WalkOptions& o) {
  if (!o.stills.empty() && o.output.empty()) return Error{"--stills: add -o frame_%03d.png"};
  if (!o.stills.empty() && !o.stats.empty()) return Error{"--stats: is of a walk; leave it out with --stills"};
  if (!o.output.empty()) {
    const Result<std::string> first = frameFile(o.output, 0);
    if (!first) return Error{first.error()};
    const std::string e = lowerExtension(first.value());
    if (e != ".exr" && e != ".png" && e != ".jpg")
      return Error{fmt::format("{}: unknown kind of picture '{}'; use .exr, .png or .jpg", o.output, e)};
    if (const Status s = checkWritable(first.value()); !s) return s;
  }
  if (!o.stats.empty()) {
    if (const Status s = checkWritable(o.stats); !s) return s;
  }
  return checkDistinct({o.scene, o.walk, o.lighting, o.settingsFile, o.stats, o.output, o.writeLighting});
}

// Writes frames exposed and balanced alike, by the first.
class FrameWriter {
 public:
  FrameWriter(const std::string& pattern, const Display& display) : pattern_(pattern), display_(display) {}
  Status operator()(const ShownFrame& frame) {
    const Result<std::string> file = frameFile(pattern_, frame.number);
    if (!file) return Error{file.error()};
    const std::string extension = lowerExtension(file.value());
    if (extension == ".exr") return writeExr(file.value(), frame.image, {});
    if (!ev100_) {
      ev100_ = ev100Of(display_, frame.image);
      white_ = whiteOf(display_, lightColour(frame.rays, frame.camera, frame.image));
    }
    return write(file.value(), frame.image);
  }

  // Exposure and white of all frames.
  void exposeBy(const Rendered& picture) {
    ev100_ = ev100Of(display_, picture.image), white_ = whiteOf(display_, picture.lightColour);
  }
  Status still(int number, const Image& image) const {
    const Result<std::string> file = frameFile(pattern_, number);
    if (!file) return Error{file.error()};
    return lowerExtension(file.value()) == ".exr" ? writeExr(file.value(), image, {}) : write(file.value(), image);
  }

 private:
  Status write(const std::string& file, const Image& image) const {
    const Image shown = displayed(image, display_, white_, *ev100_);
    return lowerExtension(file) == ".jpg" ? writeJpeg(file, shown, SIZE_MAX) : writePng(file, shown, {});
  }

  const std::string pattern_;
  const Display display_;
  std::optional<float> ev100_;
  White white_;
};

std::string statsJson(const RenderSettings& settings, const WalkFrames& result) {
  auto frames = nlohmann::ordered_json::array();
  for (const WalkFrame& f : result.frames)
    frames.push_back({{"updateMs", f.updateMs},
                      {"updateCpuMs", f.updateCpuMs},
                      {"pictureMs", f.pictureMs},
                      {"pictureCpuMs", f.pictureCpuMs}});
  const nlohmann::ordered_json json = {{"technique", settings.technique},
                                       {"width", settings.width},
                                       {"height", settings.height},
                                       {"framesPerSecond", result.framesPerSecond()},
                                       {"framesPerCpuSecond", result.framesPerCpuSecond()},
                                       {"opening", stagesJson(result.opening)},
                                       {"stages", stagesJson(result.stages)},
                                       {"frames", frames}};
  return json.dump(2) + "\n";
}

void printResult(const WalkFrames& result) {
  const double n = std::max(1.0, static_cast<double>(result.frames.size()));
  double update = 0, picture = 0;
  for (const WalkFrame& f : result.frames) update += f.updateMs, picture += f.pictureMs;
  fmt::print("frames              {}\n", result.frames.size());
  fmt::print("framesPerSecond     {:.2f}\n", result.framesPerSecond());
  fmt::print("framesPerCpuSecond  {:.2f}\n", result.framesPerCpuSecond());
  fmt::print("updateMs            {:.1f}\n", update / n);
  fmt::print("pictureMs           {:.1f}\n", picture / n);
  for (const StageStats& s : result.stages)
    fmt::print("  {:<17} {:.1f} ms, {:.1f} ms of processor time a frame\n", s.name, s.timeMs / n, s.cpuMs / n);
}

int workStills(const WalkOptions& o, const WalkPlan& plan, Scene& scene, const Walk& walk,
               const RenderProgress& progress) {
  const Result<FrameRange> range = readFrameRange(o.stills, walk.frameCount());
  if (!range) return failed(range.error());
  FrameWriter writer(o.output, plan.display);
  if (lowerExtension(o.output) != ".exr") {
    const Result<Rendered> first = exposureFrame(scene, walk, plan.settings);
    if (!first) return failed(first.error());
    writer.exposeBy(first.value());
  }
  std::string unwritten;
  const Result<bool> complete = renderStills(scene, walk, range.value(), plan.settings, progress,
                                             [&](int number, const Camera&, const Rendered& picture) {
                                               const Status s = writer.still(number, picture.image);
                                               if (!s) unwritten = s.error();
                                               return s;
                                             });
  if (!complete) return failed(complete.error(), unwritten.empty() ? kBadInput : kFailed);
  return complete.value() ? kOk : failed("interrupted; frames are missing", kInterrupted);
}

int workWalk(const WalkOptions& o, const WalkPlan& plan) {
  ProgressDisplay display(o.quiet);
  RenderProgress progress{[&](const std::string& stage, float f) { display.report(stage, f); }, &interrupted(), {}};
  RenderStats loadStats;
  Stages loading(progress, loadStats);
  Result<home::OpenedHome> home = loading.run("load", [&](const Progress&) { return home::openHome(plan.open); });
  if (!home) return failed(home.error());
  if (const Status s = writeAddedLight(o, home.value()); !s) return failed(s.error());
  Scene& scene = home.value().scene;
  Result<Walk> walk = readWalkFile(o.walk, scene);
  if (!walk) return failed(walk.error());
  if (o.frames > 0 && o.frames < walk.value().frameCount()) {
    if (o.inARow) {
      walk.value().seconds = o.frames / walk.value().framesPerSecond;
    } else {
      walk.value().framesPerSecond = o.frames / walk.value().seconds;
    }
  }
  if (!o.quiet) printOpened(o, home.value());
  if (!o.stills.empty()) return workStills(o, plan, scene, walk.value(), progress);
  std::string unwritten;
  TakeFrame take;
  if (!o.output.empty()) {
    take = [&, writer = FrameWriter(o.output, plan.display)](const ShownFrame& frame) mutable {
      const Status s = writer(frame);
      if (!s) unwritten = s.error();
      return s;
    };
  }
  const Result<WalkFrames> result = measureWalk(scene, walk.value(), plan.settings, progress, take);
  if (!result) return failed(result.error(), unwritten.empty() ? kBadInput : kFailed);
  if (result.value().frames.empty()) return failed("interrupted before there was a picture", kInterrupted);
  if (!o.stats.empty()) {
    if (const Status s = writeWhole(o.stats, statsJson(plan.settings, result.value())); !s)
      return failed(s.error(), kFailed);
  }
  printResult(result.value());
  return result.value().complete ? kOk : kInterrupted;
}

int runWalk(const WalkOptions& o) {
  interrupted();  // from here on Ctrl-C is ours
  const Result<RenderSettings> settings = frameSettingsOf(o);
  if (!settings) return failed(settings.error());
  Result<Display> display = readDisplay(o.display);
  if (!display) return failed(display.error());
  display.value().localExposure = o.display.localExposure.value_or(0);  // frames shall be exposed alike
  if (const Status s = checkFiles(o); !s) return failed(s.error());
  Result<home::OpenWish> open = readSceneOptions(o);
  if (!open) return failed(open.error());
  const WalkPlan plan{settings.value(), std::move(display.value()), std::move(open.value())};
  if (o.stills.empty()) return workWalk(o, plan);
  int code = kFailed;
  withThreads(plan.settings.threads, [&] { code = workWalk(o, plan); });
  return code;
}

}  // namespace

Registered addWalk(CLI::App& program) {
  const auto o = std::make_shared<WalkOptions>();
  CLI::App* app = program.add_subcommand(
      "walk", "Walk through a home in which things move, and tell how many frames a second that makes");
  addSceneOptions(*app, *o, "SCENE");
  app->add_option("--walk", o->walk,
                  "Walk file: the camera's way, what moves, which lamps are dimmed (docs/reference/walk.md)")
      ->required();
  app->add_option("--technique", o->technique, listed("How light is computed:", describedTechniques()));
  app->add_option("--quality", o->quality, listed("How much is done, if nothing else says so:", qualities()));
  app->add_option("--size", o->size, "Width and height of a frame in pixels, by default 960x540");
  app->add_option("--samples", o->samples, "Samples per pixel of a frame, by default 1; 0: those of a picture");
  app->add_option("--frames", o->frames, "Only so many frames, spread evenly; 0: all")->check(CLI::Range(0, 1000000));
  app->add_flag("--in-a-row", o->inARow, "Not spread: the first --frames of them");
  app->add_option("--stills", o->stills,
                  "These frames, such as 17 or 10-19 from 0, as pictures of which none depends on another");
  app->add_option("-o,--output", o->output, "Writes the frames: FOLDER/frame_%03d.png, .jpg or .exr");
  app->add_option("--stats", o->stats, "Write the times of every frame to this JSON file");
  app->add_option("--seed", o->seed, "Random seed; the same seed gives the same frames");
  app->add_option("--threads", o->threads, "Threads; 0: all cores");
  addDisplayOptions(*app, o->display, ".png and .jpg");
  app->add_option("--settings", o->settingsFile, "JSON with settings; options given here go first");
  app->add_flag("--quiet", o->quiet, "Only results and errors");
  app->footer(
      "Ctrl-C ends the walk and tells of the frames so far (exit status 130).\n"
      "Example: roomlight walk flat.sh3d --walk flat_walk.json --lighting flat_day.json --size 480x270 -o "
      "frames/frame_%03d.png");
  return {app, [o] { return runWalk(*o); }};
}

}  // namespace roomlight::cli
