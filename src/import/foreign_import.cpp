#include "import/foreign_import.h"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>

#include "import/child_process.h"
#include "import/failure.h"
#include "import/file_access.h"
#include "import/foreign_model.h"
#include "import/guarded.h"
#include "scene/scene_change.h"

namespace roomlight::importers {
namespace {

constexpr size_t kMaxBytes = size_t{256} << 20;

// A mesh in many places is stored once, and takes memory for each where they are merged. What the reader says of it is
// not believed either.
void checkSize(const ForeignModel& model, size_t maxTriangles) {
  size_t triangles = 0, vertices = 0;
  for (const ForeignInstance& i : model.instances) {
    triangles += model.meshes[i.mesh].triangleCount(), vertices += model.meshes[i.mesh].positions.size();
    if (triangles > maxTriangles) fail("", fmt::format("has more than {} triangles", maxTriangles));
    if (vertices / 3 > maxTriangles) fail("", fmt::format("has more than {} vertices", 3 * maxTriangles));
  }
}

}  // namespace

UpAxis usualUp(AssimpFormat format) {
  return format == AssimpFormat::Collada || format == AssimpFormat::Fbx ? UpAxis::Y : UpAxis::Z;
}

ForeignModel readForeign(std::span<const uint8_t> bytes, AssimpFormat format, bool ignoreUp, size_t maxTriangles) {
  if (bytes.size() > kMaxBytes) fail("", fmt::format("is larger than {} MiB", kMaxBytes >> 20));
  const std::vector<std::string> arguments{extensionOf(format), ignoreUp ? "own" : "stated",
                                           std::to_string(maxTriangles)};
  ForeignModel model = foreignModel(inChildProcess(modelReader(), arguments, bytes));
  checkSize(model, maxTriangles);
  return model;
}

Scene readByAssimp(std::span<const uint8_t> bytes, AssimpFormat format, const ReadCompanion& companions,
                   size_t maxTriangles, Warnings& warnings) {
  ForeignModel model = readForeign(bytes, format, false, maxTriangles);
  const UpAxis up = model.up ? static_cast<UpAxis>(model.up) : usualUp(format);
  Scene scene = sceneOf(std::move(model), companions, warnings);
  turnUpright(scene, up);
  bakeInstances(scene);
  return scene;
}

namespace {

// The library looks for the end of a PLY file's header for ever.
void checkHeader(std::span<const uint8_t> bytes, AssimpFormat format) {
  constexpr size_t kLongestHeader = 1 << 20;
  const std::string_view beginning(reinterpret_cast<const char*>(bytes.data()), std::min(bytes.size(), kLongestHeader));
  if (format == AssimpFormat::Ply && beginning.find("end_header") == std::string_view::npos)
    throw Failure("its header does not end");
}

Imported read(const std::filesystem::path& file, AssimpFormat format, const ImportOptions& options) {
  const Bytes bytes = readWholeFile(file, "");
  checkHeader(bytes, format);
  ForeignModel model = readForeign(bytes, format, options.upAxis.has_value(), options.maxTriangles);
  const char told = model.up;
  const StatedUnit unit = model.metresPerUnit > 0 ? StatedUnit::Stated : StatedUnit::None;
  const float metresPerUnit = model.metresPerUnit > 0 ? model.metresPerUnit : 1;
  const std::vector<ForeignLight> lights = std::move(model.lights);
  Warnings warnings;
  warnings.add("ambient lights are left out: bounced light is computed instead", model.otherLights);
  Scene scene = sceneOf(std::move(model), companionsAround(file, options.companionRoot), warnings);
  scaleScene(scene, metresPerUnit);
  addForeignLights(lights, metresPerUnit, scene, warnings);
  const std::optional<char> up = options.upAxis ? options.upAxis : told ? std::optional<char>(told) : std::nullopt;
  standUpright(scene, up, options.metresPerUnit, usualUp(format), warnings);
  return importedScene(std::move(scene), warnings, unit);
}

}  // namespace

Result<Imported> importForeign(const std::filesystem::path& file, AssimpFormat format, const ImportOptions& options) {
  return guarded(file, [&] { return read(file, format, options); });
}

}  // namespace roomlight::importers
