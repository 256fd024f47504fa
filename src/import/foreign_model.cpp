#include "import/foreign_model.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <set>

#include "import/grey_material.h"
#include "import/obj.h"
#include "import/triangles.h"
#include "photometry/spot.h"

namespace roomlight::importers {
namespace {

constexpr float kBrightest = 1e12f;

float limited(float v, float high) { return std::isfinite(v) ? std::clamp(v, 0.0f, high) : 0.0f; }
Vec3 limited(Vec3 v, float high) { return {limited(v.x, high), limited(v.y, high), limited(v.z, high)}; }

Material converted(const ForeignMaterial& in, ObjTextures& textures, Scene& scene) {
  Material m;
  m.name = in.name;
  m.doubleSided = true;
  m.metallic = 0;
  m.baseColorTexture.texture = textures.colourWithAlpha(in.diffusePicture, in.opacityPicture, Wrap::Repeat, scene);
  // A picture stands in the place of the colour.
  m.baseColor = m.baseColorTexture.texture >= 0 ? Vec3(1) : limited(in.diffuse, 1);
  if (m.baseColorTexture.texture < 0 && !in.diffusePicture.empty()) m.baseColor = colourWithoutPicture(m.baseColor);
  m.normalTexture.texture = textures.colourWithAlpha(in.normalPicture, "", Wrap::Repeat, scene);
  m.alpha = limited(in.opacity, 1);
  m.alphaMode = m.alpha < 1 || !in.opacityPicture.empty() ? AlphaMode::Blend : AlphaMode::Opaque;
  m.emission = limited(in.emission, kBrightest);
  m.emissionTexture.texture = textures.colourWithAlpha(in.emissionPicture, "", Wrap::Repeat, scene);
  if (m.emissionTexture.texture >= 0 && isBlack(m.emission)) m.emission = Vec3(1);
  if (isBlack(limited(in.specular, 1))) m.specular = 0;
  // Phong's exponent as GGX: alpha^2 = 2 / (n + 2) (Walter et al. 2007), alpha = roughness^2.
  m.roughness = std::pow(2 / (limited(in.shininess, 1e6f) + 2), 0.25f);
  return m;
}

// Nothing beside the vertices' colours says how much the surface reflects.
void whitePaint(Material& m) {
  if (m.baseColorTexture.texture < 0) m.baseColor = Vec3(kWhitePaint);
}

void addCamera(const ForeignCamera& in, Scene& scene) {
  constexpr float kUsualAspect = 1.5f, kNarrowestRad = 0.02f, kWidestRad = 3;
  Camera camera;
  camera.name = in.name;
  const Vec3 right = cross(in.direction, in.up);
  if (length(right) > 1e-4f) {
    const Vec3 x = normalize(right);
    camera.worldFromCamera = {x, cross(x, in.direction), -in.direction, in.position};
  } else {
    camera.worldFromCamera = looking(in.position, in.direction);
  }
  if (in.aspect > 0.1f && in.aspect < 10) camera.aspect = in.aspect;
  if (in.xFovRad > kNarrowestRad && in.xFovRad < kWidestRad) {
    camera.yFovRad = 2 * std::atan(std::tan(in.xFovRad / 2) / (camera.aspect > 0 ? camera.aspect : kUsualAspect));
  }
  scene.cameras.push_back(camera);
}

}  // namespace

Scene sceneOf(ForeignModel model, const ReadCompanion& companions, Warnings& warnings) {
  std::set<std::string> names;
  for (const ForeignMaterial& m : model.materials) {
    for (const std::string* name : {&m.diffusePicture, &m.opacityPicture, &m.emissionPicture, &m.normalPicture}) {
      if (!name->empty()) names.insert(*name);
    }
  }
  const ReadCompanion ownOrBeside = [&](std::string_view name, const std::string& place) -> std::optional<Bytes> {
    if (!name.starts_with('*')) return companions(name, place);
    size_t number = 0;
    const auto [end, code] = std::from_chars(name.data() + 1, name.data() + name.size(), number);
    if (code != std::errc() || number >= model.pictures.size()) return {};
    return model.pictures[number];
  };
  Scene scene;
  ObjTextures textures(ownOrBeside, names, warnings);
  for (const ForeignMaterial& m : model.materials) scene.materials.push_back(converted(m, textures, scene));
  std::vector<int> kept;
  for (Mesh& mesh : model.meshes) {
    warnings.mended("triangles with a vertex that is no finite place are left out", dropInfinite(mesh));
    warnings.mended("triangles without area are left out", dropDegenerate(mesh));
    warnings.add(kLostCoordinates, mendCoordinates(mesh));
    kept.push_back(mesh.indices.empty() ? -1 : static_cast<int>(scene.meshes.size()));
    if (!mesh.colors.empty()) whitePaint(scene.materials[static_cast<size_t>(mesh.material)]);
    if (!mesh.indices.empty()) scene.meshes.push_back(std::move(mesh));
  }
  for (const ForeignInstance& i : model.instances) {
    if (kept[i.mesh] >= 0)
      scene.instances.push_back({i.name, kept[i.mesh], static_cast<int>(i.object & 0x3fffffff), i.modelFromMesh});
  }
  for (const ForeignCamera& c : model.cameras) addCamera(c, scene);
  warnings.add("points and lines are ignored", model.noTriangles);
  return scene;
}

void bakeInstances(Scene& scene) {
  std::vector<Mesh> meshes;
  for (Instance& i : scene.instances) {
    Mesh mesh = scene.meshes[static_cast<size_t>(i.mesh)];
    const Affine& m = i.worldFromObject;
    const bool mirrored = m.determinant() < 0;
    for (Vec3& p : mesh.positions) p = m.point(p);
    for (Vec3& n : mesh.normals) n = normalize(m.normal(n)) * (mirrored ? -1.0f : 1.0f);
    for (size_t t = 0; mirrored && t + 2 < mesh.indices.size(); t += 3)
      std::swap(mesh.indices[t + 1], mesh.indices[t + 2]);
    mesh.name = i.name;
    i.mesh = static_cast<int>(meshes.size()), i.worldFromObject = {};
    meshes.push_back(std::move(mesh));
  }
  scene.meshes = std::move(meshes);
}

namespace {

constexpr float kLampLm = 800, kSunLux = 50'000;
constexpr float kSunHalfAngleRad = 0.00465f;
constexpr float kUsualAreaM = 0.3f;  // a side of an area light whose size the file does not say
constexpr float kLeastConeRad = 0.02f;
constexpr float kLeastSideM = 1e-3f, kMostSideM = 1e3f;
constexpr float kFaintest = 1e-20f;  // in the file's unit; below it is none

float strength(const ForeignLight& l) { return luminance(max(l.colour, Vec3(0))); }

Lamp lampOf(const ForeignLight& in, float metresPerUnit, Vec3 fluxLm) {
  Lamp lamp;
  lamp.name = in.name;
  lamp.position = in.position * metresPerUnit;
  lamp.direction = in.direction;
  const Vec3 across = cross(in.direction, cross(in.up, in.direction));
  lamp.up = length(across) > 1e-4f ? normalize(across) : looking({}, in.direction).y;
  if (in.kind == ForeignLightKind::Point) {
    lamp.kind = LampKind::Point;
    lamp.intensityCd = fluxLm / (4 * kPi);
  } else if (in.kind == ForeignLightKind::Spot) {
    lamp.kind = LampKind::Spot;
    lamp.outerConeRad = std::clamp(std::max(in.outerConeRad, in.innerConeRad), kLeastConeRad, kPi / 2);
    lamp.innerConeRad = std::clamp(in.innerConeRad, 0.0f, lamp.outerConeRad);
    lamp.intensityCd =
        fluxLm / static_cast<float>(spotFluxPerCandela(std::cos(lamp.innerConeRad), std::cos(lamp.outerConeRad)));
  } else {
    lamp.kind = LampKind::Area;
    const auto side = [&](float size) {
      return size > 0 ? std::clamp(size * metresPerUnit, kLeastSideM, kMostSideM) : kUsualAreaM;
    };
    lamp.widthM = side(in.width), lamp.heightM = side(in.height);
    lamp.luminanceCdM2 = fluxLm / (kPi * lamp.widthM * lamp.heightM);
  }
  return lamp;
}

}  // namespace

void addForeignLights(const std::vector<ForeignLight>& lights, float metresPerUnit, Scene& scene, Warnings& warnings) {
  float brightestLamp = 0, brightestSun = 0;
  for (const ForeignLight& l : lights) {
    float& brightest = l.kind == ForeignLightKind::Directional ? brightestSun : brightestLamp;
    brightest = std::max(brightest, strength(l));
  }
  const size_t firstLamp = scene.lamps.size();
  size_t taken = 0;
  for (const ForeignLight& l : lights) {
    if (!(strength(l) > kFaintest)) {
      warnings.mended("lights of intensity 0 are left out");
      continue;
    }
    ++taken;
    const Vec3 colour = max(l.colour, Vec3(0));
    if (l.kind == ForeignLightKind::Directional) {
      scene.suns.push_back({l.name, -l.direction, colour * (kSunLux / brightestSun), kSunHalfAngleRad});
    } else {
      scene.lamps.push_back(lampOf(l, metresPerUnit, colour * (kLampLm / brightestLamp)));
    }
  }
  addAreaLampMeshes(scene, firstLamp);
  warnings.add(
      "lights of this format have no photometric unit: the brightest lamp is taken as 800 lm, the brightest "
      "directional light as a sun of 50000 lx",
      taken);
}

}  // namespace roomlight::importers
