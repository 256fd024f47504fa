#include "scene/surface.h"

#include <gtest/gtest.h>

namespace roomlight {
namespace {

// A triangle with a texture of gaps.
Scene veil(AlphaMode mode, float transmission) {
  Scene scene;
  Texture gaps;
  gaps.width = gaps.height = 4;
  for (int i = 0; i < 16; ++i) {
    for (const int v : {200, 100, 50, 17 * i % 256}) gaps.rgba.push_back(static_cast<uint8_t>(v));
  }
  scene.textures.push_back(gaps);
  Material m;
  m.metallic = 0, m.alpha = 0.9f, m.alphaMode = mode, m.transmission = transmission;
  m.baseColorTexture.texture = 0;
  scene.materials.push_back(m);
  Mesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  mesh.uv[0] = {{0, 0}, {1.7f, 0}, {0, 1.3f}};
  mesh.indices = {0, 1, 2};
  scene.meshes.push_back(mesh);
  return scene;
}

TEST(Surface, whatPassesIsThatOfAllItsValues) {
  for (const AlphaMode mode : {AlphaMode::Opaque, AlphaMode::Mask, AlphaMode::Blend}) {
    for (const float transmission : {0.0f, 0.6f}) {
      const Scene scene = veil(mode, transmission);
      for (int i = 0; i < 64; ++i) {
        const TrianglePoint p{0, static_cast<float>(i % 8) / 16, static_cast<float>(i / 8) / 16};
        const MaterialSample m = materialAt(scene, scene.meshes[0], p);
        EXPECT_EQ(straightTransmittance(scene, scene.meshes[0], p, 0.7f),
                  straightTransmittance(scene.materials[0], m, 0.7f))
            << i;
      }
    }
  }
}

}  // namespace
}  // namespace roomlight
