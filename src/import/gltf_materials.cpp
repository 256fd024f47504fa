#include "import/gltf_parts.h"

#include <fmt/format.h>

#include <algorithm>

#include "import/gltf_material_parts.h"

namespace roomlight::importers {
namespace {

constexpr float kBrightest = 1e12f;          // of any unit; keeps squares finite in floats
constexpr float kPlastic = 0.04f;             // what plastics and paints mirror
constexpr float kGrey = 0.6f;  // stands in for a lost picture of base colours: white walls would never let light end

class Reader {
 public:
  explicit Reader(GltfDocument& document) : document_(document), textures_(document) {}

  Material material(const Json& in) {
    Material m;
    m.name = in.name();
    if (const auto pbr = in.find("pbrMetallicRoughness")) metallicRoughness(*pbr, m);
    if (const auto e = in.extension("KHR_materials_pbrSpecularGlossiness")) specularGlossiness(*e, m);
    if (const auto normal = in.find("normalTexture")) {
      m.normalTexture = textures_.reference(*normal);
      m.normalScale = limited(*normal, "scale", 1, -100, 100);
    }
    emission(in, m);
    const std::string mode = in.text("alphaMode", "OPAQUE");
    if (mode != "OPAQUE" && mode != "MASK" && mode != "BLEND")
      document_.warnings.add("materials with an unknown alphaMode are opaque");
    m.alphaMode = mode == "MASK" ? AlphaMode::Mask : mode == "BLEND" ? AlphaMode::Blend : AlphaMode::Opaque;
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
    ++materials_;
    return m;
  }

  // After the last material: decodes what they refer to.
  void decodeTextures(Scene& scene) {
    const std::vector<int> indices = textures_.decode(scene);
    for (Material& m : scene.materials) settle(indices, m);
    for (SpecularGlossiness& wish : specularGlossiness_) {
      if (wish.texture.texture < 0) continue;
      wish.texture.texture = indices[static_cast<size_t>(wish.texture.texture)];
      if (wish.texture.texture < 0)
        wish.specular = min(wish.specular, Vec3(kPlastic)), wish.glossiness = std::min(wish.glossiness, 1 - kGrey);
    }
    convertSpecularGlossiness(specularGlossiness_, scene);
  }

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

  void specularGlossiness(const Json& in, Material& m) {
    if (const auto factor = in.find("diffuseFactor"); factor && factor->size() > 3)
      m.alpha = limitedTo(static_cast<float>((*factor)[3].number()), 0, 1);
    m.baseColor = colour(in, "diffuseFactor", Vec3(1), 1);
    m.baseColorTexture = textures_.reference(in.find("diffuseTexture"));
    m.metallicRoughnessTexture = {};
    SpecularGlossiness wish{.material = materials_};
    wish.specular = colour(in, "specularFactor", Vec3(1), 1);
    wish.glossiness = limited(in, "glossinessFactor", 1, 0, 1);
    wish.texture = textures_.reference(in.find("specularGlossinessTexture"));
    specularGlossiness_.push_back(wish);
  }

  // Numbers of textures to their indices, and what stands in for a picture that is lost.
  static void settle(const std::vector<int>& indices, Material& m) {
    const auto lost = [&](TextureRef& ref) {
      if (ref.texture < 0) return false;
      ref.texture = indices[static_cast<size_t>(ref.texture)];
      if (ref.texture < 0) ref = {};
      return ref.texture < 0;
    };
    if (lost(m.baseColorTexture)) m.baseColor *= kGrey;
    if (lost(m.metallicRoughnessTexture)) m.metallic = 0;
    if (lost(m.emissionTexture)) m.emission = Vec3(0);  // as bright as its factor would be far too bright
    lost(m.normalTexture);
    lost(m.transmissionTexture);
  }

  void emission(const Json& in, Material& m) {
    m.emission = colour(in, "emissiveFactor", Vec3(0), kBrightest);
    if (const auto e = in.extension("KHR_materials_emissive_strength")) {
      m.emission *= limited(*e, "emissiveStrength", 1, 0, kBrightest);
      m.emission = min(m.emission, Vec3(kBrightest));
    }
    m.emissionTexture = textures_.reference(in.find("emissiveTexture"));
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
      if (!(m.attenuationDistanceM > 0))
        m.attenuationDistanceM = limitedTo(m.attenuationDistanceM, kInfinity, kInfinity);
      ignore(*e, "thicknessTexture");
    }
  }

  // Files for the web bake their light into such surfaces; here they take the scene's light instead, as paint of that
  // colour.
  void unlit(Material& m) {
    document_.warnings.add(
        "materials that ask for no light (KHR_materials_unlit) are lit as matt ones of their colour");
    m.metallic = m.specular = 0;
    m.roughness = 1;
    m.metallicRoughnessTexture = {};
    std::erase_if(specularGlossiness_, [&](const SpecularGlossiness& wish) { return wish.material == materials_; });
  }

  float limitedTo(float v, float low, float high) {
    if (v < low || v > high) document_.warnings.mended("values of materials outside their range are limited to it");
    return std::clamp(v, low, high);
  }
  float limited(const Json& in, const char* key, float fallback, float low, float high) {
    return limitedTo(in.number(key, fallback), low, high);
  }
  Vec3 colour(const Json& in, const char* key, Vec3 fallback, float high) {
    const Vec3 c = in.vec3(key, fallback);
    return {limitedTo(c.x, 0, high), limitedTo(c.y, 0, high), limitedTo(c.z, 0, high)};
  }
  void ignore(const Json& in, const char* texture) {
    if (in.find(texture)) document_.warnings.add(fmt::format("{} of materials is ignored, its factor counts", texture));
  }

  GltfDocument& document_;
  GltfTextures textures_;
  std::vector<SpecularGlossiness> specularGlossiness_;
  size_t materials_ = 0;  // read so far
};

}  // namespace

void addGltfMaterials(GltfDocument& document, Scene& scene) {
  Reader reader(document);
  const Json list = document.root().list("materials");
  for (size_t i = 0; i < list.size(); ++i) scene.materials.push_back(reader.material(list[i]));
  reader.decodeTextures(scene);
}

}  // namespace roomlight::importers
