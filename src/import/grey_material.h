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

}  // namespace roomlight::importers
