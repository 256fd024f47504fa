#include "engine/light_colour.h"
#include "engine/techniques.h"
#include "reference/path_tracer.h"

namespace roomlight {
namespace {

constexpr int kDefaultSamples = 256;
constexpr int kNoLimit = 1 << 24;

}  // namespace

Picture renderPath(const Scene& scene, const Camera& camera, const RenderSettings& settings, Stages& stages) {
  const RayScene rays = stages.run("bvh", [&](const Progress&) { return RayScene(scene); });
  const Lights lights = stages.run("lights", [&](const Progress&) { return Lights(scene); });
  PathSettings path;
  path.width = settings.width;
  path.height = settings.height;
  const bool endsOtherwise = settings.timeLimitS > 0 || settings.noiseLevel > 0;
  path.samples = settings.samples > 0 ? settings.samples : endsOtherwise ? kNoLimit
                                                                         : kDefaultSamples;
  path.timeLimitS = settings.timeLimitS;
  path.noiseLevel = settings.noiseLevel;
  path.lightPaths = settings.path.lightPaths;
  path.filter = settings.path.filter;
  path.seed = settings.seed;
  PathResult result = stages.run("path", [&](const Progress& p) { return pathTrace(rays, lights, camera, path, p); });
  stages.number("samples", result.samples);
  stages.number("noise", std::isfinite(result.noise) ? result.noise : -1);
  stages.number("rays", static_cast<double>(result.rays));
  const Vec3 colour = lightColour(rays, camera, result.image);
  return {std::move(result.image), colour};
}

}  // namespace roomlight
