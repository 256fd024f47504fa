#include "engine/render.h"

#include <fmt/format.h>

#include <cassert>

#include "base/parallel.h"
#include "engine/light_colour.h"
#include "engine/techniques.h"

namespace roomlight {
namespace {

// Every picture by itself.
template <auto kRender>
PictureOf oneByOne(const Scene& scene, const RenderSettings& settings) {
  return [&scene, &settings](const Camera& camera, Stages& stages) { return kRender(scene, camera, settings, stages); };
}

struct Technique {
  const char* name;
  const char* explanation;
  PictureOf (*pictures)(const Scene&, const RenderSettings&);
};

// The default first.
constexpr Technique kTechniques[] = {
    {"hybrid", "exact rays that read light cached in voxels: fast, without leaks", picturesByRays},
    {"cone", "light cached in voxels, gathered by cones: fast", picturesByCones},
    {"vxgi", "voxel cone tracing with clipmaps, for comparison", oneByOne<renderVxgi>},
    {"lpv", "light propagation volumes, for comparison", oneByOne<renderLpv>},
    {"photon", "photon mapping with final gathering, for comparison", oneByOne<renderPhoton>},
    {"path", "path tracing: the reference, slow and exact up to noise", oneByOne<renderPath>},
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

struct Renderer::State {
  State(const Scene& s, const RenderSettings& how, const Technique& technique)
      : scene(s), settings(how), pictures(technique.pictures(s, settings)) {}
  const Scene& scene;
  const RenderSettings settings;
  const PictureOf pictures;
};

Renderer::Renderer(std::unique_ptr<State> state) : state_(std::move(state)) {}
Renderer::Renderer(Renderer&&) noexcept = default;
Renderer::~Renderer() = default;

Result<Renderer> Renderer::of(const Scene& scene, const RenderSettings& settings) {
  if (const Status status = checkSettings(settings); !status) return Error{status.error()};
  std::string names;
  for (const Technique& t : kTechniques) {
    if (settings.technique == t.name) return Renderer(std::make_unique<State>(scene, settings, t));
    names += fmt::format("{}{}", names.empty() ? "" : ", ", t.name);
  }
  return Error{fmt::format("technique: unknown name '{}'; there are {}", settings.technique, names)};
}

Result<Rendered> Renderer::picture(const Camera& camera, const RenderProgress& progress) {
  Rendered result;
  Stages stages(progress, result.stats);
  stages.number("triangles", static_cast<double>(state_->scene.triangleCount()));
  std::string error;
  withThreads(state_->settings.threads, [&] {
    Result<Picture> picture = state_->pictures(camera, stages);
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

Result<Rendered> render(const Scene& scene, const Camera& camera, const RenderSettings& settings,
                        const RenderProgress& progress) {
  Result<Renderer> renderer = Renderer::of(scene, settings);
  if (!renderer) return Error{renderer.error()};
  return renderer.value().picture(camera, progress);
}

std::vector<std::pair<std::string, std::string>> techniques() {
  std::vector<std::pair<std::string, std::string>> list;
  for (const Technique& t : kTechniques) list.emplace_back(t.name, t.explanation);
  return list;
}

}  // namespace roomlight
