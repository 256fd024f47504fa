// The light of a home as layers on the elements of an atlas: of each lamp or group of lamps, of the sun, of the sky.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "bake/atlas.h"
#include "bake/kept_light.h"
#include "bake/sun_mask.h"
#include "engine/lit_scene.h"
#include "engine/settings.h"

namespace roomlight::bake {

constexpr float kLeanOfOne = 511.0f / 512;  // which texels store most exactly

enum class LayerRole : uint8_t { Lamp, Sun, Sky };

struct BakedLayer {
  std::string name;
  LayerRole role = LayerRole::Lamp;
  Vec3 color{1, 1, 1};  // linear Rec.709 of its light, luminance 1
  Vec3 position;        // of lamps
  bool on = true;
  double hour = 0;      // local time, of sun and sky
  std::vector<Vec3> lux{};       // on each element; of a layer with a sun what does not come straight from it
  std::vector<float> errorLux{}; // standard error of its luminance, likewise
  // On each element with a normal map: how light leans along the chart's axes, U / (4 E) + 1/2, V / (4 E) + 1/2, 1, all
  // times kLeanOfOne; zero on others. Empty: there are none. A place turned to a U + b V + c N has a U + b V + c E.
  std::vector<Vec3> lean{};
  std::optional<Sun> sun{};  // whose straight light
  SunMask mask{};  // is here
  Image panorama{};  // of the sky, equirectangular, cd/m²
};

constexpr size_t kTogether = 8;  // places that follow one another get as many samples

struct LayerSettings {
  RenderSettings render;  // technique, voxels, cached light
  MeterSettings meters{0.2, 16, 32, 0, true, kTogether};
  KeptLight kept;  // readings of runs before
};

struct LampLayers {
  std::vector<BakedLayer> layers;
  std::vector<int32_t> ofInstance;  // the layer that what shines on it belongs to, -1: none
};

// All lamps and what else shines, at full strength. Where there are too many to be told apart, those of a room are one.
Result<LampLayers> lampLayers(const Scene& scene, const std::vector<SurfaceElement>& elements,
                              const LayerSettings& settings, Stages& stages);

// All suns, and the sky, as the scene has them. A sun that gives nothing is left out; a sky tells that its hour is
// known. What comes straight from a sun that is alone stands apart, on `cells`.
Result<std::vector<BakedLayer>> daylightLayers(const Scene& scene, double hour,
                                               const std::vector<SurfaceElement>& elements, const SunCells& cells,
                                               const LayerSettings& settings, Stages& stages);

}  // namespace roomlight::bake
