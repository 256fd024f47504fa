// 3D models of furniture: entries of the home's archive.
#pragma once

#include <map>
#include <string>

#include "import/sh3d_archive.h"
#include "import/warnings.h"
#include "scene/scene.h"

namespace roomlight::importers::sh3d {

// A model in its own coordinates and unit, y up. Materials are indices into the home's scene.
struct Model {
  std::vector<Mesh> meshes;  // named after their group
  std::vector<int> objects;  // of each mesh: what belongs together
};

class Models {
 public:
  Models(const Archive& archive, size_t maxTriangles, Scene& scene, Warnings& warnings)
      : archive_(archive), maxTriangles_(maxTriangles), scene_(scene), warnings_(warnings) {}

  // The model of that entry, read once; its materials and textures are added to the scene. Null where it is missing, damaged or of a format
  // that is not read: a warning says which.
  const Model* find(const std::string& entry);

 private:
  Scene read(const std::string& entry);

  const Archive& archive_;
  size_t maxTriangles_;
  Scene& scene_;
  Warnings& warnings_;
  std::map<std::string, Model> models_;
};

}  // namespace roomlight::importers::sh3d
