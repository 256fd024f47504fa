#include "import/import.h"

#include <fmt/format.h>

#include "import/failure.h"
#include "import/foreign_import.h"
#include "import/scene_kind.h"
#include "import/scene_package.h"
#include "scene/scale.h"

namespace roomlight {
namespace {

constexpr float kFarthestM = 1e6f;  // no home is larger, and floats hold no detail there

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
  if (!options.companionRoot.empty()) return Error{fmt::format("{}: is an archive in an archive or a folder; unpack it first", file.string())};
  return importZip(file, options);
}

}  // namespace importers

std::string supportedFiles() { return ".glb, .gltf, .obj, .fbx, .dae, .3ds, .ply, .stl, .sh3d or .sh3f, or a folder or .zip file with one"; }

Result<Imported> importScene(const std::filesystem::path& file, const ImportOptions& options) {
  std::error_code code;
  const bool folder = std::filesystem::is_directory(file, code);
  if (!folder && !std::filesystem::is_regular_file(file, code)) return Error{fmt::format("{}: no such file", file.string())};
  if (options.upAxis && *options.upAxis != 'x' && *options.upAxis != 'y' && *options.upAxis != 'z') return Error{"the axis that points up is x, y or z"};
  Result<Imported> imported = folder ? importers::importFolder(file, options) : importers::importFile(file, options);
  if (imported && options.metresPerUnit != 1) scaleScene(imported.value().scene, options.metresPerUnit);
  if (imported) {
    const Scene& scene = imported.value().scene;
    Bounds3 bounds = scene.bounds();
    for (const Lamp& lamp : scene.lamps) bounds.add(lamp.position);
    for (const Camera& camera : scene.cameras) bounds.add(camera.worldFromCamera.w);
    const float farthest = std::max(maxComponent(abs(bounds.lo)), maxComponent(abs(bounds.hi)));
    if (!(farthest <= kFarthestM)) {
      return Error{fmt::format("{}: the scene reaches {:.3g} m from its origin, more than {:.0f} m; give --metres-per-unit", file.string(), farthest, kFarthestM)};
    }
  }
  return imported;
}

}  // namespace roomlight
