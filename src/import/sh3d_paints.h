// Colours and textures of Home.xml as the scene's materials, and what they change about those of models.
#pragma once

#include <map>
#include <set>
#include <string>

#include "import/sh3d_archive.h"
#include "import/sh3d_content.h"
#include "import/sh3d_home.h"
#include "import/warnings.h"
#include "scene/scene.h"

namespace roomlight::importers::sh3d {

// White on the screen is white paint, which reflects 85 %: a home that reflects everything would never get dark.
constexpr float kWhiteReflectance = 0.85f;

Vec3 linearColour(uint32_t rgb);  // sRGB 0xRRGGBB to linear Rec.709, 0 to 1

class Paints {
 public:
  // Decodes the pictures; one that is missing, damaged, not what was saved or of an unknown kind is a warning. Throws
  // Failure where all together are beyond a limit.
  Paints(const Archive& archive, const ContentDigests& digests, const std::set<std::string>& images, Scene& scene,
         Warnings& warnings);

  // Index of the material; white where the paint says nothing. Meshes give texture coordinates in metres, u to the
  // right and v down.
  int material(const Paint& paint, const std::string& name);
  // The same without the texture: for the narrow faces beside a side.
  int plain(const Paint& paint, const std::string& name);
  // The texture as a material uses it, for coordinates in metres; index -1 where its picture was not read.
  TextureRef reference(const TextureUse& use);
  const Texture* picture(const std::string& image) const;

 private:
  Scene& scene_;
  std::map<std::string, int> textures_, made_;
};

// Diffuse of that colour, with the gloss of a shininess from 0 to 1.
Material paintedMaterial(const std::string& name, Vec3 reflectance, double shininess);

// What a home changes about the materials of a model: colours and textures of the whole piece or of single materials.
struct Look {
  int material = 0;
  bool layBySize = false;  // its texture counts in metres, see laidBySize()
};

class Looks {
 public:
  Looks(Paints& paints, Scene& scene) : paints_(paints), scene_(scene) {}

  // Of the part `group` of a piece, whose model gives it `material`. Groups that Sweet Home 3D knows as window panes
  // are thin clear glass, those that it knows as mirrors reflect; the rest takes the paint of its own material, or that
  // of the whole piece. Unpainted materials of doors and windows that let light through evenly are glass: models write
  // it as a white veil.
  Look of(const Piece& piece, const std::string& group, int material);

 private:
  Look painted(int material, const Paint& paint, bool shininessGiven);

  Paints& paints_;
  Scene& scene_;
  std::map<std::string, int> made_;
};

// The mesh with texture coordinates in metres of the world, laid from the side that each triangle faces most.
Mesh laidBySize(const Mesh& mesh, const Affine& worldFromMesh);

}  // namespace roomlight::importers::sh3d
