#include "view/home.h"

namespace roomlight::view {

namespace {

// Nothing changes where there is no light for that moment.
Status putSun(const ViewHome& home, const SunState& sun, Scene& scene) {
  if (sun == home.sun->atStart || (!sun.on && !home.sun->atStart.on)) {
    scene.suns = home.scene.suns, scene.sky = home.scene.sky;
    return Ok{};
  }
  Result<SunLight> light = home.sun->at(sun);
  if (!light) return Error{light.error()};
  scene.suns = std::move(light.value().suns);
  scene.sky = light.value().sky ? std::move(*light.value().sky) : home.scene.sky;
  return Ok{};
}

}  // namespace

HomeState ViewHome::atStart() const {
  HomeState state = opened.value_or(editable.atStart);
  if (sun) state.sun = sun->atStart;
  return state;
}

Result<Scene> sceneIn(const ViewHome& home, const HomeState& state) {
  Scene scene = home.scene;
  stage(home.editable, home.editable.atStart, state, scene);
  if (!home.sun) return scene;
  if (const Status put = putSun(home, *state.sun, scene); !put) return Error{put.error()};
  return scene;
}

SceneChange bring(const ViewHome& home, const HomeState& from, const HomeState& to, Scene& scene) {
  SceneChange change = stage(home.editable, from, to, scene);
  if (home.sun && !(from.sun == to.sun)) change.daylight = putSun(home, *to.sun, scene).ok();
  return change;
}

std::string fileNameOf(const ViewHome& home) {
  constexpr size_t kLongest = 60;
  std::string name = home.name.substr(0, kLongest);
  for (char& c : name) {
    const bool plain =
        (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-' || c == '_';
    if (!plain) c = '_';
  }
  return name.empty() ? "home" : name;
}

}  // namespace roomlight::view
