#include "roomlight/render.h"

#include <fmt/format.h>

#include <chrono>
#include <mutex>

#include "cli/picture_options.h"
#include "conversions.h"
#include "engine/technique.h"
#include "still/cameras.h"
#include "trace/camera_rays.h"

namespace roomlight::v1 {
namespace {

std::string placeOf(const std::optional<Vec3>& place) {
  return place ? fmt::format("{},{},{}", place->x, place->y, place->z) : "";
}

Result<ViewWish> toInternal(const View& view) {
  cli::ViewOptions options;
  options.view = view.kind, options.level = view.level, options.room = view.room, options.backdrop = view.backdrop;
  options.eye = placeOf(view.eye), options.target = placeOf(view.target);
  options.fovDeg = view.verticalFovDeg, options.cutM = view.cutM, options.metresPerPixel = view.metresPerPixel;
  const roomlight::Result<ViewWish> wish = cli::readViewWish(options, !view.camera.empty());
  if (!wish) return badInput(wish.error());
  return wish.value();
}

}  // namespace

struct Renderer::State {
  Home home;
  RenderSettings settings;
  std::vector<View> views;
  std::vector<Viewed> viewed;
  std::optional<Scene> part;  // in reach of the cameras; none: all of the home
  std::optional<roomlight::Renderer> renderer;
  std::timed_mutex one;
};

namespace {

// Cameras and size of all views, which have one.
Status see(bool sizeIsSaid, Renderer::State& state) {
  for (const View& view : state.views) {
    Result<ViewWish> wish = toInternal(view);
    if (!wish) return wish.error();
    if (sizeIsSaid) wish->size = {state.settings.width, state.settings.height};
    const std::vector<std::string> names = view.camera.empty() ? std::vector<std::string>() : std::vector{view.camera};
    const roomlight::Result<std::vector<Viewed>> viewed =
        viewsOf(names, state.home.state().opened, state.settings, *wish);
    if (!viewed) return badInput(fmt::format("{}: {}", state.home.state().file, viewed.error()));
    state.viewed.push_back(viewed.value().front());
  }
  const Viewed& first = state.viewed.front();
  for (const Viewed& v : state.viewed) {
    if (v.width != first.width || v.height != first.height)
      return badInput("the views of a renderer have one size; give width and height");
  }
  state.settings.width = first.width, state.settings.height = first.height;
  return Done{};
}

std::vector<Camera> camerasOf(const Renderer::State& state) {
  std::vector<Camera> cameras;
  for (const Viewed& v : state.viewed) cameras.push_back(v.camera);
  return cameras;
}

}  // namespace

Result<RenderSettings> toInternal(const Settings& settings) {
  RenderSettings s;
  if (!settings.quality.empty()) {
    if (const auto status = applyQuality(settings.quality, s); !status) return badInput(status.error());
  }
  if (!settings.json.empty()) {
    const roomlight::Result<RenderSettings> read = settingsFromJson(settings.json, "json", s, settings.quality);
    if (!read) return badInput(read.error());
    s = read.value();
  }
  if (!settings.technique.empty()) s.technique = settings.technique;
  if (settings.width != 0) s.width = settings.width;
  if (settings.height != 0) s.height = settings.height;
  if (settings.samples != 0) s.samples = settings.samples;
  if (settings.seed != 0) s.seed = settings.seed;
  if (settings.threads != 0) s.threads = settings.threads;
  if (settings.timeLimitS != 0) s.timeLimitS = settings.timeLimitS;
  if (settings.noiseLevel != 0) s.noiseLevel = settings.noiseLevel;
  s.layers = s.layers || settings.layers;
  s.layersByRoom = s.layersByRoom || settings.layersByRoom;
  if (const auto status = checkSettings(s); !status) return badInput(status.error());
  const roomlight::Result<const Technique*> technique = techniqueNamed(s.technique);
  if (!technique) return badInput(technique.error());
  if (s.layers && !technique.value()->layers)
    return badInput(fmt::format("layers: technique {} does not keep lamps apart; use {}", s.technique,
                                techniquesWith(&Technique::layers)));
  return s;
}

Result<Renderer> Renderer::of(const Home& home, const Settings& settings, const std::vector<View>& views) {
  return guardedOn(settings.threads, [&]() -> Result<Renderer> {
    Result<RenderSettings> read = toInternal(settings);
    if (!read) return read.error();
    const auto state = std::shared_ptr<State>(
        new State{home, std::move(*read), views.empty() ? std::vector<View>(1) : views, {}, {}, {}, {}});
    const RenderSettings usual;
    const bool sizeIsSaid = state->settings.width != usual.width || state->settings.height != usual.height ||
                            settings.width != 0 || settings.height != 0;
    const home::OpenedHome& opened = home.state().opened;
    if (opened.photo)
      takePhotoWish(*opened.photo, sizeIsSaid, !settings.quality.empty() || !settings.json.empty(), state->settings);
    if (const Status s = see(sizeIsSaid, *state); !s) return s.error();
    if (const auto s = checkSettings(state->settings); !s) return badInput(s.error());
    const std::vector<Camera> cameras = camerasOf(*state);
    state->part = partInReach(opened.scene, state->settings, cameras, cameras);
    roomlight::Result<roomlight::Renderer> renderer =
        roomlight::Renderer::of(state->part ? *state->part : opened.scene, state->settings, cameras);
    if (!renderer) return badInput(renderer.error());
    state->renderer.emplace(std::move(renderer).value());
    return Renderer(state);
  });
}

size_t Renderer::viewCount() const { return state_->viewed.size(); }

Result<Picture> Renderer::picture(size_t view, const Progress& progress) {
  if (view >= state_->viewed.size())
    return badInput(fmt::format("view {}: there are {}, numbered from 0", view, state_->viewed.size()));
  const auto turn = turnAt(state_->one, progress);
  if (!turn) return interrupted();
  return guardedOn(state_->settings.threads, [&]() -> Result<Picture> {
    const Camera& camera = state_->viewed[view].camera;
    roomlight::Result<Rendered> rendered = state_->renderer->picture(camera, v1::toInternal(progress));
    if (!rendered) return badInput(rendered.error());
    if (rendered.value().image.pixels.empty()) return interrupted();
    return pictureOf(std::move(rendered).value(), camera, state_->views[view].kind, state_->settings, state_->home);
  });
}

Result<Picture> render(const Home& home, const View& view, const Settings& settings, const Progress& progress) {
  Result<Renderer> renderer = Renderer::of(home, settings, {view});
  if (!renderer) return renderer.error();
  return renderer->picture(0, progress);
}

std::vector<std::pair<std::string, std::string>> techniques() { return describedTechniques(); }
std::vector<std::pair<std::string, std::string>> qualities() { return roomlight::qualities(); }

}  // namespace roomlight::v1
