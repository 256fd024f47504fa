// What several fuzz targets need.
#pragma once

#include <cstdlib>

#include "scene/scene.h"

namespace roomlight::fuzz {

inline void require(bool fact) {
  if (!fact) std::abort();
}

// One glowing triangle.
inline Scene glowingTriangle() {
  Scene scene;
  scene.materials.emplace_back();
  scene.materials[0].emission = Vec3(100);
  Mesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  mesh.indices = {0, 1, 2};
  scene.meshes.push_back(mesh);
  scene.instances.emplace_back();
  return scene;
}

}  // namespace roomlight::fuzz
