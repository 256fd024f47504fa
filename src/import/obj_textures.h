// Pictures that MTL files name, and the textures made from them.
#pragma once

#include <map>
#include <set>
#include <string>

#include "import/file_access.h"
#include "import/warnings.h"
#include "scene/scene.h"

namespace roomlight::importers {

class ObjTextures {
 public:
  // Reads and decodes the pictures. One that is missing or of an unknown format is a warning; a damaged one, or one
  // outside the folder, throws Failure.
  ObjTextures(const ReadCompanion& companions, const std::set<std::string>& names, Warnings& warnings);

  // Index of the scene's texture made of the colour of one picture and the alpha of another; "" is no picture. -1 where
  // neither was read. The same request gives the same texture. Throws Failure where all of them are too large.
  int colourWithAlpha(const std::string& colour, const std::string& alpha, Wrap wrap, Scene& scene);
  // G = roughness, B = metallic, of two grey pictures; 255 for one that is not there.
  int metallicRoughness(const std::string& metallic, const std::string& roughness, Wrap wrap, Scene& scene);

 private:
  const Texture* find(const std::string& name) const;
  template <class Combine>
  int combined(const char* kind, const std::string& a, const std::string& b, Wrap wrap, Scene& scene,
               Combine&& combine);

  std::map<std::string, Texture> pictures_;
  std::map<std::string, int> made_, maskChannels_;  // of masks: where they say it, red or alpha
  size_t madePixels_ = 0;
};

}  // namespace roomlight::importers
