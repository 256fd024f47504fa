#include "engine/settings.h"

#include <fmt/format.h>

namespace roomlight {
namespace {

struct Preset {
  const char* name;
  const char* explanation;
  void (*change)(RenderSettings&);  // of the defaults
};

constexpr Preset kPresets[] = {
    {"draft", "for trying out",
     [](RenderSettings& s) {
       s.voxel.sizeFactor = 1.4f;
       s.radiance.directSamples = 4, s.radiance.links = 4, s.radiance.residual = 0.01f;
       s.hybrid.samples = 4, s.hybrid.firstSamples = 4, s.hybrid.tolerance = 0, s.hybrid.raysPerShading = 4,
       s.hybrid.causticPhotons = 1 << 15;
     }},
    {"good", "for looking at", [](RenderSettings&) {}},
    {"best", "for keeping: goes on until little error is left",
     [](RenderSettings& s) {
       s.hybrid.samples = 64, s.hybrid.tolerance /= 3, s.hybrid.countsBySize = false;
       s.blendUntilMse = 0.0002;
     }},
};

}  // namespace

std::vector<std::pair<std::string, std::string>> qualities() {
  std::vector<std::pair<std::string, std::string>> list;
  for (const Preset& p : kPresets) list.emplace_back(p.name, p.explanation);
  return list;
}

Status applyQuality(const std::string& name, RenderSettings& settings) {
  std::string names;
  for (const Preset& p : kPresets) {
    names += fmt::format("{}{}", names.empty() ? "" : ", ", p.name);
    if (name != p.name) continue;
    const RenderSettings defaults;
    settings.quality = name;
    settings.voxel = defaults.voxel, settings.radiance = defaults.radiance, settings.hybrid = defaults.hybrid;
    settings.blendUntilMse = defaults.blendUntilMse;
    p.change(settings);
    return Ok{};
  }
  return Error{fmt::format("quality: unknown name '{}'; there are {}", name, names)};
}

}  // namespace roomlight
