#include "engine/layers.h"

namespace roomlight {

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
