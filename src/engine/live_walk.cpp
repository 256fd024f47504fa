#include "engine/live_walk.h"

#include <algorithm>

#include "base/parallel.h"
#include "base/platform/machine.h"
#include "engine/lit_scene.h"
#include "gather/frame.h"
#include "gather/quick_frames.h"

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

// Pictures of the frames, each from those before it.
class FrameMaker {
 public:
  FrameMaker(const LitScene& lit, const RenderSettings& settings)
      : lit_(lit), settings_(settings), history_(settings.frames) {
    if (isQuick()) light_ = lit.snapshot(), settled_ = lit.settled();
  }
  Status check() const {
    if (!isQuick() || light_) return Ok{};
    return Error{"frames.quickMs: technique '" + settings_.technique +
                 "' keeps no light in slots; 'hybrid' and 'cone' do"};
  }

  // After light has followed.
  void follow(const SceneChange& change, const Scene& scene) {
    if (!isQuick()) return history_.sceneChanged(change, scene);
    quick_.sceneChanged(change, scene);
    if (!change.any() && settled_) return;
    settled_ = lit_.settled();
    light_ = lit_.snapshot();
    quick_.lightChanged();
  }
  Image make(const Camera& camera, const Progress& progress) {
    if (!isQuick()) return lit_.picture(camera, settings_.width, settings_.height, progress, &history_);
    return quick_.make({lit_.rays(), lit_.lights(), *light_, {}}, camera, settings_.width, settings_.height,
                       settings_.frames.quickMs, progress);
  }

 private:
  bool isQuick() const { return settings_.frames.quickMs > 0; }

  const LitScene& lit_;
  const RenderSettings& settings_;
  FrameHistory history_;
  QuickFrames quick_;
  std::shared_ptr<const SlotSnapshot> light_;
  bool settled_ = false;
};

Status play(Scene& scene, const Walk& walk, const RenderSettings& settings, const RenderProgress& progress,
            const TakeFrame& take, WalkFrames& out) {
  RenderStats openStats;
  Stages opening(progress, openStats);
  stage(walk, 0, scene);
  const Camera first = cameraAt(walk, 0);
  Result<std::unique_ptr<LitScene>> opened = lightScene(scene, settings, opening, {true, {&first, 1}});
  if (!opened) return Error{opened.error()};
  const std::unique_ptr<LitScene>& lit = opened.value();
  if (lit) lit->update(everythingIn(walk), opening);
  out.opening = openStats.stages;

  const int count = walk.frameCount();
  if (opening.cancelled()) return out.complete = false, Ok{};
  FrameMaker maker(*lit, settings);
  if (const Status can = maker.check(); !can) return can;
  RenderProgress silent;
  silent.cancelled = progress.cancelled;
  for (int frame = 0; frame < count; ++frame) {
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
    lit->lookFrom(camera, stages);
    maker.follow(change, scene);
    f.updateMs = updating.seconds() * 1e3, f.updateCpuMs = (processCpuSeconds() - cpuBefore) * 1e3;
    if (stages.cancelled()) break;
    const Image image = stages.run("gather", [&](const Progress& p) { return maker.make(camera, p); });
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

Result<WalkFrames> measureWalk(Scene& scene, const Walk& walk, const RenderSettings& settings,
                               const RenderProgress& progress, const TakeFrame& take) {
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
  settings.radiance.emittersApart = true;
  settings.vxgi.bouncesAtOnce = 1;  // as the SDK's frames have it
  return settings;
}

}  // namespace roomlight
