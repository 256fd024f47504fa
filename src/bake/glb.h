// A baked home as a file: binary glTF with its layers of light (docs/reference/baked.md).
#pragma once

#include <span>
#include <string>

#include "bake/atlas.h"
#include "bake/layers.h"
#include "base/tone.h"
#include "look/display.h"

namespace roomlight::bake {

struct GlbSettings {
  int mostTexturePixels = 1024;  // an edge; larger textures are scaled down
  float textureQuality = 80;     // of WebP
  // Geometry by EXT_meshopt_compression, textures as WebP, which not every program reads; else as JPEG and PNG.
  bool compressed = false;
  bool lightMap = false;         // light as it is at first in a texture too, for programs that know no layers
};

// What a picture of the home's own light from its camera is exposed and balanced by.
struct ShownAs {
  Tone tone;
  float ev100 = 8;
  Vec3 whiteGains{1, 1, 1};
  std::vector<ShownWhite> whites = {};  // how other light would be balanced
};

struct Glb {
  std::string bytes;      // the file
  size_t lightBytes = 0, textureBytes = 0;  // of it, all layers and all textures
};

// Layers have light on the elements of the atlas.
// Errors: a texture that cannot be written.
Result<Glb> glbOf(const Scene& scene, const Atlas& atlas, const LampLayers& lamps,
                  const std::vector<BakedLayer>& daylight, const ShownAs& shown, const GlbSettings& settings);

}  // namespace roomlight::bake
