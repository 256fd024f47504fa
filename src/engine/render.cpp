#include "engine/render.h"

#include <algorithm>
#include <cassert>
#include <limits>

#include "base/parallel.h"
#include "base/progress.h"
#include "engine/technique.h"

namespace roomlight {
namespace {

// Pixels that no light can explain. There must be none; a picture that has them says so instead of hiding them.
size_t brokenPixels(const Image& image) {
  size_t count = 0;
  for (const Vec3& p : image.pixels) {
    if (!isFinite(p) || minComponent(p) < 0) ++count;
  }
  return count;
}

}  // namespace

struct Renderer::State {
  const Scene& scene;
  const RenderSettings settings;
  const std::vector<Camera> cameras;
  const std::optional<LightStore> store;
  std::unique_ptr<LitScene> lit;  // null: there is no light yet

  Result<Picture> picture(const Camera& camera, Stages& stages);
};

// What lighting takes counts against the time of the picture it was found for. Once cancelled it leaves no light.
Result<Picture> Renderer::State::picture(const Camera& camera, Stages& stages) {
  const Stopwatch watch;
  const double limit = settings.timeLimitS > 0 ? settings.timeLimitS : std::numeric_limits<double>::infinity();
  if (!lit) {
    auto made = lightScene(scene, settings, stages,
                           {.changes = false,
                            .cameras = cameras.empty() ? std::span(&camera, 1) : std::span(cameras),
                            .stills = true,
                            .seconds = limit,
                            .store = store && settings.timeLimitS <= 0 ? &*store : nullptr});
    if (!made) return Error{made.error()};
    lit = std::move(made).value();
  } else {
    lit->lookFrom(camera, stages);
  }
  if (!lit || stages.cancelled()) return Picture{};
  return lit->still(camera, std::max(0.0, limit - watch.seconds()), stages);
}

Renderer::Renderer(std::unique_ptr<State> state) : state_(std::move(state)) {}
Renderer::Renderer(Renderer&&) noexcept = default;
Renderer::~Renderer() = default;

Result<Renderer> Renderer::of(const Scene& scene, const RenderSettings& settings, std::vector<Camera> cameras,
                              std::optional<LightStore> store) {
  if (const Status status = checkSettings(settings); !status) return Error{status.error()};
  if (const auto technique = techniqueNamed(settings.technique); !technique) return Error{technique.error()};
  return Renderer(std::unique_ptr<State>(new State{scene, settings, std::move(cameras), std::move(store), {}}));
}

Result<Rendered> Renderer::picture(const Camera& camera, const RenderProgress& progress) {
  Rendered result;
  Stages stages(progress, result.stats);
  stages.number("triangles", static_cast<double>(state_->scene.triangleCount()));
  std::string error;
  withThreads(state_->settings.threads, [&] {
    Result<Picture> picture = state_->picture(camera, stages);
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

}  // namespace roomlight
