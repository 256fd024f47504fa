// How much of the light straight through them surfaces let pass, where that is the same all over and from all sides.
#pragma once

#include <cstdint>
#include <vector>

#include "scene/scene.h"

namespace roomlight {

// Textures are read once. A sheer curtain's texture is opaque mostly, its material is not: then shadow rays need not
// read it.
class EvenTransmittance {
 public:
  explicit EvenTransmittance(const Scene& scene);
  // Of a mesh, 0 to 1; below 0: it depends on the place or the direction, or nothing passes.
  float of(const Mesh& mesh);

 private:
  bool isOpaque(const TextureRef& ref);

  const Scene& scene_;
  std::vector<int8_t> opaque_;  // of each texture 1 or 0; below 0: not read yet
};

}  // namespace roomlight
