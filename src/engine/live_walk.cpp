#include "engine/live_walk.h"

#include <algorithm>

#include "base/parallel.h"
#include "engine/lit_scene.h"
#include "gather/frame_history.h"

namespace roomlight {
namespace {

constexpr int kBouncesAFrame = 6;  // light goes on from that of the frame before

void addUp(const std::vector<StageStats>& more, std::vector<StageStats>& sums) {
  for (const StageStats& s : more) {
    const auto known = std::find_if(sums.begin(), sums.end(), [&](const StageStats& k) { return k.name == s.name; });
    if (known == sums.end()) {
      sums.push_back(s);
    } else {
      known->timeMs += s.timeMs, known->cpuMs += s.cpuMs;
      known->peakMemoryMiB = std::max(known->peakMemoryMiB, s.peakMemoryMiB);
    }
  }
}

Status play(Scene& scene, const Walk& walk, const RenderSettings& settings, const RenderProgress& progress, const TakeFrame& take, WalkFrames& out) {
  RenderStats openStats;
  Stages opening(progress, openStats);
  stage(walk, 0, scene);
  const Camera first = cameraAt(walk, 0);
  Result<std::unique_ptr<LitScene>> opened = lightScene(scene, settings, opening, &first);
  if (!opened) return Error{opened.error()};
  const std::unique_ptr<LitScene>& lit = opened.value();
  if (lit) lit->update(everythingIn(walk), opening);
  out.opening = openStats.stages;

  const int count = walk.frameCount();
  FrameHistory history(settings.frames);
  RenderProgress silent;
  silent.cancelled = progress.cancelled;
  for (int frame = 0; frame < count && !opening.cancelled(); ++frame) {
    if (progress.report) progress.report("frames", static_cast<float>(frame) / static_cast<float>(count));
    const double timeS = walk.timeOf(frame);
    RenderStats stats;
    Stages stages(silent, stats);
    WalkFrame f;
    const SceneChange change = stage(walk, timeS, scene);
    const Camera camera = cameraAt(walk, timeS);
    const Stopwatch updating;
    const double cpuBefore = processCpuSeconds();
    lit->update(change, stages);
    history.sceneChanged(change, scene);
    lit->lookFrom(camera, stages);
    f.updateMs = updating.seconds() * 1e3, f.updateCpuMs = (processCpuSeconds() - cpuBefore) * 1e3;
    if (stages.cancelled()) break;
    const Image image = stages.run("gather", [&](const Progress& p) { return lit->picture(camera, settings.width, settings.height, p, &history); });
    if (stages.cancelled()) break;
    f.pictureMs = stats.stages.back().timeMs, f.pictureCpuMs = stats.stages.back().cpuMs;
    out.frames.push_back(f);
    addUp(stats.stages, out.stages);
    if (!take) continue;
    if (const Status s = take({frame, camera, image, lit->rays()}); !s) return s;
  }
  out.complete = !opening.cancelled();
  if (progress.report && out.complete) progress.report("frames", 1);
  return Ok{};
}

}  // namespace

namespace {

// The first frame has none before it to take light from: it is the start of a walk and counts where it is all there is.
template <class Cost>
double rate(const std::vector<WalkFrame>& frames, const Cost& costMs) {
  double ms = 0;
  const size_t first = frames.size() > 1 ? 1 : 0;
  for (size_t i = first; i < frames.size(); ++i) ms += costMs(frames[i]);
  return ms > 0 ? 1e3 * static_cast<double>(frames.size() - first) / ms : 0;
}

}  // namespace

double WalkFrames::framesPerSecond() const {
  return rate(frames, [](const WalkFrame& f) { return f.updateMs + f.pictureMs; });
}

double WalkFrames::framesPerCpuSecond() const {
  return rate(frames, [](const WalkFrame& f) { return f.updateCpuMs + f.pictureCpuMs; });
}

Result<WalkFrames> measureWalk(Scene& scene, const Walk& walk, const RenderSettings& settings, const RenderProgress& progress, const TakeFrame& take) {
  WalkFrames out;
  Status status = Ok{};
  withThreads(settings.threads, [&] { status = play(scene, walk, settings, progress, take, out); });
  atRest(walk, scene);
  if (!status) return Error{status.error()};
  return out;
}

RenderSettings frameSettings(RenderSettings settings) {
  settings.samples = 1;
  settings.path.filter = true;
  settings.radiance.bouncesAtOnce = kBouncesAFrame;
  settings.vxgi.bouncesAtOnce = 1;  // as the SDK's frames have it
  return settings;
}

}  // namespace roomlight
