// The atlas of a whole scene, as if all of it were seen from outside.
#pragma once

#include "bake/atlas.h"

namespace roomlight::bake {

inline Atlas atlasOfAll(const Scene& scene, const AtlasSettings& settings = {}) {
  SeenSides seen(scene);
  for (uint32_t i = 0; i < scene.instances.size(); ++i) {
    for (uint32_t t = 0; t < scene.meshes[static_cast<size_t>(scene.instances[i].mesh)].triangleCount(); ++t)
      seen.mark(i, t, false);
  }
  ChartSettings charts;
  charts.texelM = settings.texelM;
  return atlasOf(scene, chartsOf(scene, seen, charts), settings).value();
}

}  // namespace roomlight::bake
