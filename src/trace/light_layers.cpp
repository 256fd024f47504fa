#include "trace/light_layers.h"

#include <fmt/format.h>

#include <map>

#include "trace/lamp_light.h"

namespace roomlight {
namespace {

constexpr float kUnderFloorM = 0.05f;

// Of light on its way into layers.
class Grouping {
 public:
  Grouping(const Scene& scene, LayerBy by) : scene_(scene), by_(by) {}

  int32_t add(std::string name, const std::string& group, LayerKind kind, Vec3 fluxLm, Vec3 position) {
    if (name.ends_with(kLightSuffix)) name.resize(name.size() - std::string(kLightSuffix).size());
    if (!group.empty()) name = group, kind = LayerKind::Group;
    if (by_ == LayerBy::Room) {
      const int room = roomAt(scene_, position);
      if (room >= 0) name = scene_.rooms[static_cast<size_t>(room)].name, kind = LayerKind::Group;
      if (room >= 0 && name.empty()) name = fmt::format("room {}", room + 1);
    }
    if (name.empty()) name = kind == LayerKind::Mesh ? "emissive" : "lamp";
    const auto [entry, isNew] = number_.emplace(name, static_cast<int32_t>(out.layers.size()));
    if (isNew) out.layers.push_back({name, kind, {}, {}});
    LightLayer& layer = out.layers[static_cast<size_t>(entry->second)];
    layer.fluxLm += fluxLm;
    layer.position += position * luminance(fluxLm);
    return entry->second;
  }

  LightLayers out;

 private:
  const Scene& scene_;
  const LayerBy by_;
  std::map<std::string, int32_t> number_;
};

bool contains(const Room& room, Vec2 p) {
  bool inside = false;
  for (size_t i = 0, j = room.floor.size() - 1; i < room.floor.size(); j = i++) {
    const Vec2 a = room.floor[i], b = room.floor[j];
    if ((a.y > p.y) != (b.y > p.y) && p.x < (b.x - a.x) * (p.y - a.y) / (b.y - a.y) + a.x) inside = !inside;
  }
  return inside;
}

Vec3 hueOf(const Material& m) { return m.emission / std::max(luminance(m.emission), 1e-30f); }

}  // namespace

int roomAt(const Scene& scene, Vec3 position) {
  for (size_t i = 0; i < scene.rooms.size(); ++i) {
    const Room& room = scene.rooms[i];
    if (position.y < room.elevationM - kUnderFloorM || position.y > room.elevationM + room.heightM) continue;
    if (contains(room, {position.x, position.z})) return static_cast<int>(i);
  }
  return -1;
}

Result<LightLayers> layersOf(const Scene& scene, const Lights& lights, LayerBy by) {
  Grouping grouping(scene, by);
  LightLayers& out = grouping.out;
  for (size_t i = 0; i < lights.lampCount(); ++i) {
    const Lamp& lamp = lights.lamp(i);
    out.ofLamp.push_back(grouping.add(lamp.name, lamp.group, LayerKind::Lamp,
                                      lamp.intensityCd * LampDirections(lamp).fluxPerCandela(), lamp.position));
  }
  for (size_t i = 0; i < lights.emitterCount(); ++i) {
    const Instance& instance = scene.instances[lights.emitterInstance(i)];
    // What stands for an area lamp bears its name.
    const auto lamp = std::find_if(scene.lamps.begin(), scene.lamps.end(),
                                   [&](const Lamp& l) { return l.kind == LampKind::Area && l.name == instance.name; });
    const bool isLamp = lamp != scene.lamps.end() || instance.name.ends_with(kLightSuffix);
    const Material& material =
        scene.materials[static_cast<size_t>(scene.meshes[static_cast<size_t>(instance.mesh)].material)];
    out.ofEmitter.push_back(
        grouping.add(instance.name.empty() ? fmt::format("object {}", instance.object) : instance.name,
                     lamp != scene.lamps.end() ? lamp->group : "", isLamp ? LayerKind::Lamp : LayerKind::Mesh,
                     hueOf(material) * lights.emitterFluxLm(i), lights.emitterBounds(i).centre()));
  }
  for (LightLayer& layer : out.layers) layer.position = layer.position / std::max(luminance(layer.fluxLm), 1e-30f);
  if (lights.sunCount() > 0) {
    Vec3 lux;
    for (size_t i = 0; i < lights.sunCount(); ++i) {
      const LightSample s = lights.sampleSun(i, {0.5f, 0.5f});
      lux += s.radiance;
    }
    out.sun = static_cast<int32_t>(out.layers.size());
    out.layers.push_back({"sun", LayerKind::Sun, lux, {}});
  }
  if (lights.sky().present()) {
    out.sky = static_cast<int32_t>(out.layers.size());
    Vec3 sum;
    constexpr int kPlaces = 16;
    for (int i = 0; i < kPlaces * kPlaces; ++i) {
      const float z = (static_cast<float>(i / kPlaces) + 0.5f) / kPlaces,
                  a = 2 * kPi * static_cast<float>(i % kPlaces) / kPlaces, r = std::sqrt(1 - z * z);
      sum += lights.sky().radiance({r * std::cos(a), z, r * std::sin(a)});
    }
    out.layers.push_back({"sky", LayerKind::Sky, sum / (kPlaces * kPlaces), {}});
  }
  if (out.size() > kMostLayers) {
    return Error{
        fmt::format("layers: the scene has {} lights of different names, at most {} layers are kept; give lamps a "
                    "common \"group\" in the lighting file, or use --layer-groups room",
                    out.size(), kMostLayers)};
  }
  return std::move(out);
}

}  // namespace roomlight
