// Light layers as techniques make them.
#pragma once

#include <memory>

#include "engine/render.h"
#include "trace/lights.h"

namespace roomlight {

// What the settings ask for: null where that is nothing.
Result<std::shared_ptr<const LightLayers>> wantedLayers(const Scene& scene, const Lights& lights,
                                                        const RenderSettings& settings);

// With what they are; none where `lights` is null.
std::vector<RenderedLayer> described(const LightLayers* lights, std::vector<Image> images);

}  // namespace roomlight
