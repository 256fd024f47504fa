#include "study/dim_lamp.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "base/write_file.h"
#include "import/import.h"
#include "scene/find_camera.h"
#include "trace/ray_scene.h"

namespace roomlight {
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
