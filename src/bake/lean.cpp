#include "bake/lean.h"

#include <algorithm>
#include <cmath>

namespace roomlight::bake {
namespace {

constexpr size_t kTurns = 4;
constexpr float kSine = 0.5f, kCosine = 0.8660254f;  // of the angle that places are turned by
constexpr float kMostLean = 0.95f;  // of illuminance: light that comes more flatly counts as if it came so

bool hasNormalMap(const Scene& scene, uint32_t instance) {
  const int mesh = scene.instances[instance].mesh;
  const int material = scene.meshes[static_cast<size_t>(mesh)].material;
  return scene.materials[static_cast<size_t>(material)].normalTexture.texture >= 0;
}

}  // namespace

TurnedPlaces turnedPlaces(const Scene& scene, const Atlas& atlas, const LitPlaces& lit) {
  TurnedPlaces out;
  for (size_t i = 0; i < lit.places.size(); ++i) {
    const LitSide& side = lit.sides[i];
    if (side.shared || !hasNormalMap(scene, side.instance)) continue;
    const Chart& chart = atlas.charts[side.chart].chart;
    out.of.push_back(static_cast<uint32_t>(i));
    for (const Vec3 axis : {chart.alongU, chart.alongV}) {
      SurfaceElement place = lit.places[i];
      const Vec3 along = axis - place.normal * dot(axis, place.normal);
      const Vec3 unit = length(along) > 0.1f ? normalize(along) : Frame(place.normal).t;
      for (const float sine : {kSine, -kSine}) {
        place.turned = place.normal * kCosine + unit * sine;
        out.turned.push_back(place);
      }
    }
  }
  return out;
}

void takeLean(const TurnedPlaces& turned, size_t places, BakedLayer& layer) {
  if (!turned.of.empty()) {
    layer.lean.assign(places, Vec3(0));
    for (size_t k = 0; k < turned.of.size(); ++k) {
      const Vec3* lux = &layer.lux[places + kTurns * k];
      const float even = luminance(layer.lux[turned.of[k]]);
      // Half of what light along an axis adds to illuminance, were the place turned by 90° without horizon.
      const auto half = [&](size_t turn) {
        const float along = (luminance(lux[turn]) - luminance(lux[turn + 1])) / (4 * kSine);
        return std::clamp(along, -kMostLean * even, kMostLean * even);
      };
      layer.lean[turned.of[k]] = {even + half(0), even + half(2), even};
    }
  }
  layer.lux.resize(places), layer.errorLux.resize(places);
}

}  // namespace roomlight::bake
