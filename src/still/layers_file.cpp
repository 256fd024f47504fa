#include "still/layers_file.h"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>

#include "engine/views.h"
#include "mix/layer_info.h"
#include "photometry/colour_temperature.h"
#include "trace/camera_rays.h"

namespace roomlight {
namespace {

using Json = nlohmann::ordered_json;

const char* kindOf(LayerKind kind) {
  switch (kind) {
    case LayerKind::Lamp: return "lamp";
    case LayerKind::Group: return "group";
    case LayerKind::Mesh: return "mesh";
    case LayerKind::Sun: return "sun";
    case LayerKind::Sky: break;
  }
  return "sky";
}

bool isLocal(const LightLayer& light) { return light.kind != LayerKind::Sun && light.kind != LayerKind::Sky; }

Json rgb(Vec3 v) { return {v.x, v.y, v.z}; }

// Whether a lamp belongs to what is seen of a home that is cut open: of a plan, to the level it shows.
bool isOfView(const Scene& scene, const Camera& camera, int room) {
  const std::optional<float> floor = shownFloorM(scene, camera);
  return !floor || (room >= 0 && std::abs(scene.rooms[static_cast<size_t>(room)].elevationM - *floor) < kLevelsApartM);
}

Json layerJson(const RenderedLayer& layer, const std::string& channel, const Scene& scene, const Camera& camera,
               const Image& picture) {
  const LightLayer& light = layer.light;
  const float flux = luminance(light.fluxLm);
  const Vec3 colour = flux > 0 ? light.fluxLm / flux : Vec3(1);
  const std::optional<double> kelvin = kelvinOf(colour);
  Json j{{"channel", channel},
         {"name", light.name},
         {"kind", kindOf(light.kind)},
         {"colour", rgb(colour)},
         {"lightColour", rgb(max(layer.lightColour, Vec3(0)))}};
  j["kelvin"] = kelvin ? Json(*kelvin) : Json();
  j["fluxLm"] = j["room"] = j["position"] = j["pixel"] = Json();
  if (!isLocal(light)) return j;
  j["fluxLm"] = flux;
  const int room = roomAt(scene, light.position);
  if (room >= 0 && !scene.rooms[static_cast<size_t>(room)].name.empty())
    j["room"] = scene.rooms[static_cast<size_t>(room)].name;
  j["position"] = rgb(light.position);
  const std::optional<Vec2> at = CameraRays(camera, picture.width, picture.height).pixelOf(light.position);
  if (at && isOfView(scene, camera, room))
    j["pixel"] = {at->x / static_cast<float>(picture.width), at->y / static_cast<float>(picture.height)};
  return j;
}

}  // namespace

LayeredImage layeredImage(const Scene& scene, const Camera& camera, Rendered& rendered, Metadata metadata) {
  const Image& whole = rendered.image;
  LayeredImage out{whole, {}, std::move(metadata)};
  Json list = Json::array();
  int lamps = 0, meshes = 0;
  for (RenderedLayer& layer : rendered.layers) {
    const LayerKind kind = layer.light.kind;
    const std::string channel = !isLocal(layer.light)     ? kindOf(kind)
                                : kind == LayerKind::Mesh ? fmt::format("mesh_{:02}", ++meshes)
                                                          : fmt::format("lamp_{:02}", ++lamps);
    list.push_back(layerJson(layer, channel, scene, camera, whole));
    out.layers.push_back({channel, std::move(layer.image)});
  }
  Json all{{"version", 1}, {"camera", camera.name}, {"layers", list}};
  if (!rendered.sights.section.empty()) {
    Image shares(whole.width, whole.height);
    for (size_t i = 0; i < shares.pixels.size(); ++i)
      shares.pixels[i] = {rendered.sights.section[i], rendered.sights.backdrop[i], 0};
    all["sights"] = kSightsChannel;
    out.layers.push_back({kSightsChannel, std::move(shares)});
  }
  out.metadata[kLayersKey] = all.dump(-1, ' ', false, Json::error_handler_t::replace);
  return out;
}

}  // namespace roomlight
