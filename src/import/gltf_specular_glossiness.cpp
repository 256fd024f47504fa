// A specular-glossiness material gives a diffuse colour d and a mirrored share s. Metallic-roughness gives a base
// colour b and a metallic share m with d (1 - max s) = b (1 - 0.04) (1 - m) and s = 0.04 (1 - m) + b m. With the
// brightness of d and s, b cancels out and a quadratic equation is left for m (Khronos Group:
// examples/convert-between-workflows of KHR_materials_pbrSpecularGlossiness).
#include "import/gltf_material_parts.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/parallel.h"
#include "base/tone.h"
#include "base/tone_curves.h"

namespace roomlight::importers {
namespace {

constexpr float kDielectric = 0.04f;
constexpr float kSmall = 1e-6f;

float brightness(Vec3 c) { return std::sqrt(0.299f * c.x * c.x + 0.587f * c.y * c.y + 0.114f * c.z * c.z); }

float metallicOf(float diffuse, float specular, float diffuseShare) {
  if (specular < kDielectric) return 0;
  const float b = diffuse * diffuseShare / (1 - kDielectric) + specular - 2 * kDielectric, c = kDielectric - specular;
  const float root = std::sqrt(std::max(b * b - 4 * kDielectric * c, 0.0f));
  return std::clamp((-b + root) / (2 * kDielectric), 0.0f, 1.0f);
}

// A texture as the conversion reads it: as large as wanted, white where there is none.
class Source {
 public:
  Source(const Scene& scene, const TextureRef& ref)
      : texture_(ref.texture < 0 ? nullptr : &scene.textures[static_cast<size_t>(ref.texture)]) {}

  int width() const { return texture_ ? texture_->width : 1; }
  int height() const { return texture_ ? texture_->height : 1; }
  // The texel of this one that lies at (x, y) of a picture of w x h.
  std::array<uint8_t, 4> at(int x, int y, int w, int h) const {
    if (!texture_) return {255, 255, 255, 255};
    const size_t column = static_cast<size_t>(int64_t{x} * texture_->width / w),
                 row = static_cast<size_t>(int64_t{y} * texture_->height / h);
    const uint8_t* t = &texture_->rgba[4 * (row * static_cast<size_t>(texture_->width) + column)];
    return {t[0], t[1], t[2], t[3]};
  }

 private:
  const Texture* texture_;
};

struct Tables {
  std::array<float, 256> linear;
  std::array<uint8_t, 4096> encoded;
  Tables() {
    for (size_t i = 0; i < linear.size(); ++i) linear[i] = srgbDecode(static_cast<float>(i) / 255);
    for (size_t i = 0; i < encoded.size(); ++i)
      encoded[i] = static_cast<uint8_t>(std::lround(255 * srgbEncode(static_cast<float>(i) / 4095)));
  }
  Vec3 decode(const std::array<uint8_t, 4>& t) const { return {linear[t[0]], linear[t[1]], linear[t[2]]}; }
  uint8_t encode(float v) const { return encoded[static_cast<size_t>(std::lround(4095 * std::clamp(v, 0.0f, 1.0f)))]; }
};

const Tables& tables() {
  static const Tables kTables;
  return kTables;
}

bool sameCoordinates(const TextureRef& a, const TextureRef& b) {
  return a.uvSet == b.uvSet && std::equal(&a.m[0][0], &a.m[0][0] + 6, &b.m[0][0]);
}

struct Converted {
  int diffuse, specular;  // textures
  Vec3 diffuseFactor, specularFactor;
  float glossiness;
  int baseColor, metallicRoughness;
};

class Converter {
 public:
  explicit Converter(Scene& scene) : scene_(scene) {
    for (const Texture& t : scene.textures) texelsLeft_ += 2 * t.rgba.size() / 4;
  }

  void convert(const SpecularGlossiness& in) {
    Material& m = scene_.materials[in.material];
    m.roughness = 1 - in.glossiness;
    const bool constantSpecular = in.texture.texture < 0;
    if (constantSpecular && (m.baseColorTexture.texture < 0 || brightness(in.specular) < kDielectric)) {
      byFactors(m, m.baseColor, in.specular);
    } else if (!constantSpecular && m.baseColorTexture.texture >= 0 &&
               !sameCoordinates(m.baseColorTexture, in.texture)) {
      byMeans(in, m);
    } else if (!byTexels(in, m)) {
      byMeans(in, m);
    }
  }

 private:
  // The material's texture, if any, is scaled as its mean `diffuse` is.
  static void byFactors(Material& m, Vec3 diffuse, Vec3 specular) {
    const MetallicRoughness out = metallicRoughnessOf(diffuse, specular);
    m.metallic = out.metallic;
    m.specular = std::min(1.0f, brightness(specular) / kDielectric);
    if (m.baseColorTexture.texture < 0 || out.metallic > 0.5f) {
      m.baseColor = out.baseColor, m.baseColorTexture = {};
    } else {
      for (int c = 0; c < 3; ++c)
        m.baseColor[c] = std::min(1.0f, m.baseColor[c] * out.baseColor[c] / std::max(diffuse[c], kSmall));
    }
  }

  struct Mean {
    Vec3 colour;
    float alpha = 0;
  };
  Mean meanOf(const TextureRef& ref) const {
    const Source source(scene_, ref);
    Mean mean;
    constexpr int kSide = 64;
    for (int i = 0; i < kSide * kSide; ++i) {
      const auto t = source.at(i % kSide, i / kSide, kSide, kSide);
      mean.colour += tables().decode(t) / (kSide * kSide);
      mean.alpha += static_cast<float>(t[3]) / (255.0f * kSide * kSide);
    }
    return mean;
  }

  void byMeans(const SpecularGlossiness& in, Material& m) {
    const Mean diffuse = meanOf(m.baseColorTexture), specular = meanOf(in.texture);
    m.roughness = 1 - in.glossiness * specular.alpha;
    byFactors(m, m.baseColor * diffuse.colour, in.specular * specular.colour);
  }

  // False where so many texels have been made that a small file could fill the memory.
  bool byTexels(const SpecularGlossiness& in, Material& m) {
    const int diffuseTexture = m.baseColorTexture.texture;
    const auto known = std::find_if(done_.begin(), done_.end(), [&](const Converted& c) {
      return c.diffuse == diffuseTexture && c.specular == in.texture.texture && c.diffuseFactor == m.baseColor &&
             c.specularFactor == in.specular && c.glossiness == in.glossiness;
    });
    const Converted* converted = known == done_.end() ? make(in, m) : &*known;
    if (!converted) return false;
    const TextureRef where = diffuseTexture >= 0 ? m.baseColorTexture : in.texture;
    m.baseColorTexture = m.metallicRoughnessTexture = where;
    m.baseColorTexture.texture = converted->baseColor,
    m.metallicRoughnessTexture.texture = converted->metallicRoughness;
    m.baseColor = Vec3(1);
    m.metallic = m.roughness = 1;
    return true;
  }

  const Converted* make(const SpecularGlossiness& in, const Material& m) {
    const Source diffuse(scene_, m.baseColorTexture), specular(scene_, in.texture);
    const int w = std::max(diffuse.width(), specular.width()), h = std::max(diffuse.height(), specular.height());
    const size_t texels = static_cast<size_t>(w) * static_cast<size_t>(h);
    if (2 * texels > texelsLeft_) return nullptr;
    texelsLeft_ -= 2 * texels;
    const Texture& like = scene_.textures[static_cast<size_t>(
        m.baseColorTexture.texture >= 0 ? m.baseColorTexture.texture : in.texture.texture)];
    Texture base{like.name, w, h, like.wrapU, like.wrapV, std::vector<uint8_t>(4 * texels)}, rough = base;
    parallelFor(static_cast<size_t>(h), 16, [&](size_t row) {
      for (int x = 0; x < w; ++x) {
        const auto d = diffuse.at(x, static_cast<int>(row), w, h), s = specular.at(x, static_cast<int>(row), w, h);
        const MetallicRoughness out =
            metallicRoughnessOf(m.baseColor * tables().decode(d), in.specular * tables().decode(s));
        const size_t at = 4 * (row * static_cast<size_t>(w) + static_cast<size_t>(x));
        for (int c = 0; c < 3; ++c) base.rgba[at + static_cast<size_t>(c)] = tables().encode(out.baseColor[c]);
        base.rgba[at + 3] = d[3];
        rough.rgba[at] = rough.rgba[at + 3] = 255;
        rough.rgba[at + 1] = static_cast<uint8_t>(std::lround(255 - in.glossiness * static_cast<float>(s[3])));
        rough.rgba[at + 2] = static_cast<uint8_t>(std::lround(255 * out.metallic));
      }
    });
    const int first = static_cast<int>(scene_.textures.size());
    done_.push_back(
        {m.baseColorTexture.texture, in.texture.texture, m.baseColor, in.specular, in.glossiness, first, first + 1});
    scene_.textures.push_back(std::move(base));
    scene_.textures.push_back(std::move(rough));
    return &done_.back();
  }

  Scene& scene_;
  size_t texelsLeft_ = size_t{1} << 24;
  std::vector<Converted> done_;
};

}  // namespace

MetallicRoughness metallicRoughnessOf(Vec3 diffuse, Vec3 specular) {
  const float diffuseShare = 1 - maxComponent(specular);
  MetallicRoughness out;
  out.metallic = metallicOf(brightness(diffuse), brightness(specular), diffuseShare);
  const Vec3 ofDiffuse = diffuse * (diffuseShare / (1 - kDielectric) / std::max(1 - out.metallic, kSmall));
  const Vec3 ofSpecular = (specular - Vec3(kDielectric * (1 - out.metallic))) / std::max(out.metallic, kSmall);
  const float metal = out.metallic * out.metallic;
  out.baseColor = max(Vec3(0), min(Vec3(1), ofDiffuse * (1 - metal) + ofSpecular * metal));
  return out;
}

void convertSpecularGlossiness(const std::vector<SpecularGlossiness>& wishes, Scene& scene) {
  Converter converter(scene);
  for (const SpecularGlossiness& wish : wishes) converter.convert(wish);
}

}  // namespace roomlight::importers
