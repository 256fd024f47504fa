#include "bake/layers.h"

#include <fmt/format.h>

#include <cmath>

#include "bake/meter_chunks.h"
#include "base/hash.h"
#include "scene/scene_hash.h"

namespace roomlight::bake {
namespace {

constexpr float kWidestMaskedRad =
    0.035f;  // wider discs are partly below a surface's horizon where their middle is not

constexpr float kLeastLux = 1e-4f;  // a layer that gives nothing more is none

Scene withoutDaylight(Scene scene) {
  scene.suns.clear(), scene.sky = {};
  return scene;
}

Scene withoutLamps(Scene scene) {
  scene.lamps.clear();
  for (Material& m : scene.materials) m.emission = Vec3(0);
  return scene;
}

bool givesLight(const BakedLayer& layer) {
  if (std::any_of(layer.mask.left.begin(), layer.mask.left.end(), [](const auto& l) { return l[1] > 0; })) return true;
  for (const Vec3 e : layer.lux) {
    if (luminance(e) > kLeastLux) return true;
  }
  return false;
}

Vec3 meanColor(const std::vector<Vec3>& lux) {
  Vec3 sum;
  for (const Vec3 e : lux) sum += e;
  return luminance(sum) > 0 ? sum / luminance(sum) : Vec3(1);
}

Result<std::unique_ptr<LitScene>> lit(const Scene& scene, const RenderSettings& settings, Stages& stages) {
  RenderSettings render = settings;
  render.technique = technique::kHybrid;
  return lightScene(scene, render, stages, {.changes = false});
}

Result<std::unique_ptr<LitScene>> litInLayers(const Scene& scene, RenderSettings settings, Stages& stages) {
  settings.layers = true;
  const Lights lights(scene);
  settings.layersByRoom = !layersOf(scene, lights);
  return lit(scene, settings, stages);
}

// What readings depend on beside their places.
std::string inputsOf(const LitScene& light, const LayerSettings& settings) {
  RenderSettings render = settings.render;
  render.threads = 0;
  const MeterSettings& m = settings.meters;
  return hashOf(fmt::format("{} {} {} {} {} {} {} {} {}", version(), settingsToJson(render), m.tolerance,
                            m.fewestSamples, m.mostSamples, m.seed, m.straightSuns, m.together,
                            hashOfScene(light.rays().scene())));
}

void append(BakedLayer& layer, const float* n) {
  layer.lux.push_back({n[0], n[1], n[2]});
  layer.errorLux.push_back(n[3]);
}

// All layers at once, which have no light yet. False once stopped.
bool readLamps(const LitScene& light, std::span<const SurfaceElement> places, const LayerSettings& settings,
               const Progress& progress, std::vector<BakedLayer>& layers) {
  const size_t count = layers.size();
  const MeterChunks chunks{places, 4 * count, inputsOf(light, settings), settings.kept, settings.meters};
  const auto measure = [&](std::span<const SurfaceElement> chunk, const MeterSettings& meters, const Progress& p) {
    const LayeredReadings readings = light.illuminanceInLayers(chunk, meters, p);
    std::vector<float> numbers;
    numbers.reserve(4 * readings.lux.size());
    for (size_t i = 0; i < readings.lux.size(); ++i) {
      const Vec3 e = readings.lux[i];
      numbers.insert(numbers.end(), {e.x, e.y, e.z, readings.standardErrorLux[i]});
    }
    return numbers;
  };
  const auto take = [&](size_t, std::span<const float> numbers) {
    for (size_t i = 0; i < numbers.size() / 4; ++i) append(layers[i % count], &numbers[4 * i]);
  };
  return chunks.read(measure, take, progress);
}

bool readDaylight(const LitScene& light, std::span<const SurfaceElement> places, const LayerSettings& settings,
                  const Progress& progress, BakedLayer& layer) {
  const MeterChunks chunks{places, 4, inputsOf(light, settings), settings.kept, settings.meters};
  const auto measure = [&](std::span<const SurfaceElement> chunk, const MeterSettings& meters, const Progress& p) {
    std::vector<float> numbers;
    for (const MeterReading& r : light.illuminance(chunk, meters, p)) {
      const Vec3 e = r.illuminanceLux;
      numbers.insert(numbers.end(), {e.x, e.y, e.z, static_cast<float>(r.standardErrorLux)});
    }
    return numbers;
  };
  const auto take = [&](size_t, std::span<const float> numbers) {
    for (size_t i = 0; i < numbers.size() / 4; ++i) append(layer, &numbers[4 * i]);
  };
  return chunks.read(measure, take, progress);
}

constexpr int kSkyWidth = 256, kSkyHeight = 128;

Image panoramaOf(const SkyDistribution& sky) {
  Image out(kSkyWidth, kSkyHeight);
  for (int y = 0; y < kSkyHeight; ++y) {
    for (int x = 0; x < kSkyWidth; ++x) {
      const float up = kPi * (0.5f - (static_cast<float>(y) + 0.5f) / kSkyHeight);
      const float right = 2 * kPi * ((static_cast<float>(x) + 0.5f) / kSkyWidth - 0.5f);
      out.at(x, y) = sky.radiance({std::sin(right) * std::cos(up), std::sin(up), -std::cos(right) * std::cos(up)});
    }
  }
  return out;
}

}  // namespace

Result<LampLayers> lampLayers(const Scene& home, const std::vector<SurfaceElement>& elements,
                              const LayerSettings& settings, Stages& stages) {
  const Scene scene = withoutDaylight(home);
  LampLayers out;
  out.ofInstance.assign(scene.instances.size(), -1);
  if (!Lights(scene).hasLocal()) return out;
  const Result<std::unique_ptr<LitScene>> light = litInLayers(scene, settings.render, stages);
  if (!light) return Error{light.error()};
  if (!light.value()) return out;
  const LightLayers* layers = light.value()->layers();
  if (!layers) return Error{"the home has more lamps than can be told apart; group some in a lighting file"};
  std::vector<BakedLayer> found;
  for (const LightLayer& of : layers->layers) {
    found.push_back({of.name, LayerRole::Lamp, Vec3(1), of.position, true, 0});
    if (luminance(of.fluxLm) > 0) found.back().color = of.fluxLm / luminance(of.fluxLm);
  }
  if (!stages.run("lamps", [&](const Progress& p) { return readLamps(*light.value(), elements, settings, p, found); }))
    return out;
  std::vector<int32_t> kept(found.size(), -1);
  for (size_t l = 0; l < found.size(); ++l) {
    if (!givesLight(found[l])) continue;
    kept[l] = static_cast<int32_t>(out.layers.size());
    out.layers.push_back(std::move(found[l]));
  }
  for (size_t e = 0; e < light.value()->lights().emitterCount(); ++e)
    out.ofInstance[light.value()->lights().emitterInstance(e)] = kept[static_cast<size_t>(layers->ofEmitter[e])];
  return out;
}

Result<std::vector<BakedLayer>> daylightLayers(const Scene& home, double hour,
                                               const std::vector<SurfaceElement>& elements, const SunCells& cells,
                                               const LayerSettings& settings, Stages& stages) {
  std::vector<BakedLayer> out;
  for (const bool sun : {true, false}) {
    Scene scene = withoutLamps(home);
    if (sun) scene.sky = {};
    if (!sun) scene.suns.clear();
    if (scene.suns.empty() && !scene.sky.present()) continue;
    const Result<std::unique_ptr<LitScene>> light = lit(scene, settings.render, stages);
    if (!light) return Error{light.error()};
    if (!light.value()) return out;
    BakedLayer layer{sun ? "Sun" : "Sky", sun ? LayerRole::Sun : LayerRole::Sky, {}, {}, true, hour};
    LayerSettings ofLayer = settings;
    if (sun && scene.suns.size() == 1 && scene.suns.front().halfAngleRad <= kWidestMaskedRad) {
      layer.sun = scene.suns.front(), ofLayer.meters.straightSuns = false;
      layer.mask = stages.run(
          "sun mask", [&](const Progress& p) { return sunMaskOf(cells, light.value()->rays(), *layer.sun, p); });
    }
    if (!stages.run(sun ? "sun" : "sky",
                    [&](const Progress& p) { return readDaylight(*light.value(), elements, ofLayer, p, layer); }))
      return out;
    layer.color = layer.sun ? meanColor({layer.sun->illuminanceLux}) : meanColor(layer.lux);
    if (!sun) layer.panorama = panoramaOf(light.value()->lights().sky());
    if (!sun || givesLight(layer)) out.push_back(std::move(layer));
  }
  return out;
}

}  // namespace roomlight::bake
