// A scene made ready by one technique, to be asked as often as one likes: for meters and for pictures of any camera.
#pragma once

#include <memory>
#include <span>

#include "engine/stages.h"
#include "trace/lights.h"
#include "trace/meter.h"
#include "trace/ray_scene.h"

namespace roomlight {

class LitScene {
 public:
  virtual ~LitScene() = default;
  // What falls on each element.
  virtual std::vector<MeterReading> illuminance(std::span<const SurfaceElement> elements, const MeterSettings& settings, const Progress& progress = {}) const = 0;
  // Linear, cd/m², with the quality of the settings the scene was lit with.
  virtual Image picture(const Camera& camera, int width, int height, const Progress& progress = {}) const = 0;

  const RayScene& rays() const { return rays_; }
  const Lights& lights() const { return lights_; }

 protected:
  LitScene(const Scene& scene, bool sunApart, Stages& stages);

 private:
  RayScene rays_;
  Lights lights_;
};

// Refers to the scene, which must be validated. Errors: an unknown technique, settings out of range. Null if cancelled.
Result<std::unique_ptr<LitScene>> lightScene(const Scene& scene, const RenderSettings& settings, Stages& stages);

}  // namespace roomlight
