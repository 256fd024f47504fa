// 3D models of furniture: entries of the home's archive.
#pragma once

#include <map>
#include <set>
#include <string>

#include "import/sh3d_archive.h"
#include "import/sh3d_content.h"
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
  // Reads these entries, several at a time; their materials and textures are added to the scene. What is missing,
  // damaged, not what was saved or of a format that is not read is a warning. Throws Failure where all together are
// beyond a limit.
  Models(const Archive& archive, const ContentDigests& digests, const std::set<std::string>& entries,
         size_t maxTriangles, Scene& scene, Warnings& warnings);

  // Null where it could not be read.
  const Model* find(const std::string& entry) const;

 private:
  std::map<std::string, Model> models_;
};

}  // namespace roomlight::importers::sh3d
