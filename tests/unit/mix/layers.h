// A small picture in layers for tests of mixing.
#pragma once

#include <numbers>

#include "mix/layer_info.h"
#include "mix/mixer.h"

namespace roomlight::testing {

inline constexpr const char* kLayersJson = R"({"version": 1, "camera": "Plan", "layers": [
  {"channel": "lamp_01", "name": "Sofa lamp", "kind": "lamp", "colour": [1.4, 0.95, 0.4], "kelvin": 2700, "fluxLm": 470, "room": "Living", "position": [1, 2, 3], "pixel": [0.25, 0.5]},
  {"channel": "lamp_02", "name": "Kitchen ceiling", "kind": "group", "colour": [1.1, 1.0, 0.8], "kelvin": 4000, "fluxLm": 2000, "room": "Kitchen", "position": null, "pixel": [0.75, 0.25]},
  {"channel": "lamp_03", "name": "Kitchen sink", "kind": "lamp", "colour": [1, 1, 1], "kelvin": null, "fluxLm": 300, "room": "Kitchen", "position": null, "pixel": null},
  {"channel": "sky", "name": "Sky", "kind": "sky", "colour": [0.9, 1.0, 1.3], "kelvin": 8000, "fluxLm": null, "room": null, "position": null, "pixel": null}]})";

inline std::vector<LayerInfo> someLayers() { return layersFromJson(kLayersJson, "test").value(); }

// Smooth pools of light over four orders of magnitude, each layer elsewhere and in its own hue.
inline Image poolOfLight(const LayerInfo& layer, size_t index, int width, int height) {
  Image image(width, height);
  const float u0 = 0.2f + 0.2f * static_cast<float>(index), v0 = index % 2 ? 0.3f : 0.7f;
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const float u = static_cast<float>(x) / static_cast<float>(width) - u0,
                  v = static_cast<float>(y) / static_cast<float>(height) - v0;
      const float grain = 1 + 0.1f * std::sin(0.7f * static_cast<float>(x)) * std::cos(1.3f * static_cast<float>(y));
      image.at(x, y) = layer.colour * (0.5f + 60 * grain * std::exp(-12 * (u * u + v * v)) +
                                       (u * u + v * v < 0.001f ? 3000.0f : 0.0f));
    }
  }
  return image;
}

inline std::vector<Image> somePictures(int width, int height) {
  const std::vector<LayerInfo> layers = someLayers();
  std::vector<Image> pictures;
  for (size_t i = 0; i < layers.size(); ++i) pictures.push_back(poolOfLight(layers[i], i, width, height));
  return pictures;
}

inline LayerStack stackOf(const std::vector<Image>& pictures) {
  LayerStack stack = makeLayerStack(pictures[0].width, pictures[0].height, pictures.size());
  for (size_t i = 0; i < pictures.size(); ++i) setLayer(stack, i, pictures[i]);
  return stack;
}

}  // namespace roomlight::testing
