#include "study/check_walks.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <optional>

#include "import/import.h"
#include "import/lighting_file.h"
#include "import/walk_file.h"

namespace roomlight {
namespace {

// In the light that it is walked through in; none where it cannot be opened.
std::optional<Scene> litScene(const StudyScene& s) {
  Result<Imported> imported = importScene(s.file);
  if (!imported) return std::nullopt;
  const std::filesystem::path& lighting = s.walkLight.lighting;
  if (!lighting.empty() && !applyLightingFile(lighting, imported.value().scene)) return std::nullopt;
  return std::move(imported.value().scene);
}

}  // namespace

Status checkWalks(const StudyPlan& plan, const RunStore& store, const std::string& program) {
  if (plan.techniquesIn("walks").empty()) return Ok{};
  for (const StudyScene& s : plan.scenes) {
    if (s.walk.empty()) continue;
    const RunStore::Key key{{"walk file", s.name},
                            fmt::format("{} | {} | {} | {}", program, contentHash(s.file),
                                        contentHash(s.walkLight.lighting), contentHash(s.walk))};
    if (store.find(key)) continue;
    const std::optional<Scene> scene = litScene(s);
    if (!scene) continue;
    if (const Result<Walk> walk = readWalkFile(s.walk, *scene); !walk) return Error{walk.error()};
    if (const Status kept = store.keep(key, nlohmann::json::object()); !kept) return kept;
  }
  return Ok{};
}

}  // namespace roomlight
