// The light of a home as it is at first, in one texture of 8 bits: for programs that know light maps but no layers.
#pragma once

#include <vector>

#include "bake/atlas.h"
#include "bake/layers.h"
#include "base/image.h"

namespace roomlight::bake {

// Light of elements on the atlas, in texels beside charts too.
Image onAtlas(const Atlas& atlas, const std::vector<Vec3>& lux);

// The layers that are on, of daylight those of the first hour.
Image lightAtFirst(const Atlas& atlas, const LampLayers& lamps, const std::vector<BakedLayer>& daylight);

struct LightMap {
  ByteImage image;     // sRGB
  float luxAtOne = 1;  // illuminance that 1 stands for, once decoded
};

// What is so bright that it would be shown as white anyway, four times over, is clipped: so that eight bits suffice for
// the rest.
LightMap lightMapOf(const Image& light, float ev100);

}  // namespace roomlight::bake
