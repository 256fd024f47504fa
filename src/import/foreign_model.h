// Models of formats that a library reads for us: what is taken from them, as plain data and as bytes that come out of a child process.
#pragma once

#include <string>
#include <vector>

#include "import/file_access.h"
#include "import/warnings.h"
#include "scene/scene.h"

namespace roomlight::importers {

// As MTL files say it: colours linear, emission in cd/m², Phong's exponent; pictures by the names that the file gives them.
struct ForeignMaterial {
  std::string name;
  Vec3 diffuse{0.6f, 0.6f, 0.6f}, specular, emission;
  float opacity = 1, shininess = 0;
  std::string diffusePicture, opacityPicture, emissionPicture;
};

struct ForeignModel {
  std::vector<Mesh> meshes;  // y up, named after their node; positions, normals, first texture coordinates, indices, material
  std::vector<ForeignMaterial> materials;
  size_t noTriangles = 0;    // points and lines, left out
};

Bytes toBytes(const ForeignModel& model);
// Throws Failure where the bytes are no such model: nothing in them is believed.
ForeignModel foreignModel(const Bytes& bytes);

// With the pictures that `companions` find.
Scene sceneOf(ForeignModel model, const ReadCompanion& companions, Warnings& warnings);

}  // namespace roomlight::importers
