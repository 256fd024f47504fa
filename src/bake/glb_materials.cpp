#include "bake/glb_materials.h"

#include <algorithm>
#include <cmath>

#include "base/image_io.h"
#include "scene/surface.h"

namespace roomlight::bake {
namespace {

constexpr float kNormalQuality = 92;  // of WebP
constexpr int kJpegQuality = 90;
constexpr const char *kWebp = "image/webp", *kJpeg = "image/jpeg", *kPng = "image/png";
constexpr int kClamp = 33071, kMirror = 33648, kRepeat = 10497, kLinear = 9729;  // as glTF numbers them

int wrapOf(Wrap wrap) { return wrap == Wrap::ClampToEdge ? kClamp : wrap == Wrap::MirroredRepeat ? kMirror : kRepeat; }

bool opaque(const Texture& t) {
  for (size_t i = 3; i < t.rgba.size(); i += 4) {
    if (t.rgba[i] != 255) return false;
  }
  return true;
}

// Means over squares of texels, so that no edge is longer than `most`. Colours are averaged as they are encoded.
Texture scaledDown(const Texture& t, int most) {
  const int by = (std::max(t.width, t.height) + most - 1) / most;
  if (by <= 1) return t;
  Texture out{t.name, std::max(1, t.width / by), std::max(1, t.height / by), t.wrapU, t.wrapV, {}};
  for (int y = 0; y < out.height; ++y) {
    for (int x = 0; x < out.width; ++x) {
      uint32_t sum[4] = {}, count = 0;
      for (int j = y * by; j < std::min((y + 1) * by, t.height); ++j) {
        for (int i = x * by; i < std::min((x + 1) * by, t.width); ++i, ++count) {
          for (int c = 0; c < 4; ++c)
            sum[c] += t.rgba[(static_cast<size_t>(j) * static_cast<size_t>(t.width) + static_cast<size_t>(i)) * 4 +
                             static_cast<size_t>(c)];
        }
      }
      for (const uint32_t s : sum) out.rgba.push_back(static_cast<uint8_t>((s + count / 2) / count));
    }
  }
  return out;
}

ByteImage bytesOf(const Texture& t, int channels) {
  ByteImage image;
  image.width = t.width, image.height = t.height, image.channels = channels;
  for (size_t i = 0; i < t.rgba.size(); i += 4)
    image.samples.insert(image.samples.end(), t.rgba.begin() + static_cast<ptrdiff_t>(i),
                         t.rgba.begin() + static_cast<ptrdiff_t>(i) + channels);
  return image;
}

bool sameCoordinates(const TextureRef& a, const TextureRef& b) {
  return a.uvSet == b.uvSet && std::equal(&a.m[0][0], &a.m[0][0] + 6, &b.m[0][0]);
}

Json colorJson(Vec3 c) { return {c.x, c.y, c.z}; }

}  // namespace

const TextureRef* coordinatesOf(const Material& m) {
  for (const TextureRef* ref :
       {&m.baseColorTexture, &m.emissionTexture, &m.metallicRoughnessTexture, &m.normalTexture}) {
    if (ref->texture >= 0) return ref;
  }
  return nullptr;
}

bool GlbMaterials::textured(int material) const {
  return coordinatesOf(scene_.materials[static_cast<size_t>(material)]) != nullptr;
}

Result<int> GlbMaterials::texture(int number, float quality) {
  if (const auto known = textureOf_.find(number); known != textureOf_.end()) return known->second;
  const Texture small = scaledDown(scene_.textures[static_cast<size_t>(number)], settings_.mostTexturePixels);
  const Json sampler = {{"wrapS", wrapOf(small.wrapU)}, {"wrapT", wrapOf(small.wrapV)}};
  const ByteImage bytes = bytesOf(small, opaque(small) ? 3 : 4);
  // Where the file is compressed its reader is known to read WebP.
  const char* type = settings_.compressed ? kWebp : bytes.channels == 3 && quality < kNormalQuality ? kJpeg : kPng;
  const Result<std::string> picture = type == kWebp   ? encodeWebp(bytes, quality)
                                      : type == kJpeg ? encodeJpeg(bytes, kJpegQuality)
                                                      : encodePng(bytes);
  if (!picture) return Error{picture.error()};
  return textureOf_[number] = addTexture(picture.value(), type, sampler);
}

int GlbMaterials::addTexture(const std::string& picture, const char* type, const Json& sampler) {
  const auto place = std::find(samplers_.begin(), samplers_.end(), sampler);
  const auto samplerNumber = static_cast<int>(place - samplers_.begin());
  if (place == samplers_.end()) samplers_.push_back(sampler);
  const auto image = static_cast<int>(images_.size());
  bytes_ += picture.size();
  images_.push_back({{"bufferView", glb_.addView(picture)}, {"mimeType", type}});
  Json texture = {{"sampler", samplerNumber}};
  if (type == kWebp) {
    texture["extensions"]["EXT_texture_webp"]["source"] = image;
  } else {
    texture["source"] = image;
  }
  textures_.push_back(texture);
  return static_cast<int>(textures_.size()) - 1;
}

// As PNG, so that a home without other textures needs no extension.
Result<int> GlbMaterials::useLightMap(const LightMap& map, float exposure) {
  const Result<std::string> png = encodePng(map.image);
  if (!png) return Error{png.error()};
  // Without smaller copies of it, which would mix charts.
  const Json sampler = {{"wrapS", kClamp}, {"wrapT", kClamp}, {"minFilter", kLinear}, {"magFilter", kLinear}};
  const int number = addTexture(png.value(), kPng, sampler);
  lightMap_ = {{"index", number}, {"texCoord", 1}, {"intensity", map.luxAtOne * exposure}};
  return number;
}

// Those that lie where the first does: there is one set of coordinates.
Status GlbMaterials::addTextures(const Material& m, Json& json, Json& pbr) {
  const TextureRef* first = coordinatesOf(m);
  if (!first) return Ok{};
  const auto add = [&](const TextureRef& ref, Json& into, const char* key, float quality) -> Status {
    if (ref.texture < 0 || !sameCoordinates(ref, *first)) return Ok{};
    const Result<int> number = texture(ref.texture, quality);
    if (!number) return Error{number.error()};
    into[key] = {{"index", number.value()}};
    return Ok{};
  };
  const float usual = settings_.textureQuality;
  if (const Status s = add(m.baseColorTexture, pbr, "baseColorTexture", usual); !s) return s;
  if (const Status s = add(m.metallicRoughnessTexture, pbr, "metallicRoughnessTexture", usual); !s) return s;
  // Steps of directions are seen in what shines.
  if (const Status s = add(m.normalTexture, json, "normalTexture", std::max(usual, kNormalQuality)); !s) return s;
  if (json.contains("normalTexture")) json["normalTexture"]["scale"] = m.normalScale;
  return add(m.emissionTexture, json, "emissiveTexture", usual);
}

// Glass lets through what is behind it and adds what it reflects; alpha is how much of a place is covered at all.
void GlbMaterials::addTransparency(const Material& m, Json& json, Json& pbr) {
  Vec3 color = m.baseColor;
  float transmission = m.metallic < 1 ? m.transmission : 0;
  if (m.glazing.panes > 0) {
    // All that is not reflected passes, tinted: nothing is scattered.
    color = Vec3(glazingLight(m.glazing, 1).transmitted), transmission = 1;
    pbr["roughnessFactor"] = 0, pbr["metallicFactor"] = 0;
  }
  color = min(max(color, Vec3(0)), Vec3(1));
  pbr["baseColorFactor"] = {color.x, color.y, color.z, std::clamp(m.alpha, 0.0f, 1.0f)};
  if (transmission > 0) json["extensions"]["KHR_materials_transmission"] = {{"transmissionFactor", transmission}};
  if (m.alphaMode == AlphaMode::Blend) {
    json["alphaMode"] = "BLEND";
  } else if (m.alphaMode == AlphaMode::Mask) {
    json["alphaMode"] = "MASK", json["alphaCutoff"] = m.alphaCutoff;
  }
}

Result<int> GlbMaterials::add(int number, int layer, bool shines) {
  const Material& m = scene_.materials[static_cast<size_t>(number)];
  Json json = {{"name", m.name}};
  Json pbr = {{"metallicFactor", m.metallic}, {"roughnessFactor", m.roughness}};
  addTransparency(m, json, pbr);
  if (const Status s = addTextures(m, json, pbr); !s) return Error{s.error()};
  json["pbrMetallicRoughness"] = pbr;
  if (const float most = maxComponent(m.emission); shines && most > 0) {
    json["emissiveFactor"] = colorJson(m.emission / most);
    json["extensions"]["KHR_materials_emissive_strength"] = {{"emissiveStrength", most}};
    if (layer >= 0) json["extras"]["lightLayers"] = Json::array({layer});
  }
  if (m.ior != 1.5f) json["extensions"]["KHR_materials_ior"] = {{"ior", m.ior}};
  if (m.specular != 1 || !(m.specularColor == Vec3(1)))
    json["extensions"]["KHR_materials_specular"] = {{"specularFactor", m.specular},
                                                    {"specularColorFactor", colorJson(m.specularColor)}};
  if (!lightMap_.is_null()) json["extensions"]["MOZ_lightmap"] = lightMap_;
  materials_.push_back(json);
  return static_cast<int>(materials_.size()) - 1;
}

void GlbMaterials::finish() {
  // Normals are bytes.
  Json used = Json::array({"KHR_mesh_quantization"}), required = used;
  for (const char* name : {"KHR_materials_emissive_strength", "KHR_materials_ior", "KHR_materials_specular",
                           "KHR_materials_transmission", "MOZ_lightmap"}) {
    if (std::any_of(materials_.begin(), materials_.end(),
                    [&](const Json& m) { return m.contains("extensions") && m["extensions"].contains(name); }))
      used.push_back(name);
  }
  glb_.json["materials"] = materials_;
  if (settings_.compressed && !textureOf_.empty())
    used.push_back("EXT_texture_webp"), required.push_back("EXT_texture_webp");
  glb_.json["extensionsUsed"] = used, glb_.json["extensionsRequired"] = required;
  if (textures_.empty()) return;
  glb_.json["textures"] = textures_, glb_.json["images"] = images_, glb_.json["samplers"] = samplers_;
}

}  // namespace roomlight::bake
