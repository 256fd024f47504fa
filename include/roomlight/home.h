// A home: opened from a file of any kind that the program opens, or made of arrays.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "roomlight/basics.h"

namespace ROOMLIGHT_NAMESPACE {

struct OpenOptions {
  // A lighting file (docs/reference/lighting.md), or the text of one, which begins with '{'. Empty: none.
  std::string lighting = {};
  // Light of a home that `lighting` does not light: auto, day, evening, night, none or file.
  std::string light = "auto";
  // Cameras that pictures will be taken of, by name or number from 0; where light is added it goes by the first, and by
  // the default camera where none is named. "all": views are proposed for every room.
  std::vector<std::string> cameras = {};
  std::optional<double> metresPerUnit = {};  // length of the file's unit; none: as the file says, or guessed
  char up = 0;  // 'y' or 'z': which axis of the file points up; 0: as the file says, or guessed
  double lumenAtFullPower = 1600;  // of lights of power 1 in Sweet Home 3D's files
};

// RGBA bytes, rows from the top; colours in sRGB.
struct TextureArrays {
  int width = 0, height = 0;
  std::span<const uint8_t> rgba = {};  // 4 * width * height
};

// glTF 2.0's metallic-roughness material.
struct MaterialValues {
  std::string name = {};
  Vec3 baseColour{0.8f, 0.8f, 0.8f};  // linear Rec.709
  int baseColourTexture = -1;  // index of a texture that multiplies it; -1: none
  float alpha = 1;
  float metallic = 0, roughness = 1;
  float transmission = 0;  // of thin glass, 0 to 1
  float indexOfRefraction = 1.5f;
  float specular = 1;  // of what smooth surfaces mirror, the share that this one does; 0: a Lambertian surface
  Vec3 emissionCdM2 = {};  // luminance in cd/m² per channel
  bool doubleSided = true;  // decides whether both sides shine; every surface blocks light from both
};

// Triangles of one material, as trimesh and Open3D hold them.
struct MeshArrays {
  std::string name = {};
  std::span<const float> positions = {};  // 3 a vertex: x, y, z
  std::span<const uint32_t> triangles = {};  // 3 a triangle: numbers of vertices, counter-clockwise seen from the front
  std::span<const float> normals = {};  // 3 a vertex, unit; empty: flat shading
  std::span<const float> uv = {};  // 2 a vertex, (0, 0) is the texture's upper left corner; may be empty
  int material = 0;
};

struct CameraValues {
  std::string name = {};
  Vec3 eye = {}, target = {};
  float verticalFovDeg = 50;
};

struct HomeArrays {
  std::vector<MeshArrays> meshes = {};
  std::vector<MaterialValues> materials = {};  // empty: all is grey, of albedo 0.8
  std::vector<TextureArrays> textures = {};
  std::vector<CameraValues> cameras = {};  // empty: views are proposed
};

// What a home calls its things.
struct CameraInfo {
  std::string name = {};
  Vec3 eye = {}, forward = {};  // unit
  bool isProposed = false;  // by roomlight; else the file's
};
struct RoomInfo {
  std::string name = {}, use = {};  // use: "living", "kitchen", ...; empty: not known
  std::vector<std::pair<float, float>> floor = {};  // corners (x, z)
  float elevationM = 0, heightM = 0;
};
struct LampInfo {
  std::string name = {};
  Vec3 position = {};
  double fluxLm = 0;
  std::string room = {};  // empty: of none
};

class ROOMLIGHT_API Home {
 public:
  static Result<Home> open(const std::string& file, const OpenOptions& options = {});
  // Copies the arrays. Of the options `up` and `lumenAtFullPower` have no meaning; `metresPerUnit`: of positions and
  // cameras, 1 if not said.
  static Result<Home> fromArrays(const HomeArrays& arrays, const OpenOptions& options = {});

  std::vector<CameraInfo> cameras() const;
  std::string defaultCamera() const;  // its name; may be empty where it has none
  std::vector<RoomInfo> rooms() const;
  std::vector<LampInfo> lamps() const;
  size_t triangleCount() const;
  std::pair<Vec3, Vec3> bounds() const;  // least and greatest corner, m
  double metresPerUnit() const;  // as taken
  // What is wrong with the files, and what was guessed or added: a line each.
  const std::vector<std::string>& warnings() const;
  const std::vector<std::string>& notes() const;
  // The light that was added where there was none, as the text of a lighting file; empty: none was.
  std::string addedLighting() const;

  struct State;
  explicit Home(std::shared_ptr<const State> state) : state_(std::move(state)) {}
  const State& state() const { return *state_; }

 private:
  std::shared_ptr<const State> state_;
};

// File names that Home::open knows, for people: ".glb, .gltf, ...".
ROOMLIGHT_API std::string supportedFiles();

}  // namespace ROOMLIGHT_NAMESPACE
