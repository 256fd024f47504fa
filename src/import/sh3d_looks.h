// What a home changes about the materials of a model: colours and textures of the whole piece or of single materials.
#pragma once

#include <map>
#include <string>

#include "import/sh3d_home.h"
#include "import/sh3d_paints.h"
#include "scene/scene.h"

namespace roomlight::importers::sh3d {

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
