// Light layers on their way into a file (docs/reference/layers.md).
#pragma once

#include "base/image_layers.h"
#include "engine/render.h"

namespace roomlight {

// `metadata` is that of the picture; what the layers are is added to it. Takes the pictures out of `rendered.layers`.
LayeredImage layeredImage(const Scene& scene, const Camera& camera, Rendered& rendered, Metadata metadata);

}  // namespace roomlight
