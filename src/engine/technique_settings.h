// What the settings of a picture mean for the stages of each technique.
#pragma once

#include <algorithm>
#include <cmath>
#include <memory>

#include "engine/lit_scene.h"
#include "engine/render.h"
#include "engine/settings.h"
#include "trace/lights.h"

namespace roomlight {

// Size, samples and seed of all techniques in the settings of one.
template <class Settings>
Settings stageOf(const RenderSettings& from, Settings to) {
  to.width = from.width;
  to.height = from.height;
  to.seed = from.seed;
  if (from.samples > 0) to.samples = from.samples;
  return to;
}

// For a picture of another size.
template <class Settings>
Settings sized(Settings settings, int width, int height) {
  settings.width = width, settings.height = height;
  return settings;
}

// For one picture of a lit scene.
template <class Settings>
Settings asked(const Settings& settings, const PictureWish& wish) {
  Settings out = sized(settings, wish.width, wish.height);
  if (wish.samples > 0) out.samples = wish.samples;
  if (wish.seed) out.seed = *wish.seed;
  out.white = wish.white;
  if constexpr (requires { out.orNothing; }) out.orNothing = wish.orNothing;
  return out;
}

// For a gather that ends after `seconds`, where they are finite, but never before its first pass.
template <class Settings>
Settings within(double seconds, Settings settings) {
  if (std::isfinite(seconds)) settings.timeLimitS = std::max(1e-3, seconds);
  return settings;
}

// The light layers that the settings ask for: null where that is nothing.
Result<std::shared_ptr<const LightLayers>> wantedLayers(const Scene& scene, const Lights& lights,
                                                        const RenderSettings& settings);

// With what they are; none where `lights` is null.
std::vector<RenderedLayer> described(const LightLayers* lights, std::vector<Image> images);

}  // namespace roomlight
