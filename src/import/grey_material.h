// What stands in for a material that a file does not have.
#pragma once

#include <string>

#include "scene/scene.h"

namespace roomlight::importers {

// Diffuse, reflects 60 %: like a light wall. (glTF's own default, a white metal, would swallow no light at all.)
inline Material greyMaterial(const std::string& name = "default") {
  Material grey;
  grey.name = name;
  grey.baseColor = Vec3(0.6f);
  grey.metallic = grey.specular = 0;
  return grey;
}

// What vertices' colours multiply where no material says more.
constexpr float kWhitePaint = 0.85f;

// Of a surface whose picture is missing: exporters write black or white beside a picture.
inline Vec3 colourWithoutPicture(Vec3 colour) {
  return isBlack(colour) || minComponent(colour) > 0.98f ? Vec3(0.6f) : colour;
}

}  // namespace roomlight::importers
