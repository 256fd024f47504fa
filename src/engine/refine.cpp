#include "engine/refine.h"

#include "filter/blend.h"
#include "reference/path_tracer.h"

namespace roomlight {
namespace {

constexpr int kFewestSamples = 2;  // one alone tells nothing of its noise

}  // namespace

void refineByPath(const RayScene& rays, const Lights& lights, const Camera& camera, const RenderSettings& settings, double seconds, Stages& stages, Image& picture) {
  PathSettings path = settings.path;
  path.width = settings.width, path.height = settings.height;
  // Other random numbers than those of the picture.
  path.seed = settings.seed + 1;
  PathTracer tracer(rays, lights, camera, path, true);
  stages.run("refine", [&](const Progress& progress) {
    const Stopwatch watch;
    Progress inner;
    inner.cancelled = progress.cancelled;
    if (progress.report) inner.report = [&](float) { progress.at(static_cast<float>(std::min(1.0, watch.seconds() / seconds))); };
    // A pass that would end after the limit is not begun.
    double longest = 0;
    while (!progress.stop() && watch.seconds() + longest <= seconds) {
      const double before = watch.seconds();
      if (!tracer.pass(inner)) break;
      longest = std::max(longest, watch.seconds() - before);
    }
    if (tracer.samples() < kFewestSamples) return false;
    Blend blended = blend(picture, tracer.mean(), tracer.variance(), tracer.features());
    picture = std::move(blended.image);
    stages.number("estimatedError", blended.relativeError);
    stages.number("estimatedMse", blended.srgbMse);
    return true;
  });
  stages.number("pathSamples", tracer.samples());
  stages.number("pathRays", static_cast<double>(tracer.rays()));
}

}  // namespace roomlight
