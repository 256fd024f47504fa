// Wavefront OBJ, and the materials of its MTL files with their pictures.
#pragma once

#include <map>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "import/file_access.h"
#include "import/warnings.h"
#include "scene/scene.h"

namespace roomlight::importers {

// The scene as the file says it, in its own unit; `companions` reads its MTL files and their pictures. Throws Failure.
Scene readObj(std::span<const uint8_t> bytes, const ReadCompanion& companions, size_t maxTriangles, Warnings& warnings);

// Pictures that MTL files name, and the textures made from them.
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

// Reads the libraries and appends one material for each name to the scene, in the order of the names. A library that
// is missing and a name that no library holds are warnings; the latter becomes a grey diffuse material, as does the
// name "". Throws Failure.
void addObjMaterials(const ReadCompanion& companions, const std::vector<std::string>& libraries,
                     const std::vector<std::string>& names, Scene& scene, Warnings& warnings);

}  // namespace roomlight::importers
