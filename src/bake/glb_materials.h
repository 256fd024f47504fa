// Materials and textures of a scene as glTF has them.
#pragma once

#include <map>

#include "bake/glb.h"
#include "bake/glb_writer.h"
#include "bake/light_map.h"

namespace roomlight::bake {

// The texture whose coordinates a material keeps: of its colour, else of what it emits, else of its roughness, else of
// its normals. Null: it has none.
const TextureRef* coordinatesOf(const Material& material);

class GlbMaterials {
 public:
  GlbMaterials(const Scene& scene, GlbWriter& glb, const GlbSettings& settings)
      : scene_(scene), glb_(glb), settings_(settings) {}

  // The number in the file of a material of the scene, shining or not, whose emission belongs to a layer (-1: to none).
  // Errors: a texture that cannot be written.
  Result<int> add(int material, int layer, bool shines);
  // For all materials added later. `exposure`: what luminance is multiplied by, 1 being white. The texture's number.
  // Errors: it cannot be written.
  Result<int> useLightMap(const LightMap& map, float exposure);
  // Whether its coordinates are needed.
  bool textured(int material) const;
  // Writes what was added into the file.
  void finish();
  size_t textureBytes() const { return bytes_; }

 private:
  Result<int> texture(int texture, float quality);
  int addTexture(const std::string& picture, const char* type, const Json& sampler);
  Status addTextures(const Material& m, Json& json, Json& pbr);
  void addTransparency(const Material& m, Json& json, Json& pbr);

  const Scene& scene_;
  GlbWriter& glb_;
  const GlbSettings& settings_;
  Json materials_ = Json::array(), textures_ = Json::array(), images_ = Json::array(), samplers_ = Json::array();
  Json lightMap_;  // what materials say of it; null: nothing
  size_t bytes_ = 0;  // of textures
  std::map<int, int> textureOf_;  // of the scene's
};

}  // namespace roomlight::bake
