// What the materials of a glTF file are made of: textures, and specular-glossiness as metallic-roughness.
#pragma once

#include <map>
#include <optional>
#include <tuple>
#include <vector>

#include "import/gltf_document.h"
#include "scene/scene.h"

namespace roomlight::importers {

// Textures of a glTF file: which picture with which wrap modes, transformed how. Only what materials use is decoded.
class GltfTextures {
 public:
  explicit GltfTextures(GltfDocument& document) : document_(document) {}

  // A material's texture info (index, texCoord, KHR_texture_transform). Its `texture` is a number that decode() tells
  // the meaning of; -1 where `info` is missing. What cannot be honoured is counted as a warning. Throws Failure.
  TextureRef reference(const std::optional<Json>& info);

  // Decodes all pictures that were referred to and appends the textures to the scene. Returns, for each number that
  // reference() gave, the index of its texture in the scene; -1 where the picture is missing, damaged or of an unknown
  // kind, which is counted as a warning.
  std::vector<int> decode(Scene& scene);

 private:
  struct Use {
    int image = -1;
    Wrap wrapU = Wrap::Repeat, wrapV = Wrap::Repeat;
    auto operator<=>(const Use&) const = default;
  };
  int imageOf(const Json& texture);
  Wrap wrapOf(const Json& sampler, const char* key);
  std::span<const uint8_t> open(int image);
  std::optional<Bytes> bytesOf(const Json& uri);
  std::string nameOf(int image) const;

  GltfDocument& document_;
  std::map<Use, int> numbers_;
  std::vector<Use> uses_;
  std::map<int, std::span<const uint8_t>> pictures_;  // no bytes: missing or of an unknown kind
  std::vector<std::unique_ptr<Bytes>> storage_;
  Listed missing_;
};

// KHR_materials_pbrSpecularGlossiness as metallic-roughness.

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
