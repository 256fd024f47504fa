#include "roomlight/home.h"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "conversions.h"
#include "measure/luminaires.h"
#include "scene/scene_change.h"
#include "scene/validate.h"
#include "still/cameras.h"
#include "trace/light_layers.h"

namespace roomlight::v1 {
namespace {

constexpr float kAlbedo = 0.8f, kMostCdM2 = 1e9f;
constexpr float kLargestM = 10'000;
constexpr const char* kArrays = "arrays";

struct Lighting {
  std::string name;
  std::optional<nlohmann::json> document;
};

Result<Lighting> lightingOf(const OpenOptions& options) {
  if (!options.lighting.starts_with('{')) return Lighting{options.lighting, {}};
  nlohmann::json document = nlohmann::json::parse(options.lighting, nullptr, false);
  if (document.is_discarded()) return badInput("lighting: is not valid JSON");
  return Lighting{"lighting", std::move(document)};
}

Result<home::OpenWish> wishOf(const OpenOptions& o) {
  home::OpenWish wish;
  const roomlight::Result<home::LightWish> light = home::lightWishFromName(o.light);
  if (!light) return badInput(light.error());
  if (o.metresPerUnit && !(*o.metresPerUnit > 0 && *o.metresPerUnit <= 1e6))
    return badInput("metresPerUnit: must be above 0 and at most 1000000");
  if (o.up != 0 && o.up != 'y' && o.up != 'z') return badInput("up: write y or z");
  if (!(o.lumenAtFullPower >= 0 && o.lumenAtFullPower <= 1e9))
    return badInput("lumenAtFullPower: must be from 0 to 1000000000");
  wish.light = light.value();
  if (o.metresPerUnit) wish.metresPerUnit = static_cast<float>(*o.metresPerUnit);
  if (o.up != 0) wish.import.upAxis = o.up;
  wish.import.lumenAtFullPower = o.lumenAtFullPower;
  wish.allCameras = meansAllCameras(o.cameras);
  if (o.cameras.empty() || wish.allCameras) return wish;
  wish.camera = wish.import.camera = o.cameras.front();
  wish.moreCameras.assign(o.cameras.begin() + 1, o.cameras.end());
  return wish;
}

Result<Home> homeOf(roomlight::Result<home::OpenedHome> opened, std::string file, std::string lighting) {
  if (!opened) return badInput(opened.error());
  for (auto* lines : {&opened.value().notes, &opened.value().warnings}) {
    for (std::string& line : *lines) line = withoutDashes(line);
  }
  auto state = std::make_shared<Home::State>();
  *state = {std::move(opened.value()), std::move(file), std::move(lighting)};
  return Home(std::shared_ptr<const Home::State>(std::move(state)));
}

// Three numbers each, or two.
template <class V, size_t kNumbers>
Result<std::vector<V>> vectorsOf(std::span<const float> numbers, const std::string& what, size_t count) {
  if (numbers.empty()) return std::vector<V>();
  if (numbers.size() != kNumbers * count)
    return badInput(
        fmt::format("{}: has {} numbers, {} vertices need {}", what, numbers.size(), count, kNumbers * count));
  std::vector<V> out(count);
  for (size_t i = 0; i < count; ++i) {
    for (size_t k = 0; k < kNumbers; ++k) (&out[i].x)[k] = numbers[kNumbers * i + k];
  }
  return out;
}

Status addMesh(const MeshArrays& arrays, size_t index, size_t materials, Scene& scene) {
  const std::string where =
      fmt::format("mesh {}{}", index, arrays.name.empty() ? "" : fmt::format(" '{}'", arrays.name));
  if (arrays.positions.size() % 3 != 0 || arrays.triangles.size() % 3 != 0)
    return badInput(fmt::format("{}: positions and triangles have three numbers each", where));
  if (arrays.material < 0 || static_cast<size_t>(arrays.material) >= materials)
    return badInput(fmt::format("{}: there is no material {}", where, arrays.material));
  const size_t count = arrays.positions.size() / 3;
  Mesh mesh;
  mesh.name = arrays.name, mesh.material = arrays.material;
  Result<std::vector<roomlight::Vec3>> positions =
      vectorsOf<roomlight::Vec3, 3>(arrays.positions, where + ": positions", count);
  if (!positions) return positions.error();
  Result<std::vector<roomlight::Vec3>> normals =
      vectorsOf<roomlight::Vec3, 3>(arrays.normals, where + ": normals", count);
  if (!normals) return normals.error();
  Result<std::vector<Vec2>> uv = vectorsOf<Vec2, 2>(arrays.uv, where + ": uv", count);
  if (!uv) return uv.error();
  mesh.positions = std::move(positions.value()), mesh.normals = std::move(normals.value());
  mesh.uv[0] = std::move(uv.value());
  mesh.indices.assign(arrays.triangles.begin(), arrays.triangles.end());
  Instance instance;
  instance.name = arrays.name;
  instance.mesh = static_cast<int>(scene.meshes.size()), instance.object = instance.mesh;
  scene.meshes.push_back(std::move(mesh));
  scene.instances.push_back(instance);
  return Done{};
}

Status checkMaterial(const MaterialValues& v, size_t index) {
  const auto isShare = [](float x) { return x >= 0 && x <= 1; };
  const auto within = [](Vec3 c, float most) {
    return c.x >= 0 && c.y >= 0 && c.z >= 0 && c.x <= most && c.y <= most && c.z <= most;
  };
  const char* wrong = !within(v.baseColour, 1)   ? "baseColour: must be from 0 to 1"
                      : !isShare(v.alpha)        ? "alpha: must be from 0 to 1"
                      : !isShare(v.metallic)     ? "metallic: must be from 0 to 1"
                      : !isShare(v.roughness)    ? "roughness: must be from 0 to 1"
                      : !isShare(v.transmission) ? "transmission: must be from 0 to 1"
                      : !isShare(v.specular)     ? "specular: must be from 0 to 1"
                      : !(v.indexOfRefraction >= 1 && v.indexOfRefraction <= 10)
                          ? "indexOfRefraction: must be from 1 to 10"
                      : !within(v.emissionCdM2, kMostCdM2) ? "emissionCdM2: must be from 0 to 1e9"
                      : v.baseColourTexture < -1           ? "baseColourTexture: there is no such texture"
                                                           : nullptr;
  return wrong ? Status(badInput(fmt::format("material {}: {}", index, wrong))) : Done{};
}

Material materialOf(const MaterialValues& v) {
  Material m;
  m.name = v.name;
  m.baseColor = toInternal(v.baseColour), m.baseColorTexture.texture = v.baseColourTexture;
  m.alpha = v.alpha, m.alphaMode = v.alpha < 1 ? AlphaMode::Blend : AlphaMode::Opaque;
  m.metallic = v.metallic, m.roughness = v.roughness, m.transmission = v.transmission, m.ior = v.indexOfRefraction;
  m.specular = v.specular;
  m.emission = toInternal(v.emissionCdM2), m.doubleSided = v.doubleSided;
  return m;
}

Result<Camera> cameraOf(const CameraValues& v) {
  const roomlight::Vec3 eye = toInternal(v.eye), forward = toInternal(v.target) - eye;
  if (!isPlace(eye) || !isPlace(toInternal(v.target)))
    return badInput(fmt::format("camera '{}': eye and target must be within 1000 km", v.name));
  if (!(length(forward) > 1e-6f)) return badInput(fmt::format("camera '{}': target is where its eye is", v.name));
  if (!(v.verticalFovDeg >= 1 && v.verticalFovDeg <= 170))
    return badInput(fmt::format("camera '{}': verticalFovDeg must be from 1 to 170", v.name));
  Camera camera;
  camera.name = v.name;
  camera.worldFromCamera = looking(eye, normalize(forward));
  camera.yFovRad = v.verticalFovDeg * kPi / 180;
  return camera;
}

Result<Scene> sceneOf(const HomeArrays& arrays) {
  Scene scene;
  for (const TextureArrays& t : arrays.textures) {
    Texture texture;
    texture.width = t.width, texture.height = t.height;
    texture.rgba.assign(t.rgba.begin(), t.rgba.end());
    scene.textures.push_back(std::move(texture));
  }
  for (const MaterialValues& m : arrays.materials) {
    if (const Status s = checkMaterial(m, scene.materials.size()); !s) return s.error();
    scene.materials.push_back(materialOf(m));
  }
  if (arrays.materials.empty()) {
    MaterialValues grey;
    grey.baseColour = {kAlbedo, kAlbedo, kAlbedo};
    scene.materials.push_back(materialOf(grey));
  }
  for (size_t i = 0; i < arrays.meshes.size(); ++i) {
    if (const Status s = addMesh(arrays.meshes[i], i, scene.materials.size(), scene); !s) return s.error();
  }
  for (const CameraValues& c : arrays.cameras) {
    Result<Camera> camera = cameraOf(c);
    if (!camera) return camera.error();
    scene.cameras.push_back(camera.value());
  }
  return scene;
}

}  // namespace

Result<Home> Home::open(const std::string& file, const OpenOptions& options) {
  return guarded([&]() -> Result<Home> {
    Result<home::OpenWish> wish = wishOf(options);
    if (!wish) return wish.error();
    Result<Lighting> lighting = lightingOf(options);
    if (!lighting) return lighting.error();
    wish->scene = file, wish->lighting = lighting->name, wish->document = std::move(lighting->document);
    return homeOf(home::openHome(*wish), file, lighting->name);
  });
}

Result<Home> Home::fromArrays(const HomeArrays& arrays, const OpenOptions& options) {
  return guarded([&]() -> Result<Home> {
    Result<home::OpenWish> wish = wishOf(options);
    if (!wish) return wish.error();
    Result<Lighting> lighting = lightingOf(options);
    if (!lighting) return lighting.error();
    Result<Scene> scene = sceneOf(arrays);
    if (!scene) return scene.error();
    if (const auto s = validate(*scene); !s) return badInput(s.error());
    if (wish->metresPerUnit) scaleScene(*scene, *wish->metresPerUnit);
    if (const float size = maxComponent(scene->bounds().size()); !(size <= kLargestM))
      return badInput(fmt::format("the scene is {:g} m large, which no home is; is metresPerUnit right?", size));
    Imported imported;
    imported.scene = std::move(*scene);
    imported.unit = StatedUnit::Certain;
    wish->lighting = lighting->name, wish->document = std::move(lighting->document);
    return homeOf(home::openImported(std::move(imported), *wish), kArrays, lighting->name);
  });
}

std::vector<CameraInfo> Home::cameras() const {
  std::vector<CameraInfo> out;
  const home::OpenedHome& opened = state_->opened;
  for (const Camera& c : opened.scene.cameras) {
    const roomlight::Vec3 eye = c.worldFromCamera.w;
    const roomlight::Vec3 forward = -c.worldFromCamera.z;
    out.push_back({c.name, toPublic(eye), toPublic(normalize(forward)), out.size() >= opened.fileCameras});
  }
  return out;
}

std::string Home::defaultCamera() const { return roomlight::defaultCamera(state_->opened.scene).name; }

std::vector<RoomInfo> Home::rooms() const {
  std::vector<RoomInfo> out;
  for (const Room& r : state_->opened.scene.rooms) {
    RoomInfo info{r.name, r.use, {}, r.elevationM, r.heightM};
    for (const Vec2 corner : r.floor) info.floor.emplace_back(corner.x, corner.y);
    out.push_back(std::move(info));
  }
  return out;
}

std::vector<LampInfo> Home::lamps() const {
  std::vector<LampInfo> out;
  const Scene& scene = state_->opened.scene;
  for (const Luminaire& l : luminairesOf(scene)) {
    const int room = roomAt(scene, l.position);
    out.push_back(
        {l.name, toPublic(l.position), l.fluxLm, room < 0 ? "" : scene.rooms[static_cast<size_t>(room)].name});
  }
  return out;
}

size_t Home::triangleCount() const { return state_->opened.scene.triangleCount(); }

std::pair<Vec3, Vec3> Home::bounds() const {
  const Bounds3 b = state_->opened.scene.bounds();
  return {toPublic(b.lo), toPublic(b.hi)};
}

double Home::metresPerUnit() const { return state_->opened.metresPerUnit; }
const std::vector<std::string>& Home::warnings() const { return state_->opened.warnings; }
const std::vector<std::string>& Home::notes() const { return state_->opened.notes; }

std::string Home::addedLighting() const {
  const nlohmann::ordered_json& added = state_->opened.lighting;
  return added.is_null() ? "" : added.dump(2) + "\n";
}

std::string supportedFiles() { return roomlight::supportedFiles(); }

}  // namespace roomlight::v1
