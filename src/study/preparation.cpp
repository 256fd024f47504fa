#include "study/preparation.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <optional>

#include "base/write_file.h"
#include "import/import.h"
#include "import/lighting_file.h"
#include "import/walk_file.h"
#include "scene/find_named.h"
#include "trace/ray_scene.h"

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

namespace {

constexpr float kFarthestM = 2;
constexpr const char* kColour = "2700 K";

Result<Vec3> positionIn(const StudyScene& s) {
  const Result<Imported> imported = importScene(s.file, {.camera = s.camera});
  if (!imported) return Error{imported.error()};
  const Result<Camera> camera = findCamera(imported.value().scene, s.camera);
  if (!camera) return Error{fmt::format("{}: {}", s.file.string(), camera.error())};
  return dimLampPosition(imported.value().scene, camera.value());
}

Status writeDimLamp(const StudyScene& s, StudyLight& light, const RunStore& store) {
  if (light.dimLampLm <= 0) return Ok{};
  const RunStore::Key key{{"light", s.name, light.name},
                          fmt::format("{} | camera {} | {} lm", contentHash(s.file), s.camera, light.dimLampLm)};
  light.lighting = store.file(key, ".lighting.json");
  if (std::filesystem::exists(light.lighting)) return Ok{};
  const Result<Vec3> p = positionIn(s);
  if (!p) return Error{p.error()};
  const auto off = {"lamps", "suns", "sky", "emission"};
  nlohmann::ordered_json file = {{"comment", "One weak lamp; every other light is off."}};
  for (const char* what : off) file["scene"][what] = "off";
  file["lamps"] = {{{"name", "dim lamp"},
                    {"type", "point"},
                    {"position", {p.value().x, p.value().y, p.value().z}},
                    {"flux", fmt::format("{:g} lm", light.dimLampLm)},
                    {"temperature", kColour}}};
  return writeWhole(light.lighting, file.dump(2) + "\n");
}

}  // namespace

Vec3 dimLampPosition(const Scene& scene, const Camera& camera) {
  const RayScene rays(scene);
  const Vec3 from = camera.worldFromCamera.w, ahead = normalize(camera.worldFromCamera.z * -1.f);
  const Hit hit = rays.intersect({from, ahead});
  return from + ahead * std::min(kFarthestM, hit.valid() ? hit.t / 2 : kFarthestM);
}

Status writeDimLamps(StudyPlan& plan, const RunStore& store) {
  for (StudyScene& s : plan.scenes) {
    for (StudyLight& light : s.lights) {
      if (const Status written = writeDimLamp(s, light, store); !written) return written;
    }
    if (s.walk.empty()) continue;
    if (const Status written = writeDimLamp(s, s.walkLight, store); !written) return written;
  }
  return Ok{};
}

}  // namespace roomlight
