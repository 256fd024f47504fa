#include "view/open_home.h"

#include <fmt/format.h>

#include "import/json_file.h"
#include "import/json_reader.h"
#include "import/lighting_file.h"
#include "import/lighting_own.h"
#include "view/save_lighting.h"
#include "view/sun_by_date.h"

namespace roomlight::view {
namespace {

// What withoutDimming() takes out, checked as the whole file would be.
std::string wrongDimming(const nlohmann::json& document, const Scene& scene) {
  std::string error;
  const JsonPlace j(document, "", error);
  if (j.has("own")) {
    const std::vector<OwnLamp> own = readOwnLamps(j["own"]);
    if (error.empty()) error = missingLamp(own, scene);
  }
  const bool hasLamps = j.has("lamps") && j["lamps"].isArray();
  for (size_t i = 0; hasLamps && i < j["lamps"].arraySize(); ++i) j["lamps"][i].number("dimming", 0, 1, 1);
  return error;
}

// Whether the home's own sun and sky still shine.
bool keepsOwnSun(const nlohmann::json& document) {
  if (!document.is_object()) return true;
  const nlohmann::json scene = document.value("scene", nlohmann::json::object());
  return !document.contains("daylight") && !document.contains("sun") && !document.contains("sky") && scene.value("suns", "keep") == "keep" && scene.value("sky", "keep") == "keep";
}

}  // namespace

Result<ViewHome> openHome(const std::filesystem::path& scene, const std::filesystem::path& lighting, const ImportOptions& options, std::vector<std::string>& warnings) {
  Result<Imported> imported = importScene(scene, options);
  if (!imported) return Error{imported.error()};
  warnings = std::move(imported.value().warnings);
  Scene& opened = imported.value().scene;
  LightingSource source;
  source.folder = lighting.parent_path();
  if (!lighting.empty()) {
    Result<nlohmann::json> document = readJsonFile(lighting);
    if (!document) return Error{document.error()};
    source.document = std::move(document).value();
    if (const std::string wrong = wrongDimming(source.document, opened); !wrong.empty()) return Error{fmt::format("{}: {}", lighting.string(), wrong)};
    if (const Status s = applyLighting(withoutDimming(source.document), lighting, opened, &warnings); !s) return Error{s.error()};
    if (source.document.contains("lamps")) source.lamps = source.document["lamps"].size();
  }
  ViewHome home(scene.stem().string(), std::move(opened));
  home.lighting = std::move(source);
  home.opened = stateOfFile(home, home.lighting.document);
  const nlohmann::json& document = home.lighting.document;
  home.sun = sunOfLighting(document, home.lighting.folder);
  if (keepsOwnSun(document) && !imported.value().daylight.empty()) home.sun = sunOfDaylight(nlohmann::json::parse(imported.value().daylight), {});
  return home;
}

}  // namespace roomlight::view
