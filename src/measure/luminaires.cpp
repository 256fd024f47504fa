#include "measure/luminaires.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "photometry/colour_temperature.h"
#include "photometry/spot.h"
#include "scene/scene_lamps.h"
#include "scene/shown_names.h"
#include "trace/lamp_light.h"
#include "trace/lights.h"

namespace roomlight {
namespace {

constexpr float kWhite = 0.005f;        // channels so alike are of white that nobody chose
constexpr float kOffBlackBody = 0.15f;  // of a channel, of light with luminance 1

std::optional<double> chosenKelvin(Vec3 fluxLm) {
  const float y = luminance(fluxLm);
  if (y <= 0) return std::nullopt;
  const Vec3 colour = fluxLm / y;
  if (maxComponent(abs(colour - Vec3(1))) < kWhite) return std::nullopt;
  const double kelvin = nearestWhiteK(colour);
  // The scale of lamps below the range of white light.
  if (kelvin <= kLowestWhiteK || kelvin >= kHighestWhiteK) return std::nullopt;
  return maxComponent(abs(blackBodyColour(kelvin) - colour)) < kOffBlackBody ? std::optional(kelvin) : std::nullopt;
}

const char* kindOf(const Lamp& lamp) {
  if (lamp.web) return "photometric";
  return lamp.kind == LampKind::Area ? "area" : lamp.kind == LampKind::Spot ? "spot" : "point";
}

Vec3 fluxOf(const Lamp& lamp) {
  if (lamp.kind == LampKind::Area) return lamp.luminanceCdM2 * (kPi * lamp.widthM * lamp.heightM);
  if (lamp.kind == LampKind::Spot)
    return lamp.intensityCd *
           static_cast<float>(spotFluxPerCandela(std::cos(lamp.innerConeRad), std::cos(lamp.outerConeRad)));
  return lamp.intensityCd * LampDirections(lamp).fluxPerCandela();
}

}  // namespace

std::vector<Luminaire> luminairesOf(const Scene& scene) {
  const Lights lights(scene);
  std::map<uint32_t, Vec3> emitted;  // by instances
  for (size_t i = 0; i < lights.emitterCount(); ++i) {
    const Instance& instance = scene.instances[lights.emitterInstance(i)];
    const Vec3 emission =
        scene.materials[static_cast<size_t>(scene.meshes[static_cast<size_t>(instance.mesh)].material)].emission;
    emitted[lights.emitterInstance(i)] += emission * (lights.emitterFluxLm(i) / std::max(luminance(emission), 1e-30f));
  }
  std::vector<Luminaire> list;
  const std::vector<SceneLamp> lamps = findLamps(scene);
  const std::vector<std::string> shown = shownLampNames(scene, lamps);
  for (size_t k = 0; k < lamps.size(); ++k) {
    const SceneLamp& found = lamps[k];
    Luminaire l;
    l.name = shown[k].ends_with(kLightSuffix) ? shown[k].substr(0, shown[k].size() - std::string(kLightSuffix).size())
                                              : shown[k];
    Vec3 flux;
    bool area = false;
    for (const size_t i : found.lamps) {
      const Lamp& lamp = scene.lamps[i];
      flux += fluxOf(lamp), l.wattsW += static_cast<double>(lamp.wattsW);
      area = area || lamp.kind == LampKind::Area;
    }
    if (!found.lamps.empty())
      l.kind = kindOf(scene.lamps[found.lamps.front()]), l.position = scene.lamps[found.lamps.front()].position;
    Bounds3 shining;
    for (const uint32_t i : found.instances) {
      if (!area) flux += emitted[i];  // of an area lamp the mesh is its rectangle
      shining.add(instanceBounds(scene, scene.instances[i]));
    }
    if (found.lamps.empty()) l.kind = "shining mesh", l.position = shining.centre();
    l.fluxLm = static_cast<double>(luminance(flux)), l.kelvin = chosenKelvin(flux);
    list.push_back(std::move(l));
  }
  return list;
}

Schedule scheduleOf(const std::vector<Luminaire>& luminaires) {
  Schedule schedule;
  std::vector<Luminaire>& list = schedule.rows;
  const auto near = [](double a, double b) { return std::abs(a - b) <= 0.005 * std::max(std::abs(a), std::abs(b)); };
  for (const Luminaire& l : luminaires) {
    const auto alike = std::find_if(list.begin(), list.end(), [&](const Luminaire& k) {
      return k.name == l.name && k.kind == l.kind && k.room == l.room && near(k.fluxLm, l.fluxLm) &&
             near(k.wattsW, l.wattsW) && k.kelvin.has_value() == l.kelvin.has_value() &&
             near(k.kelvin.value_or(0), l.kelvin.value_or(0));
    });
    schedule.rowOf.push_back(static_cast<size_t>(alike - list.begin()));
    if (alike == list.end()) {
      list.push_back(l);
    } else {
      ++alike->count;
    }
  }
  return schedule;
}

}  // namespace roomlight
