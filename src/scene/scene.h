// A home as plain data: what importers produce and every later stage reads. World axes: x right, y up, z towards the
// viewer (glTF's), metres. Colours are linear Rec.709; quantities of light are photometric (see
// docs/reference/conventions.md).
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "base/image.h"
#include "base/vec.h"
#include "photometry/photometric_web.h"
#include "scene/glazing.h"

namespace roomlight {

enum class Wrap : uint8_t {
  Repeat,
  ClampToEdge,
  MirroredRepeat,
};

// 8-bit RGBA texels, rows from the top (v = 0 is the top row, as in glTF). Decoding sRGB is up to the reader: the use
// (base colour, emission: sRGB; the rest: linear) decides.
struct Texture {
  std::string name;
  int width = 0, height = 0;
  Wrap wrapU = Wrap::Repeat, wrapV = Wrap::Repeat;
  std::vector<uint8_t> rgba;
};

// A texture as a material uses it: which one, which set of coordinates, and KHR_texture_transform as the rows of a
// 2x3 matrix applied to (u, v, 1).
struct TextureRef {
  int texture = -1;  // index into Scene::textures, -1: none
  int uvSet = 0;     // 0 or 1
  float m[2][3] = {{1, 0, 0}, {0, 1, 0}};
};

enum class AlphaMode : uint8_t {
  Opaque,
  Mask,
  Blend,
};

// glTF 2.0 metallic-roughness with the extensions named beside each value.
struct Material {
  std::string name;
  std::string label;  // what people call it, but for the colour of an even one; empty: its name does. See shown_names.h
  Vec3 baseColor{1, 1, 1};
  float alpha = 1;
  TextureRef baseColorTexture;  // sRGB, A = alpha
  float metallic = 1, roughness = 1;
  TextureRef metallicRoughnessTexture;  // linear, G = roughness, B = metallic
  TextureRef normalTexture;  // linear, tangent space
  float normalScale = 1;
  Vec3 emission{0, 0, 0};  // luminance in cd/m² per channel (emissiveFactor x KHR_materials_emissive_strength)
  TextureRef emissionTexture;  // sRGB, multiplies emission
  AlphaMode alphaMode = AlphaMode::Opaque;
  float alphaCutoff = 0.5f;
  bool doubleSided = false;  // decides only whether both sides emit; every surface blocks light from both sides
  float transmission = 0;  // KHR_materials_transmission: thin-walled
  TextureRef transmissionTexture;  // linear, R
  float ior = 1.5f;  // KHR_materials_ior
  float specular = 1;  // KHR_materials_specular; 0 makes the dielectric a pure Lambertian
  Vec3 specularColor{1, 1, 1};
  Vec3 attenuationColor{1, 1, 1};  // KHR_materials_volume: transmittance of attenuationDistanceM of the medium
  float attenuationDistanceM = kInfinity;
  float thicknessM = 0;  // KHR_materials_volume: 0 is thin
  Glazing glazing;  // with panes: a smooth window, set by glaze(); only baseColor, alpha and emission count beside it
  float glazingReflectance = 0;  // glazingHemisphericalReflectance(glazing)
};

// One primitive: triangles of one material. Optional arrays are empty or as long as `positions`.
struct Mesh {
  std::string name;
  std::vector<Vec3> positions;
  std::vector<Vec3> normals;  // unit; empty: flat shading
  std::vector<Vec3> tangents;  // unit, along +u; empty: derived from uv0 where a normal map needs them
  std::vector<float> tangentSigns;  // ±1, with `tangents`
  std::vector<Vec2> uv[2];
  std::vector<Vec3> colors;  // COLOR_0, multiplies baseColor
  std::vector<float> colorAlphas;  // alpha of COLOR_0, multiplies alpha
  std::vector<uint32_t> indices;  // three per triangle, counter-clockwise seen from the front
  int material = 0;

  size_t triangleCount() const { return indices.size() / 3; }
};

// Importers give a lamp that shines by a mesh of its own this name after the lamp's.
constexpr const char* kLightSuffix = " (light)";

// What of a thing opens, in the world: it turns about a hinge or slides, from shut (0) to wide open (1).
struct Leaf {
  Vec3 hinge, axis{0, 1, 0};  // a point of the line that it turns about, and that line's direction, unit
  float turnRad = 0;  // from shut to wide open, right-handed about the axis
  Vec3 slideM;  // from shut to wide open
  float atRest = 0;  // how far open the scene has it
};

// A mesh placed in the world. Instances with the same `object` belong to one thing that moves as a whole.
struct Instance {
  std::string name;  // of the node
  int mesh = 0;
  int object = 0;
  Affine worldFromObject;
  int leaf = -1;  // index into Scene::leaves, -1: nothing that opens
  std::string label = {};  // what people call the object, where the file names it for programs; see shown_names.h
};

enum class LampKind : uint8_t {
  Point,
  Spot,
  Area,
};

// A luminaire without geometry of its own (Point, Spot) or a Lambertian rectangle that emits to one side (Area; scene
// loading turns it into an emissive mesh, see addAreaLampMeshes). A Point may have a photometric web: then its nadir is
// `direction`, C0 is `up`, and light leaves its position, or evenly every place of its luminous opening about there.
struct Lamp {
  std::string name;
  LampKind kind = LampKind::Point;
  Vec3 position;
  Vec3 direction{0, -1, 0};  // unit; axis of a spot, normal of an area lamp, nadir of a web
  Vec3 up{1, 0, 0};  // unit, along the rectangle's height; C0 of a web, perpendicular to `direction`
  // Point: in every direction, or in that of the web's peak; Spot: inside the inner cone. luminance(rgb) is the candela
  Vec3 intensityCd{0, 0, 0};
  std::shared_ptr<const PhotometricWeb> web;  // Point, or none; lamps may share it
  bool extended = false;  // of a web with an opening: as large as that, instead of a point
  float innerConeRad = 0, outerConeRad = kPi / 4;  // Spot: half-angles
  float widthM = 0, heightM = 0;  // Area
  Vec3 luminanceCdM2{0, 0, 0};  // Area
  float wattsW = 0;  // what it draws; 0: not stated
  std::string group;  // lamps of one are one layer of light; empty: those of one name are
};

// A source at infinity: the sun or a glTF directional light.
struct Sun {
  std::string name;
  Vec3 toLight{0, 1, 0};  // unit
  Vec3 illuminanceLux{0, 0, 0};  // on a surface that faces it; luminance(rgb) is the lux
  float halfAngleRad = 0;  // angular radius of the disc; 0: a delta direction (the real sun: 0.00465)
};

// Light from all directions. Radiance along the world direction d is `image` at d turned by worldFromSky's inverse, or
// `luminanceCdM2` where there is no image. Image: equirectangular, the centre looks along -z, +x to its right, top row
// +y.
struct Sky {
  Vec3 luminanceCdM2{0, 0, 0};  // constant part; ignored when an image is given
  Image image;  // in cd/m² after scaling
  bool horizonEdge = false;  // its upper and lower half meet in an edge: nothing is interpolated across
  float rotationRad = 0;  // turns the sky about +y, counter-clockwise seen from above
  bool present() const { return image.width > 0 || !isBlack(luminanceCdM2); }
};

// How a camera's rays leave it; trace/camera_rays.h is the one place that knows what each means.
enum class Projection : uint8_t {
  Perspective,
  Orthographic,
  Panorama,  // equirectangular, all directions: the centre looks along -z, +x to its right, the top row is +y
  StereoPanorama,  // two of them, the left eye's above the right eye's, each eye on a circle about the camera
                   // (omni-directional stereo)
};

// Looks along -z of its own frame, +y up.
struct Camera {
  std::string name;
  Affine worldFromCamera;
  float yFovRad = 0.9f;  // perspective: full vertical angle at the camera's own aspect ratio
  float aspect = 0;  // width / height the author meant; 0: unknown
  float nearM = 0;
  Projection projection = Projection::Perspective;
  bool emptyBackdrop = false;  // rays that meet nothing see no light, instead of the sky
  float yMagM = 1;  // orthographic: half of the height seen
  // What is higher than this in the world is not seen, but gives and takes light as ever; bodies that it cuts show a
  // section.
  float cutHeightM = kInfinity;
};

// A room as its floor: what is measured and judged together.
struct Room {
  std::string name;
  std::vector<Vec2> floor;  // corners (x, z), counter-clockwise seen from above
  float elevationM = 0;  // of the floor
  float heightM = 2.5f;  // of the ceiling above it
  std::string use;  // "living", "kitchen", ...: what it should be lit for (measure/meter_plan.h); empty: unknown
};

struct Scene {
  std::vector<Mesh> meshes;
  std::vector<Instance> instances;
  std::vector<Leaf> leaves;  // where the file knows them
  std::vector<Material> materials;
  std::vector<Texture> textures;
  std::vector<Lamp> lamps;
  std::vector<Sun> suns;
  Sky sky;
  std::vector<Camera> cameras;
  int cameraInUse = 0;  // index into cameras: what is shown where nobody says
  std::vector<Room> rooms;  // where the file knows them

  size_t triangleCount() const;  // of all instances
  Bounds3 bounds() const;  // of all instances, in world space
};

// An instance's triangles in world space are meshes[instance.mesh] through instance.worldFromObject.
Bounds3 instanceBounds(const Scene& scene, const Instance& instance);

// Appends a one-sided emissive rectangle for each Area lamp from index `firstLamp` on. Object ids are new ones.
void addAreaLampMeshes(Scene& scene, size_t firstLamp = 0);

// The frame of a camera that looks along `forward`, upright; straight up or down the top of its picture is -z or +z.
Affine looking(Vec3 from, Vec3 forward);

// A camera that sees the scene: the one in use, else one that looks into the bounds from a corner at eye height.
Camera defaultCamera(const Scene& scene);

}  // namespace roomlight
