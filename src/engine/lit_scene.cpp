#include "engine/lit_scene.h"

#include <fmt/format.h>

#include <algorithm>

#include "engine/sights.h"
#include "engine/technique.h"

namespace roomlight {

SceneRays::SceneRays(const Scene& scene, bool sunApart, Stages& stages)
    : sunApart_(sunApart),
      rays_(stages.run("bvh", [&](const Progress&) { return RayScene(scene); })),
      lights_(stages.run("lights", [&](const Progress&) { return Lights(scene, sunApart); })) {}

void SceneRays::follow(const SceneChange& change, Stages& stages) {
  const Scene& scene = rays_.scene();
  const bool emitters = !change.glow.empty() || std::any_of(change.moved.begin(), change.moved.end(), [&](uint32_t i) {
    return lights_->emitterOf(i) >= 0 ||
           !isBlack(
               scene.materials[static_cast<size_t>(scene.meshes[static_cast<size_t>(scene.instances[i].mesh)].material)]
                   .emission);
  });
  if (!change.moved.empty()) {
    stages.run("rays", [&](const Progress&) {
      rays_.update(change.moved);
      return true;
    });
  }
  if (change.daylight) {
    stages.run("lights", [&](const Progress&) {
      lights_.emplace(scene, sunApart_);
      return true;
    });
  } else if (change.lamps || emitters) {
    Lights next = stages.run("lights", [&](const Progress&) { return Lights(scene, std::move(*lights_)); });
    lights_.emplace(std::move(next));
  }
}

void LitScene::update(const SceneChange& change, Stages& stages) {
  if (!change.any() && settled()) return;
  base_.follow(change, stages);
  relight(change, stages);
}

Picture LitScene::finished(const Camera& camera, Image image, std::vector<RenderedLayer> layers) const {
  std::vector<const Image*> parts;
  for (const RenderedLayer& l : layers) parts.push_back(&l.image);
  const LightColours colours = lightColours(rays(), camera, image, parts);
  for (size_t i = 0; i < layers.size(); ++i) layers[i].lightColour = colours.parts[i];
  Sights sights = sightsOf(rays(), camera, image.width, image.height);
  return {std::move(image), colours.whole, std::move(sights), std::move(layers)};
}

Result<std::unique_ptr<LitScene>> lightScene(const Scene& scene, const RenderSettings& settings, Stages& stages,
                                             const LitUse& use) {
  if (const Status status = checkSettings(settings); !status) return Error{status.error()};
  const Result<const Technique*> technique = techniqueNamed(settings.technique);
  if (!technique) return Error{technique.error()};
  if (settings.layers && !technique.value()->layers) {
    return Error{fmt::format("layers: technique {} does not keep lamps apart; use {}", settings.technique,
                             techniquesWith(&Technique::layers))};
  }
  Result<std::unique_ptr<LitScene>> out = technique.value()->light(scene, settings, use, stages);
  if (out && stages.cancelled()) return std::unique_ptr<LitScene>();
  return out;
}

}  // namespace roomlight
