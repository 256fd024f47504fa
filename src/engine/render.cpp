#include "engine/render.h"

#include <fmt/format.h>

#include <cassert>

#include "base/parallel.h"
#include "engine/light_colour.h"
#include "engine/techniques.h"

namespace roomlight {
namespace {

struct Technique {
  const char* name;
  const char* explanation;
  Result<Picture> (*render)(const Scene&, const Camera&, const RenderSettings&, Stages&);
};

// The default first.
constexpr Technique kTechniques[] = {
    {"hybrid", "exact rays that read light cached in voxels: fast, without leaks", renderHybrid},
    {"cone", "light cached in voxels, gathered by cones: fast", renderCone},
    {"vxgi", "voxel cone tracing with clipmaps, for comparison", renderVxgi},
    {"lpv", "light propagation volumes, for comparison", renderLpv},
    {"photon", "photon mapping with final gathering, for comparison", renderPhoton},
    {"path", "path tracing: the reference, slow and exact up to noise", renderPath},
};

// Pixels that no light can explain. There must be none; a picture that has them says so instead of hiding them.
size_t brokenPixels(const Image& image) {
  size_t count = 0;
  for (const Vec3& p : image.pixels) {
    if (!isFinite(p) || minComponent(p) < 0) ++count;
  }
  return count;
}

}  // namespace

Picture finished(const RayScene& rays, const Camera& camera, Image image, std::vector<RenderedLayer> layers) {
  const Vec3 colour = lightColour(rays, camera, image);
  Sights sights = sightsOf(rays, camera, image.width, image.height);
  return {std::move(image), colour, std::move(sights), std::move(layers)};
}

Result<Rendered> render(const Scene& scene, const Camera& camera, const RenderSettings& settings, const RenderProgress& progress) {
  if (const Status status = checkSettings(settings); !status) return Error{status.error()};
  const Technique* technique = nullptr;
  std::string names;
  for (const Technique& t : kTechniques) {
    if (settings.technique == t.name) technique = &t;
    names += fmt::format("{}{}", names.empty() ? "" : ", ", t.name);
  }
  if (!technique) return Error{fmt::format("technique: unknown name '{}'; there are {}", settings.technique, names)};

  Rendered result;
  Stages stages(progress, result.stats);
  stages.number("triangles", static_cast<double>(scene.triangleCount()));
  std::string error;
  withThreads(settings.threads, [&] {
    Result<Picture> picture = technique->render(scene, camera, settings, stages);
    if (!picture) return static_cast<void>(error = picture.error());
    result.image = std::move(picture.value().image);
    result.lightColour = picture.value().lightColour;
    result.layers = std::move(picture.value().layers);
    result.sights = std::move(picture.value().sights);
  });
  if (!error.empty()) return Error{error};
  result.complete = !stages.cancelled();
  const size_t broken = brokenPixels(result.image);
  assert(broken == 0);
  stages.number("brokenPixels", static_cast<double>(broken));
  return result;
}

std::vector<std::pair<std::string, std::string>> techniques() {
  std::vector<std::pair<std::string, std::string>> list;
  for (const Technique& t : kTechniques) list.emplace_back(t.name, t.explanation);
  return list;
}

}  // namespace roomlight
