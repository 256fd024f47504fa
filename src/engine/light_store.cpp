#include "engine/light_store.h"

#include <fmt/format.h>

#include <bit>

#include "base/hash.h"
#include "base/platform/module.h"
#include "base/sealed_file.h"
#include "base/shared_files.h"
#include "engine/settings.h"
#include "engine/time_plan.h"
#include "engine/voxel_light_bytes.h"
#include "scene/scene_hash.h"

namespace roomlight {
namespace {

constexpr double kLongestWaitS = 600;

// Another build may find other light, or lay it out otherwise in memory.
const std::string& hashOfProgram() {
  static const std::string hash = hashOf(buildId());
  return hash;
}

// Structs are taken apart by name: one that gains or loses a member does not compile until it is counted.
class SettingsHash {
 public:
  std::string text() const { return hash_.text(); }
  void add(const std::string& text) { hash_.bytes(text); }

  void add(const VoxelSettings& settings) {
    const auto& [voxelSizeM, sizeFactor, memoryBudgetMiB, smallestM, largestM] = settings;
    all(voxelSizeM, sizeFactor, memoryBudgetMiB, smallestM, largestM);
  }
  void add(const RadianceSettings& settings) {
    const auto& [attenuation, directSamples, links, bounceBy, residual, maxBounces, bouncesAtOnce, emittersApart, still,
                 pyramid, views, seed, layers] = settings;
    all(attenuation, directSamples, links, bounceBy, residual, maxBounces, bouncesAtOnce, emittersApart, still, pyramid,
        seed);
    Scene lookedFrom;
    lookedFrom.cameras = views;
    hash_.bytes(hashOfScene(lookedFrom));
    add(layers != nullptr);
    if (layers) add(*layers);
  }

 private:
  template <class... T>
  void all(const T&... members) {
    (add(members), ...);
  }
  template <class T>
    requires std::is_integral_v<T> || std::is_enum_v<T>
  void add(T value) {
    hash_.word(static_cast<uint64_t>(value));
  }
  void add(float value) { hash_.word(std::bit_cast<uint32_t>(value)); }
  void add(const Vec3& v) {
    for (int k = 0; k < 3; ++k) add(v[k]);
  }
  void add(const LightLayers& of) {
    const auto& [layers, ofLamp, ofEmitter, sun, sky] = of;
    hash_.word(layers.size());
    for (const LightLayer& layer : layers) {
      const auto& [name, kind, fluxLm, position] = layer;
      add(name), add(kind), add(fluxLm), add(position);
    }
    for (const std::vector<int32_t>* list : {&ofLamp, &ofEmitter}) {
      hash_.word(list->size());
      for (const int32_t layer : *list) add(layer);
    }
    add(sun), add(sky);
  }

  Hash hash_;
};

// What the folder of a store has for one lit scene.
class KeptInStore {
 public:
  KeptInStore(const LightStore& store, std::string name, std::shared_ptr<const LightLayers> layers)
      : store_(store),
        files_(store.folder, ".light", store.mostBytes),
        name_(std::move(name)),
        layers_(std::move(layers)) {}

  // None where it is to be found here; then others wait for it until this is gone.
  std::optional<VoxelLight> find(const Progress& progress) {
    std::optional<VoxelLight> light = read();
    if (light || damaged_) return light;
    turn_ = files_.turn(name_, kLongestWaitS, progress);
    if (files_.has(name_)) light = read();
    if (light) turn_.reset();
    return light;
  }
  void keep(const VoxelLight& light) {
    if (const Status kept = files_.keep(name_, bytesOf(light)); !kept)
      warn(fmt::format("the light is not kept: {}", kept.error()));
  }

 private:
  std::optional<VoxelLight> read() {
    const Result<std::optional<std::string>> bytes = files_.find(name_);
    damaged_ = !bytes;
    if (damaged_) warn(bytes.error());
    return bytes && bytes.value() ? voxelLightFrom(*bytes.value(), layers_) : std::nullopt;
  }
  void warn(const std::string& line) const {
    if (store_.warn) store_.warn(line);
  }

  const LightStore& store_;
  SharedFiles files_;
  std::string name_;
  std::shared_ptr<const LightLayers> layers_;
  bool damaged_ = false;
  HeldFolder turn_;
};

}  // namespace

std::string lightName(const Scene& scene, const VoxelSettings& voxel, const RadianceSettings& radiance) {
  SettingsHash settings;
  settings.add(hashOfProgram());
  settings.add(voxel);
  settings.add(radiance);
  return hashOfScene(scene) + "-" + settings.text();
}

VoxelLight sharedLight(const LightStore& store, const RayScene& rays, const Lights& lights, const VoxelSettings& voxel,
                       const RadianceSettings& radiance, Stages& stages) {
  std::optional<KeptInStore> kept;
  std::optional<VoxelLight> found = stages.run("light read", [&](const Progress& p) {
    kept.emplace(store, lightName(rays.scene(), voxel, radiance), radiance.layers);
    return kept->find(p);
  });
  if (found) return std::move(*found);
  VoxelLight light = lightVoxels(rays, lights, voxel, radiance, stages);
  if (stages.cancelled() || light.field.irradianceLux.empty()) return light;
  stages.run("light write", [&](const Progress&) {
    kept->keep(light);
    return true;
  });
  return light;
}

}  // namespace roomlight
