#include "import/gltf_materials.h"

#include <fmt/format.h>

#include <algorithm>

#include "import/gltf_textures.h"

namespace roomlight::importers {
namespace {

constexpr float kBrightest = 1e12f;          // of any unit; keeps squares finite in floats
constexpr float kUnlitWhiteCdM2 = 100;       // an unlit surface shines by itself; white like a monitor

class Reader {
 public:
  explicit Reader(GltfDocument& document) : document_(document), textures_(document) {}

  Material material(const Json& in) {
    Material m;
    m.name = in.name();
    if (const auto pbr = in.find("pbrMetallicRoughness")) metallicRoughness(*pbr, m);
    if (const auto normal = in.find("normalTexture")) {
      m.normalTexture = textures_.reference(*normal);
      m.normalScale = limited(*normal, "scale", 1, -100, 100);
    }
    emission(in, m);
    const std::string mode = in.text("alphaMode", "OPAQUE");
    if (mode != "OPAQUE" && mode != "MASK" && mode != "BLEND") in.at("alphaMode").fail("is none of OPAQUE, MASK and BLEND");
    m.alphaMode = mode == "MASK" ? AlphaMode::Mask : mode == "BLEND" ? AlphaMode::Blend
                                                                     : AlphaMode::Opaque;
    m.alphaCutoff = limited(in, "alphaCutoff", 0.5f, 0, 1e6f);
    m.doubleSided = in.boolean("doubleSided", false);
    glass(in, m);
    if (const auto e = in.extension("KHR_materials_specular")) {
      m.specular = limited(*e, "specularFactor", 1, 0, 1);
      m.specularColor = colour(*e, "specularColorFactor", Vec3(1), 100);
      ignore(*e, "specularTexture");
      ignore(*e, "specularColorTexture");
    }
    if (in.extension("KHR_materials_unlit")) unlit(m);
    return m;
  }

  void decodeTextures(Scene& scene) { textures_.decode(scene); }

 private:
  void metallicRoughness(const Json& pbr, Material& m) {
    if (const auto factor = pbr.find("baseColorFactor")) {
      m.baseColor = colour(pbr, "baseColorFactor", Vec3(1), 1);
      if (factor->size() > 3) m.alpha = limitedTo(static_cast<float>((*factor)[3].number()), 0, 1);
    }
    m.baseColorTexture = textures_.reference(pbr.find("baseColorTexture"));
    m.metallic = limited(pbr, "metallicFactor", 1, 0, 1);
    m.roughness = limited(pbr, "roughnessFactor", 1, 0, 1);
    m.metallicRoughnessTexture = textures_.reference(pbr.find("metallicRoughnessTexture"));
  }

  // A surface whose glow is a picture that cannot be shown stays dark: as bright as its factor would be far too bright.
  void emission(const Json& in, Material& m) {
    m.emission = colour(in, "emissiveFactor", Vec3(0), kBrightest);
    if (const auto e = in.extension("KHR_materials_emissive_strength")) {
      m.emission *= limited(*e, "emissiveStrength", 1, 0, kBrightest);
      m.emission = min(m.emission, Vec3(kBrightest));
    }
    const auto texture = in.find("emissiveTexture");
    m.emissionTexture = textures_.reference(texture);
    if (texture && m.emissionTexture.texture < 0) m.emission = Vec3(0);
  }

  void glass(const Json& in, Material& m) {
    if (const auto e = in.extension("KHR_materials_transmission")) {
      m.transmission = limited(*e, "transmissionFactor", 0, 0, 1);
      m.transmissionTexture = textures_.reference(e->find("transmissionTexture"));
    }
    if (const auto e = in.extension("KHR_materials_ior")) {
      // 0 means that everything is reflected, for old specular-glossiness materials.
      const float ior = e->number("ior", 1.5f);
      m.ior = ior == 0 ? 100 : limited(*e, "ior", 1.5f, 1, 100);
    }
    if (const auto e = in.extension("KHR_materials_volume")) {
      m.thicknessM = limited(*e, "thicknessFactor", 0, 0, 1e6f);
      m.attenuationColor = colour(*e, "attenuationColor", Vec3(1), 1);
      m.attenuationDistanceM = e->number("attenuationDistance", kInfinity);
      if (!(m.attenuationDistanceM > 0)) e->at("attenuationDistance").fail("must be above 0");
      ignore(*e, "thicknessTexture");
    }
  }

  // Takes no light, shows its colour: glows with it and reflects nothing.
  void unlit(Material& m) {
    m.emission = m.baseColor * kUnlitWhiteCdM2;
    m.emissionTexture = m.baseColorTexture;
    m.baseColor = Vec3(0);
    m.metallic = m.specular = 0;
  }

  float limitedTo(float v, float low, float high) {
    if (v < low || v > high) document_.warnings.add("values of materials outside their range are limited to it");
    return std::clamp(v, low, high);
  }
  float limited(const Json& in, const char* key, float fallback, float low, float high) { return limitedTo(in.number(key, fallback), low, high); }
  Vec3 colour(const Json& in, const char* key, Vec3 fallback, float high) {
    const Vec3 c = in.vec3(key, fallback);
    return {limitedTo(c.x, 0, high), limitedTo(c.y, 0, high), limitedTo(c.z, 0, high)};
  }
  void ignore(const Json& in, const char* texture) {
    if (in.find(texture)) document_.warnings.add(fmt::format("{} of materials is ignored, its factor counts", texture));
  }

  GltfDocument& document_;
  GltfTextures textures_;
};

}  // namespace

void addGltfMaterials(GltfDocument& document, Scene& scene) {
  Reader reader(document);
  const Json list = document.root().list("materials");
  for (size_t i = 0; i < list.size(); ++i) scene.materials.push_back(reader.material(list[i]));
  reader.decodeTextures(scene);
}

}  // namespace roomlight::importers
