#include "bake/light_map.h"

#include <algorithm>
#include <cmath>

#include "base/tone.h"
#include "base/tone_curves.h"

namespace roomlight::bake {

Image onAtlas(const Atlas& atlas, const std::vector<Vec3>& lux) {
  Image light(atlas.width, atlas.height);
  for (size_t i = 0; i < atlas.texels.size(); ++i) light.pixels[atlas.texels[i]] = lux[i];
  for (const auto& [texel, element] : atlas.padding) light.pixels[texel] = lux[element];
  return light;
}

Image lightAtFirst(const Atlas& atlas, const LampLayers& lamps, const std::vector<BakedLayer>& daylight) {
  std::vector<Vec3> sum(atlas.elements.size());
  const auto add = [&](const BakedLayer& layer) {
    if (!layer.on) return;
    std::vector<Vec3> straight(sum.size());
    if (layer.sun) straight = sunlightOn(atlas, layer.mask, *layer.sun);
    for (size_t i = 0; i < sum.size(); ++i) sum[i] += layer.lux[i] + straight[i];
  };
  for (const BakedLayer& layer : lamps.layers) add(layer);
  for (const BakedLayer& layer : daylight) {
    if (layer.hour == daylight.front().hour) add(layer);
  }
  return onAtlas(atlas, sum);
}

LightMap lightMapOf(const Image& light, float ev100) {
  constexpr float kTimesWhite = 4;
  float most = 0;
  for (const Vec3 lux : light.pixels) most = std::max(most, maxComponent(lux));
  LightMap map;
  // A white surface of E lux has E / π cd/m².
  map.luxAtOne = std::max(std::min(most, kTimesWhite * kPi / exposureFromEv100(ev100)), 1e-6f);
  map.image = ByteImage(light.width, light.height, 3);
  for (size_t i = 0; i < light.pixels.size(); ++i) {
    const Vec3 v = light.pixels[i] / map.luxAtOne;
    const float channels[] = {v.x, v.y, v.z};
    for (size_t c = 0; c < 3; ++c)
      map.image.samples[3 * i + c] =
          channels[c] > 0 ? static_cast<uint8_t>(std::lround(255 * srgbEncode(std::min(channels[c], 1.0f)))) : 0;
  }
  return map;
}

}  // namespace roomlight::bake
