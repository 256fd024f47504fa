#include "import/foreign_import.h"

#include <algorithm>
#include <string_view>

#include "import/companion_search.h"
#include "import/failure.h"
#include "import/file_access.h"
#include "import/foreign_lights.h"
#include "import/guarded.h"
#include "scene/scale.h"

namespace roomlight::importers {
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
