#include "scene/scene_hash.h"

#include <type_traits>

#include "base/hash.h"

namespace roomlight {
namespace {

// Arrays of these are hashed as they lie in memory: there is nothing between their numbers.
template <class T>
constexpr bool kFlat = std::is_arithmetic_v<T> || std::is_same_v<T, Vec2> || std::is_same_v<T, Vec3>;
static_assert(sizeof(Vec2) == 2 * sizeof(float) && sizeof(Vec3) == 3 * sizeof(float));

// Structs are taken apart by name: one that gains or loses a member does not compile until it is counted here as well.
class SceneHash {
 public:
  std::string text() const { return hash_.text(); }

  void add(const Scene& s) {
    const auto& [meshes, instances, leaves, materials, textures, lamps, suns, sky, cameras, cameraInUse, rooms] = s;
    all(meshes, instances, leaves, materials, textures, lamps, suns, sky, cameras, cameraInUse, rooms);
  }

 private:
  template <class... T>
  void all(const T&... members) {
    (add(members), ...);
  }

  template <class T>
    requires std::is_arithmetic_v<T> || std::is_enum_v<T>
  void add(const T& value) {
    uint64_t word = 0;
    std::memcpy(&word, &value, sizeof(value));
    hash_.word(word);
  }
  void add(const std::string& text) { hash_.bytes(text); }
  template <class T, size_t N>
  void add(const T (&items)[N]) {
    for (const T& item : items) add(item);
  }
  template <class T>
  void add(const std::vector<T>& items) {
    if constexpr (kFlat<T>) {
      hash_.bytes({reinterpret_cast<const char*>(items.data()), items.size() * sizeof(T)});
    } else {
      hash_.word(items.size());
      for (const T& item : items) add(item);
    }
  }
  void add(const std::shared_ptr<const PhotometricWeb>& web) {
    add(web != nullptr);
    if (web) add(*web);
  }

  void add(const Vec2& v) {
    const auto& [x, y] = v;
    all(x, y);
  }
  void add(const Vec3& v) {
    const auto& [x, y, z] = v;
    all(x, y, z);
  }
  void add(const Affine& a) {
    const auto& [x, y, z, w] = a;
    all(x, y, z, w);
  }
  void add(const Image& i) {
    const auto& [width, height, pixels] = i;
    all(width, height, pixels);
  }
  void add(const Texture& t) {
    const auto& [name, width, height, wrapU, wrapV, rgba] = t;
    all(name, width, height, wrapU, wrapV, rgba);
  }
  void add(const TextureRef& r) {
    const auto& [texture, uvSet, m] = r;
    all(texture, uvSet, m);
  }
  void add(const Glazing& g) {
    const auto& [panes, ior, internalTransmittance] = g;
    all(panes, ior, internalTransmittance);
  }
  void add(const Material& material) {
    const auto& [name, label, baseColor, alpha, baseColorTexture, metallic, roughness, metallicRoughnessTexture,
                 normalTexture, normalScale, emission, emissionTexture, alphaMode, alphaCutoff, doubleSided,
                 transmission, transmissionTexture, ior, specular, specularColor, attenuationColor,
                 attenuationDistanceM, thicknessM, glazing, glazingReflectance] = material;
    all(name, baseColor, alpha, baseColorTexture, metallic, roughness, metallicRoughnessTexture, normalTexture,
        normalScale, emission, emissionTexture, alphaMode, alphaCutoff, doubleSided, transmission, transmissionTexture,
        ior, specular, specularColor, attenuationColor, attenuationDistanceM, thicknessM, glazing, glazingReflectance);
  }
  void add(const Mesh& mesh) {
    const auto& [name, positions, normals, tangents, tangentSigns, uv, colors, colorAlphas, indices, material] = mesh;
    all(name, positions, normals, tangents, tangentSigns, uv, colors, colorAlphas, indices, material);
  }
  void add(const Leaf& leaf) {
    const auto& [hinge, axis, turnRad, slideM, atRest] = leaf;
    all(hinge, axis, turnRad, slideM, atRest);
  }
  void add(const Instance& instance) {
    const auto& [name, mesh, object, worldFromObject, leaf, label] = instance;  // nothing depends on a label
    all(name, mesh, object, worldFromObject, leaf);
  }
  void add(const PhotometricWeb& web) {
    const auto& [name, manufacturer, format, cRad, gammaRad, candela, peakCd, fluxLm, statedFluxLm, watts, sizeC0M,
                 sizeC90M, heightM, round, tiltRad, tiltFactor] = web;
    all(name, manufacturer, format, cRad, gammaRad, candela, peakCd, fluxLm, statedFluxLm, watts, sizeC0M, sizeC90M,
        heightM, round, tiltRad, tiltFactor);
  }
  void add(const Lamp& lamp) {
    const auto& [name, kind, position, direction, up, intensityCd, web, extended, innerConeRad, outerConeRad, widthM,
                 heightM, luminanceCdM2, wattsW, group] = lamp;
    all(name, kind, position, direction, up, intensityCd, web, extended, innerConeRad, outerConeRad, widthM, heightM,
        luminanceCdM2, wattsW, group);
  }
  void add(const Sun& sun) {
    const auto& [name, toLight, illuminanceLux, halfAngleRad] = sun;
    all(name, toLight, illuminanceLux, halfAngleRad);
  }
  void add(const Sky& sky) {
    const auto& [luminanceCdM2, image, horizonEdge, rotationRad] = sky;
    all(luminanceCdM2, image, horizonEdge, rotationRad);
  }
  void add(const Camera& camera) {
    const auto& [name, worldFromCamera, yFovRad, aspect, nearM, projection, emptyBackdrop, yMagM, cutHeightM] = camera;
    all(name, worldFromCamera, yFovRad, aspect, nearM, projection, emptyBackdrop, yMagM, cutHeightM);
  }
  void add(const Room& room) {
    const auto& [name, floor, elevationM, heightM, use] = room;
    all(name, floor, elevationM, heightM, use);
  }

  Hash hash_;
};

}  // namespace

std::string hashOfScene(const Scene& scene) {
  SceneHash hash;
  hash.add(scene);
  return hash.text();
}

}  // namespace roomlight
