#include "engine/time_plan.h"

#include <cmath>

#include "filter/blend.h"
#include "reference/path_tracer.h"

namespace roomlight {
namespace {

constexpr int kFewestSamples = 2;         // one alone tells nothing of its noise
constexpr double kBlendInPasses = 1;      // time of a blend, before there was one
constexpr double kLookAgain = 1.4;        // times the samples of the last blend: when the error is estimated again

PathSettings pathSettings(const RenderSettings& settings) {
  PathSettings path = settings.path;
  path.width = settings.width, path.height = settings.height;
  // Other random numbers than those of the picture.
  path.seed = settings.seed + 1;
  return path;
}

double secondsOfAPass(const TracedScene& scene, const Camera& camera, PathSettings path) {
  const double pixels = static_cast<double>(path.width) * path.height;
  const int divisor = triedPart(path.width, path.height);
  path.width = (path.width + divisor - 1) / divisor, path.height = (path.height + divisor - 1) / divisor;
  PathTracer small(scene.rays, scene.lights, camera, path, true);
  const Stopwatch watch;
  small.pass();
  return watch.seconds() * pixels / (static_cast<double>(path.width) * path.height);
}

struct TimeLeft {
  double seconds;  // altogether
  double pass;     // that a pass takes, as tried
};

class Refinement {
 public:
  Refinement(const TracedScene& scene, const Camera& camera, const RenderSettings& settings, const TimeLeft& time,
             const Stages& stages, const Image& picture)
      : aim_(settings.blendUntilMse),
        seconds_(time.seconds),
        longest_(time.pass),
        blendSeconds_(kBlendInPasses * time.pass),
        stages_(stages),
        picture_(picture),
        tracer_(scene.rays, scene.lights, camera, pathSettings(settings), true) {}

  void run(const Progress& progress) {
    Progress inner;
    inner.cancelled = progress.cancelled;
    if (progress.report) inner.report = [&](float) { progress.at(done()); };
    while (!progress.stop() && fits(longest_)) {
      const double before = watch_.seconds();
      if (!tracer_.pass(inner)) break;
      longest_ = std::max(0.5 * longest_, watch_.seconds() - before);
      progress.at(done());
      if (tracer_.samples() < kFewestSamples || tracer_.samples() < kLookAgain * blended_ ||
          !fits(blendSeconds_ + longest_))
        continue;
      look();
      if (best_.srgbMse <= aim_) return;
    }
    if (tracer_.samples() >= kFewestSamples && tracer_.samples() > blended_) look();
  }
  const PathTracer& tracer() const { return tracer_; }
  bool improved() const { return blended_ > 0; }
  Blend& best() { return best_; }

 private:
  // Whether so much work, and the blend that must follow, ends in time.
  bool fits(double work) const { return watch_.seconds() + work + blendSeconds_ <= seconds_; }
  float done() const {
    const double byTime = watch_.seconds() / seconds_, byError = improved() ? aim_ / best_.srgbMse : 0;
    return static_cast<float>(std::min(1.0, std::max(byTime, byError)));
  }
  void look() {
    const double before = watch_.seconds();
    best_ = blend(picture_, tracer_.mean(), tracer_.variance(), tracer_.features());
    blended_ = tracer_.samples();
    blendSeconds_ = watch_.seconds() - before;
    stages_.estimate(best_.relativeError, best_.srgbMse);
  }

  const Stopwatch watch_;
  const double aim_, seconds_;
  double longest_, blendSeconds_;
  const Stages& stages_;
  const Image& picture_;
  PathTracer tracer_;
  Blend best_;
  int blended_ = 0;
};

}  // namespace

bool refineByPath(const TracedScene& scene, const Camera& camera, const RenderSettings& settings, double seconds,
                  Stages& stages, Image& picture) {
  const Stopwatch watch;
  const double pass = std::isfinite(seconds) ? secondsOfAPass(scene, camera, pathSettings(settings)) : 0;
  const double left = seconds - watch.seconds();
  if ((kFewestSamples + kBlendInPasses) * pass > left) return false;
  Refinement refinement(scene, camera, settings, {left, pass}, stages, picture);
  stages.run("refine", [&](const Progress& progress) { return refinement.run(progress), true; });
  if (refinement.improved()) {
    stages.number("estimatedError", refinement.best().relativeError);
    stages.number("estimatedMse", refinement.best().srgbMse);
    picture = std::move(refinement.best().image);
  }
  stages.number("pathSamples", refinement.tracer().samples());
  stages.number("pathRays", static_cast<double>(refinement.tracer().rays()));
  return refinement.improved();
}

}  // namespace roomlight
