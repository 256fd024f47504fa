// A small room for tests of what works on a lit home in the background, in light that follows as a test says.
#pragma once

#include <functional>
#include <memory>
#include <utility>

#include "engine/technique.h"
#include "support/rooms.h"
#include "view/lit_home.h"

namespace roomlight::view {

inline Scene roomWithALamp() {
  Scene scene;
  const int grey = test::addMaterial(scene, test::lambertian(0.5f));
  test::addRoom(scene, {0, 0, 0}, {3, 2.5f, 3}, std::vector<int>(6, grey));
  scene.lamps = {test::pointLamp({1.5f, 2, 1.5f}, 100)};
  scene.lamps[0].name = "Lamp";
  return scene;
}

inline const Technique kToldTechnique{
    .name = "told", .about = "", .role = TechniqueRole::Own, .followsDaylight = true, .meters = {}, .light = nullptr};

// Rays and lights are the scene's; what light does when it is to follow is the test's.
class ToldLight final : public LitScene {
 public:
  using Relight = std::function<void(Stages&)>;
  ToldLight(const Scene& scene, Stages& stages, Relight relight)
      : LitScene(kToldTechnique, scene, true, stages), relight_(std::move(relight)) {}
  std::vector<MeterReading> illuminance(std::span<const SurfaceElement>, const MeterSettings&,
                                        const Progress&) const override {
    return {};
  }
  Image pictureOf(const Camera&, const PictureWish&, const Progress&) const override { return {}; }
  Result<Picture> still(const Camera&, double, Stages&) override { return Picture{}; }

 private:
  void relight(const SceneChange&, Stages& stages) override { relight_(stages); }
  const Relight relight_;
};

struct LitRoom {
  explicit LitRoom(
      ToldLight::Relight relight = [](Stages&) {}, Scene scene = roomWithALamp())
      : all("room", std::move(scene)), solution(std::make_shared<LightSolution>()) {
    solution->scene = all.scene, solution->state = all.atStart();
    RenderStats stats;
    const RenderProgress silent;
    Stages stages(silent, stats);
    solution->lit = std::make_unique<ToldLight>(solution->scene, stages, std::move(relight));
  }
  HomeState dimmed() const {
    HomeState state = all.atStart();
    state.lamps[0].dim = 0.5f;
    return state;
  }

  ViewHome all;
  std::shared_ptr<LightSolution> solution;
};

}  // namespace roomlight::view
