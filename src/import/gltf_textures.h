// Textures of a glTF file: which picture with which wrap modes, transformed how. Only what materials use is decoded.
#pragma once

#include <map>
#include <optional>
#include <tuple>

#include "import/gltf_document.h"
#include "scene/scene.h"

namespace roomlight::importers {

class GltfTextures {
 public:
  explicit GltfTextures(GltfDocument& document) : document_(document) {}

  // A material's texture info (index, texCoord, KHR_texture_transform); no texture where `info` is missing or where the
  // picture or the set of coordinates cannot be honoured, which is then counted as a warning. Throws Failure.
  TextureRef reference(const std::optional<Json>& info);

  // Decodes all pictures that were referred to and appends the textures to the scene, in the order of the indices that
  // reference() gave.
  void decode(Scene& scene);

 private:
  struct Use {
    int image = 0;
    Wrap wrapU = Wrap::Repeat, wrapV = Wrap::Repeat;
    auto operator<=>(const Use&) const = default;
  };
  struct Picture {
    std::span<const uint8_t> bytes;
    bool honoured = true;
  };
  int imageOf(const Json& texture);
  Picture& open(int image);

  GltfDocument& document_;
  std::map<Use, int> indices_;
  std::vector<Use> uses_;
  std::map<int, Picture> pictures_;
  std::vector<std::unique_ptr<Bytes>> storage_;
};

}  // namespace roomlight::importers
