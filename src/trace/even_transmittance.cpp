#include "trace/even_transmittance.h"

#include "scene/surface.h"

namespace roomlight {

EvenTransmittance::EvenTransmittance(const Scene& scene) : scene_(scene), opaque_(scene.textures.size(), int8_t{-1}) {}

float EvenTransmittance::of(const Mesh& mesh) {
  const Material& m = scene_.materials[static_cast<size_t>(mesh.material)];
  if (!letsLightThrough(m) || m.glazing.panes > 0 || m.transmission > 0) return -1;
  if (!mesh.colorAlphas.empty() || !isOpaque(m.baseColorTexture)) return -1;
  return 1 - alphaByMode(m, m.alpha);
}

bool EvenTransmittance::isOpaque(const TextureRef& ref) {
  if (ref.texture < 0) return true;
  int8_t& known = opaque_[static_cast<size_t>(ref.texture)];
  if (known < 0) {
    const std::vector<uint8_t>& rgba = scene_.textures[static_cast<size_t>(ref.texture)].rgba;
    known = 1;
    for (size_t i = 3; i < rgba.size() && known; i += 4) known = rgba[i] == 255;
  }
  return known == 1;
}

}  // namespace roomlight
