// Which lights are told apart where light is kept in layers: lamps and emissive meshes by group or name, the suns, the
 // sky.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "base/result.h"
#include "trace/lights.h"

namespace roomlight {

constexpr size_t kMostLayers = 64;

enum class LayerKind : uint8_t {
  Lamp,
  Group,  // of lamps
  Mesh,   // emissive
  Sun,    // all of them
  Sky
};

struct LightLayer {
  std::string name;  // of a lamp as in the scene; of a sun or sky "sun" and "sky"
  LayerKind kind = LayerKind::Lamp;
  Vec3 fluxLm;  // per channel; luminance(fluxLm) is its luminous flux. Sun and sky: lux and cd/m² of a kind, for their
                // colour alone
  Vec3 position;  // middle of its lamps, by their flux; of sun and sky zero
};

enum class LayerBy : uint8_t {
  Name,
  Room  // lamps in one room of the scene are one layer
};

struct LightLayers {
  std::vector<LightLayer> layers;
  std::vector<int32_t> ofLamp, ofEmitter;  // of Lights
  int32_t sun = -1, sky = -1;  // -1: there is none
  size_t size() const { return layers.size(); }
  // Of a sample of lights; -1: none.
  int32_t of(const LightSample& light) const {
    return light.lamp >= 0      ? ofLamp[static_cast<size_t>(light.lamp)]
           : light.emitter >= 0 ? ofEmitter[static_cast<size_t>(light.emitter)]
                                : -1;
  }
};

// Lamps first, in order of the scene. Error: more than kMostLayers.
Result<LightLayers> layersOf(const Scene& scene, const Lights& lights, LayerBy by = LayerBy::Name);

// The room that a place is in, -1: none.
int roomAt(const Scene& scene, Vec3 position);

}  // namespace roomlight
