// Models of formats that a library reads for us: what is taken from them, as plain data and as bytes that come out of a
// child process.
#pragma once

#include <string>
#include <vector>

#include "import/file_access.h"
#include "import/warnings.h"
#include "scene/scene.h"

namespace roomlight::importers {

// As MTL files say it: colours linear, emission in cd/m², Phong's exponent; pictures by the names that the file gives
// them, or "*3" for the model's own picture 3.
struct ForeignMaterial {
  std::string name;
  Vec3 diffuse{0.6f, 0.6f, 0.6f}, specular, emission;
  float opacity = 1, shininess = 0;
  std::string diffusePicture, opacityPicture, emissionPicture, normalPicture;
};

struct ForeignInstance {
  std::string name;  // of the node
  uint32_t mesh = 0, object = 0;
  Affine modelFromMesh;
};

struct ForeignCamera {
  std::string name;
  Vec3 position, direction{0, 0, -1}, up{0, 1, 0};
  float xFovRad = 0, aspect = 0;  // 0: not said
};

enum class ForeignLightKind : uint32_t {
  Point,
  Spot,
  Directional,
  Area,
};

struct ForeignLight {
  std::string name;
  ForeignLightKind kind = ForeignLightKind::Point;
  Vec3 position, direction{0, -1, 0}, up{1, 0, 0};
  Vec3 colour;  // times an intensity that has no unit
  float innerConeRad = 0, outerConeRad = kPi / 4;  // half-angles
  float width = 0, height = 0;  // of an area
};

struct ForeignModel {
  std::vector<Mesh> meshes;  // positions, normals, colours, first texture coordinates, indices, material
  std::vector<ForeignInstance> instances;
  std::vector<ForeignMaterial> materials;
  std::vector<Bytes> pictures;  // that the file holds itself
  std::vector<ForeignCamera> cameras;
  std::vector<ForeignLight> lights;
  size_t noTriangles = 0;  // points and lines, left out
  size_t otherLights = 0;  // ambient ones, left out
  char up = 0;  // 'x', 'y', 'z'; 0: the file does not say
  float metresPerUnit = 0;  // 0: the file does not say
};

Bytes toBytes(const ForeignModel& model);
// Throws Failure where the bytes are no such model: nothing in them is believed.
ForeignModel foreignModel(const Bytes& bytes);

// In the model's own axes and unit, without its lights, with the pictures that `companions` find.
Scene sceneOf(ForeignModel model, const ReadCompanion& companions, Warnings& warnings);

// Every mesh where its instance has it, so that all transforms are the identity.
void bakeInstances(Scene& scene);

// In the model's axes, lengths times `metresPerUnit`. The brightest point, spot or area light is taken as a lamp of 800
// lm and the brightest directional one as a sun of 50000 lx, others of their kind in proportion; a warning says so.
void addForeignLights(const std::vector<ForeignLight>& lights, float metresPerUnit, Scene& scene, Warnings& warnings);

}  // namespace roomlight::importers
