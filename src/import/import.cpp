#include "import/import.h"

#include <fmt/format.h>

#include <algorithm>

#include "import/failure.h"
#include "import/foreign_import.h"
#include "import/scene_kind.h"
#include "import/scene_package.h"
#include "scene/scene_change.h"

namespace roomlight {
namespace {

constexpr float kFarthest = 1e7f;  // no site is larger, not even in millimetres, and floats hold no detail there
constexpr float kFarAway = 5000;   // from the origin: floats hold half a millimetre there, and
constexpr float kFarAwayTimes = 20;  // times the scene's size

float extentFromOrigin(const Bounds3& b) { return std::max(maxComponent(abs(b.lo)), maxComponent(abs(b.hi))); }

// Lamps and cameras that cannot be meant, such as those of a tool's other unit, would make the whole scene unusable.
void leaveOutFarThings(Imported& imported) {
  const auto far = [](Vec3 p) { return !(maxComponent(abs(p)) <= kFarthest); };
  Scene& scene = imported.scene;
  const auto tell = [&](size_t count, const char* what) {
    if (count > 0)
      imported.warnings.push_back(fmt::format("{} {}{} left out, more than {:.0f} m from the origin", count, what,
                                              count == 1 ? " is" : "s are", kFarthest));
  };
  tell(std::erase_if(scene.lamps, [&](const Lamp& l) { return l.kind != LampKind::Area && far(l.position); }), "lamp");
  tell(std::erase_if(scene.cameras, [&](const Camera& c) { return far(c.worldFromCamera.w); }), "camera");
  scene.cameraInUse = std::min(scene.cameraInUse, std::max(0, static_cast<int>(scene.cameras.size()) - 1));
}

// Sites in the coordinates of a country's grid come to the origin, or floats would round their walls.
void moveToOrigin(Imported& imported) {
  const Bounds3 bounds = imported.scene.bounds();
  const Vec3 centre = bounds.centre();
  const float away = maxComponent(abs(centre));
  if (!(away > kFarAway) || !(away > kFarAwayTimes * maxComponent(bounds.size()))) return;
  const Vec3 origin{centre.x, bounds.lo.y, centre.z};
  moveScene(imported.scene, -origin);
  for (Lamp& lamp : imported.offLamps) lamp.position += -origin;
  imported.warnings.push_back(
      fmt::format("the scene lies far from its origin; it is moved there by ({:.0f}, {:.0f}, {:.0f}) m", -origin.x,
                  -origin.y, -origin.z));
}

}  // namespace

namespace importers {

Result<Imported> importFile(const std::filesystem::path& file, const ImportOptions& options) {
  try {
    switch (kindOf(file)) {
      case SceneKind::Gltf: return importGltf(file, options);
      case SceneKind::Sh3d: return importSh3d(file, options);
      case SceneKind::Obj: return importObj(file, options);
      case SceneKind::Fbx: return importForeign(file, AssimpFormat::Fbx, options);
      case SceneKind::Collada: return importForeign(file, AssimpFormat::Collada, options);
      case SceneKind::Studio3D: return importForeign(file, AssimpFormat::Studio3D, options);
      case SceneKind::Ply: return importForeign(file, AssimpFormat::Ply, options);
      case SceneKind::Stl: return importForeign(file, AssimpFormat::Stl, options);
      case SceneKind::Sh3f: return importSh3f(file, options);
      case SceneKind::Zip: break;
    }
  } catch (const std::exception& e) {
    return Error{fmt::format("{}: {}", file.string(), printable(e.what(), 600))};
  }
  if (!options.companionRoot.empty())
    return Error{fmt::format("{}: is an archive in an archive or a folder; unpack it first", file.string())};
  return importZip(file, options);
}

}  // namespace importers

std::string supportedFiles() {
  return ".glb, .gltf, .obj, .fbx, .dae, .3ds, .ply, .stl, .sh3d or .sh3f, or a folder or .zip file with one";
}

Result<Imported> importScene(const std::filesystem::path& file, const ImportOptions& options) {
  std::error_code code;
  const bool folder = std::filesystem::is_directory(file, code);
  if (!folder && !std::filesystem::is_regular_file(file, code))
    return Error{fmt::format("{}: no such file", file.string())};
  if (options.upAxis && *options.upAxis != 'x' && *options.upAxis != 'y' && *options.upAxis != 'z')
    return Error{"the axis that points up is x, y or z"};
  Result<Imported> imported = folder ? importers::importFolder(file, options) : importers::importFile(file, options);
  if (imported && options.metresPerUnit != 1) scaleScene(imported.value().scene, options.metresPerUnit);
  if (imported) {
    leaveOutFarThings(imported.value());
    moveToOrigin(imported.value());
    if (const float farthest = extentFromOrigin(imported.value().scene.bounds()); !(farthest <= kFarthest)) {
      return Error{
          fmt::format("{}: the scene reaches {:.3g} m from its origin, more than {:.0f} m; give --metres-per-unit",
                      file.string(), farthest, kFarthest)};
    }
  }
  return imported;
}

}  // namespace roomlight
