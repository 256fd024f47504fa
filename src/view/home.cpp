#include "view/home.h"

namespace roomlight::view {

HomeState ViewHome::atStart() const {
  HomeState state = opened.value_or(editable.atStart);
  if (sun) state.sun = sun->atStart;
  return state;
}

Result<Scene> sceneIn(const ViewHome& home, const HomeState& state) {
  Scene scene = home.scene;
  stage(home.editable, home.editable.atStart, state, scene);
  if (!home.sun || state.sun == home.sun->atStart) return scene;
  Result<SunLight> light = home.sun->at(*state.sun);
  if (!light) return Error{light.error()};
  scene.suns = std::move(light.value().suns);
  if (light.value().sky) scene.sky = std::move(*light.value().sky);
  return scene;
}

}  // namespace roomlight::view
