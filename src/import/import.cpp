#include "import/import.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

namespace roomlight {
namespace {

constexpr float kFarthestM = 1e6f;  // no home is larger, and floats hold no detail there

// Lengths into metres: placements, media, lamps and cameras. Meshes keep their own coordinates.
void scaleToMetres(Scene& scene, float s) {
  for (Instance& instance : scene.instances) {
    Affine& m = instance.worldFromObject;
    m = {m.x * s, m.y * s, m.z * s, m.w * s};
  }
  for (Leaf& leaf : scene.leaves) leaf.hinge *= s, leaf.slideM *= s;
  for (Camera& camera : scene.cameras) {
    camera.worldFromCamera.w *= s;
    camera.nearM *= s;
    camera.yMagM *= s;
  }
  for (Room& room : scene.rooms) {
    for (Vec2& corner : room.floor) corner = corner * s;
    room.elevationM *= s, room.heightM *= s;
  }
  for (Material& material : scene.materials) {
    material.thicknessM *= s;
    material.attenuationDistanceM *= s;
  }
  for (Lamp& lamp : scene.lamps) {
    lamp.position *= s;
    lamp.widthM *= s;
    lamp.heightM *= s;
  }
}

}  // namespace

Result<Imported> importScene(const std::filesystem::path& file, const ImportOptions& options) {
  std::error_code code;
  if (!std::filesystem::is_regular_file(file, code)) return Error{fmt::format("{}: no such file", file.string())};
  std::string extension = file.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  const auto import = extension == ".gltf" || extension == ".glb" ? importGltf
                      : extension == ".obj"                       ? importObj
                      : extension == ".sh3d"                      ? importSh3d
                      : extension == ".sh3f"                      ? importSh3f
                                                                  : nullptr;
  if (!import) return Error{fmt::format("{}: unknown kind of file '{}'; use .gltf, .glb, .obj, .sh3d or .sh3f", file.string(), extension)};
  Result<Imported> imported = import(file, options);
  if (imported && options.metresPerUnit != 1) scaleToMetres(imported.value().scene, options.metresPerUnit);
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
