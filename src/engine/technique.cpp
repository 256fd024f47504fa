#include "engine/technique.h"

#include <fmt/format.h>

#include <algorithm>

#include "engine/technique_settings.h"

namespace roomlight {
namespace {

const Technique* const kTechniques[] = {&kHybridTechnique, &kConeTechnique,   &kVxgiTechnique,
                                        &kLpvTechnique,    &kPhotonTechnique, &kPathTechnique};

std::string joined(const std::vector<std::string>& names, const char* between) {
  std::string out;
  for (const std::string& name : names) out += (out.empty() ? "" : between) + name;
  return out;
}

}  // namespace

std::span<const Technique* const> techniques() { return kTechniques; }

const Technique* findTechnique(const std::string& name) {
  const auto found =
      std::find_if(std::begin(kTechniques), std::end(kTechniques), [&](const Technique* t) { return name == t->name; });
  return found == std::end(kTechniques) ? nullptr : *found;
}

Result<const Technique*> techniqueNamed(const std::string& name) {
  if (const Technique* found = findTechnique(name)) return found;
  std::vector<std::string> names;
  for (const Technique* t : kTechniques) names.emplace_back(t->name);
  return Error{fmt::format("unknown technique '{}'; there are {}", name, joined(names, ", "))};
}

std::vector<std::pair<std::string, std::string>> describedTechniques() {
  std::vector<std::pair<std::string, std::string>> list;
  for (const Technique* t : kTechniques) list.emplace_back(t->name, t->about);
  return list;
}

std::string techniquesWith(bool Technique::*capability) {
  std::vector<std::string> names;
  for (const Technique* t : kTechniques) {
    if (t->*capability) names.emplace_back(t->name);
  }
  return joined(names, " or ");
}

Result<std::shared_ptr<const LightLayers>> wantedLayers(const Scene& scene, const Lights& lights,
                                                        const RenderSettings& settings) {
  if (!settings.layers) return std::shared_ptr<const LightLayers>();
  Result<LightLayers> layers = layersOf(scene, lights, settings.layersByRoom ? LayerBy::Room : LayerBy::Name);
  if (!layers) return Error{layers.error()};
  if (layers.value().size() == 0) return Error{"layers: the scene has no light to tell apart"};
  return std::shared_ptr<const LightLayers>(std::make_shared<LightLayers>(std::move(layers).value()));
}

std::vector<RenderedLayer> described(const LightLayers* lights, std::vector<Image> images) {
  std::vector<RenderedLayer> out;
  for (size_t l = 0; lights && l < images.size(); ++l) out.push_back({lights->layers[l], std::move(images[l])});
  return out;
}

}  // namespace roomlight
