// KHR_materials_pbrSpecularGlossiness as metallic-roughness.
#pragma once

#include <vector>

#include "scene/scene.h"

namespace roomlight::importers {

// A material of the scene that holds the diffuse colour and its texture as base colour, and what the conversion needs
// beside it.
struct SpecularGlossiness {
  size_t material = 0;
  Vec3 specular{1, 1, 1};
  float glossiness = 1;
  TextureRef texture = {};  // sRGB, RGB = specular, A = glossiness
};

struct MetallicRoughness {
  Vec3 baseColor;
  float metallic = 0;
};

// The metal or plastic that reflects as nearly as much, by Khronos' published conversion: plastics mirror 4 %, what is
// above is metal.
MetallicRoughness metallicRoughnessOf(Vec3 diffuse, Vec3 specular);

// Converts these materials, their textures texel by texel; a texture that several share is converted for each pair
// once.
void convertSpecularGlossiness(const std::vector<SpecularGlossiness>& wishes, Scene& scene);

}  // namespace roomlight::importers
