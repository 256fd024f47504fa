#include "scene/surface.h"

#include <array>

#include "base/ggx.h"

namespace roomlight {
namespace {

const std::array<float, 256>& srgbTable() {
  static const std::array<float, 256> table = [] {
    std::array<float, 256> t{};
    for (size_t i = 0; i < t.size(); ++i) {
      const float v = static_cast<float>(i) / 255.0f;
      t[i] = v <= 0.04045f ? v / 12.92f : std::pow((v + 0.055f) / 1.055f, 2.4f);
    }
    return t;
  }();
  return table;
}

int wrapTexel(int i, int size, Wrap wrap) {
  if (i >= 0 && i < size) return i;
  switch (wrap) {
    case Wrap::ClampToEdge: return std::clamp(i, 0, size - 1);
    case Wrap::MirroredRepeat: {
      const int period = 2 * size;
      int m = i % period;
      if (m < 0) m += period;
      return m < size ? m : period - 1 - m;
    }
    default: {
      const int m = i % size;
      return m < 0 ? m + size : m;
    }
  }
}

// What a bilinear look-up reads.
struct Texels {
  std::array<const uint8_t*, 4> at;  // RGBA
  std::array<float, 4> weight;

  Texels(const Texture& texture, Vec2 uv) {
    // Far coordinates carry no sub-texel information any more; the clamp keeps the conversion to int defined.
    const float x = std::clamp(uv.x * static_cast<float>(texture.width), -1e8f, 1e8f) - 0.5f;
    const float y = std::clamp(uv.y * static_cast<float>(texture.height), -1e8f, 1e8f) - 0.5f;
    const float fx = std::floor(x), fy = std::floor(y);
    const int x0 = static_cast<int>(fx), y0 = static_cast<int>(fy);
    const float wx = x - fx, wy = y - fy;
    const int columns[2] = {wrapTexel(x0, texture.width, texture.wrapU),
                            wrapTexel(x0 + 1, texture.width, texture.wrapU)};
    const int rows[2] = {wrapTexel(y0, texture.height, texture.wrapV),
                         wrapTexel(y0 + 1, texture.height, texture.wrapV)};
    for (size_t k = 0; k < 4; ++k) {
      weight[k] = ((k & 1) ? wx : 1 - wx) * ((k >> 1) ? wy : 1 - wy);
      at[k] = &texture.rgba[4 * (static_cast<size_t>(rows[k >> 1]) * static_cast<size_t>(texture.width) +
                                 static_cast<size_t>(columns[k & 1]))];
    }
  }
  float alpha() const {
    float sum = 0;
    for (size_t k = 0; k < 4; ++k) sum += static_cast<float>(at[k][3]) * (weight[k] / 255.0f);
    return sum;
  }
};

Rgba textureAt(const Scene& scene, const TextureRef& ref, const VertexValues& values, bool srgb) {
  return sampleTexture(scene.textures[static_cast<size_t>(ref.texture)], transformUv(ref, values.uv[ref.uvSet]), srgb);
}

template <class T>
T interpolate(const std::vector<T>& values, const Mesh& mesh, TrianglePoint p) {
  const uint32_t* i = &mesh.indices[size_t{3} * p.triangle];
  return values[i[0]] * (1 - p.b1 - p.b2) + values[i[1]] * p.b1 + values[i[2]] * p.b2;
}

}  // namespace

float alphaByMode(const Material& material, float alpha) {
  switch (material.alphaMode) {
    case AlphaMode::Mask: return alpha >= material.alphaCutoff ? 1.0f : 0.0f;
    case AlphaMode::Blend: return std::clamp(alpha, 0.0f, 1.0f);
    default: return 1;
  }
}

Vec2 transformUv(const TextureRef& ref, Vec2 uv) {
  return {ref.m[0][0] * uv.x + ref.m[0][1] * uv.y + ref.m[0][2], ref.m[1][0] * uv.x + ref.m[1][1] * uv.y + ref.m[1][2]};
}

Rgba sampleTexture(const Texture& texture, Vec2 uv, bool srgb) {
  const auto& decode = srgbTable();
  const Texels texels(texture, uv);
  Rgba sum{{0, 0, 0}, texels.alpha()};
  for (size_t k = 0; k < 4; ++k) {
    const uint8_t* t = texels.at[k];
    const Vec3 rgb =
        srgb ? Vec3{decode[t[0]], decode[t[1]], decode[t[2]]}
             : Vec3{static_cast<float>(t[0]), static_cast<float>(t[1]), static_cast<float>(t[2])} * (1 / 255.0f);
    sum.rgb += rgb * texels.weight[k];
  }
  return sum;
}

bool isUniform(const Material& m, const Mesh& mesh) {
  return m.baseColorTexture.texture < 0 && m.metallicRoughnessTexture.texture < 0 &&
         m.transmissionTexture.texture < 0 && m.emissionTexture.texture < 0 && mesh.colors.empty() &&
         mesh.colorAlphas.empty();
}

float alphaAt(const Scene& scene, const Mesh& mesh, TrianglePoint p) {
  const Material& material = scene.materials[static_cast<size_t>(mesh.material)];
  if (material.alphaMode == AlphaMode::Opaque) return 1;
  float alpha = material.alpha;
  if (!mesh.colorAlphas.empty()) alpha *= interpolate(mesh.colorAlphas, mesh, p);
  if (material.baseColorTexture.texture >= 0) {
    const TextureRef& ref = material.baseColorTexture;
    alpha *= Texels(scene.textures[static_cast<size_t>(ref.texture)],
                    transformUv(ref, vertexValuesAt(mesh, p).uv[ref.uvSet]))
                 .alpha();
  }
  return alphaByMode(material, alpha);
}

VertexValues vertexValuesAt(const Mesh& mesh, TrianglePoint p) {
  VertexValues v;
  for (int set = 0; set < 2; ++set) {
    if (!mesh.uv[set].empty()) v.uv[set] = interpolate(mesh.uv[set], mesh, p);
  }
  if (!mesh.colors.empty()) v.color = interpolate(mesh.colors, mesh, p);
  if (!mesh.colorAlphas.empty()) v.colorAlpha = interpolate(mesh.colorAlphas, mesh, p);
  return v;
}

float texelsOn(const Scene& scene, const Mesh& mesh, uint32_t triangle, const TextureRef& ref) {
  const auto& uv = mesh.uv[ref.uvSet ? 1 : 0];
  if (ref.texture < 0 || uv.empty()) return 0;
  const Texture& texture = scene.textures[static_cast<size_t>(ref.texture)];
  const uint32_t* i = &mesh.indices[size_t{3} * triangle];
  const Vec2 a = transformUv(ref, uv[i[0]]), b = transformUv(ref, uv[i[1]]) - a, c = transformUv(ref, uv[i[2]]) - a;
  return 0.5f * std::abs(b.x * c.y - b.y * c.x) * static_cast<float>(texture.width) *
         static_cast<float>(texture.height);
}

MaterialSample materialAt(const Scene& scene, const Mesh& mesh, TrianglePoint p) {
  const Material& material = scene.materials[static_cast<size_t>(mesh.material)];
  return materialAt(scene, material, isUniform(material, mesh) ? VertexValues{} : vertexValuesAt(mesh, p));
}

MaterialSample materialAt(const Scene& scene, const Material& material, const VertexValues& values) {
  MaterialSample m;
  m.baseColor = material.baseColor * values.color;
  float alpha = material.alpha * values.colorAlpha;
  if (material.baseColorTexture.texture >= 0) {
    const Rgba t = textureAt(scene, material.baseColorTexture, values, true);
    m.baseColor *= t.rgb;
    alpha *= t.a;
  }
  m.baseColor = min(m.baseColor, Vec3(1));
  m.alpha = alphaByMode(material, alpha);
  m.metallic = material.metallic;
  m.roughness = material.roughness;
  if (material.metallicRoughnessTexture.texture >= 0) {
    const Rgba t = textureAt(scene, material.metallicRoughnessTexture, values, false);
    m.roughness *= t.rgb.y;
    m.metallic *= t.rgb.z;
  }
  m.metallic = std::clamp(m.metallic, 0.0f, 1.0f);
  m.roughness = std::clamp(m.roughness, 0.0f, 1.0f);
  m.transmission = material.transmission;
  if (material.transmissionTexture.texture >= 0) {
    m.transmission *= textureAt(scene, material.transmissionTexture, values, false).rgb.x;
  }
  m.transmission = std::clamp(m.transmission, 0.0f, 1.0f);
  m.emission = material.emission;
  if (material.emissionTexture.texture >= 0 && !isBlack(m.emission)) {
    m.emission *= textureAt(scene, material.emissionTexture, values, true).rgb;
  }
  m.emission *= m.alpha;
  const float r = (material.ior - 1) / (material.ior + 1);
  const Vec3 dielectric = min(material.specularColor * (r * r), Vec3(1)) * material.specular;
  m.f0 = lerp(dielectric, m.baseColor, m.metallic);
  m.f90 = Vec3(lerp(material.specular, 1.0f, m.metallic));
  if (material.glazing.panes > 0) {
    m.glazed = &material;
    m.metallic = m.roughness = 0;
    m.transmission = 1;
    m.f0 = Vec3(glazingLight(material.glazing, 1).reflected), m.f90 = Vec3(1);
  }
  return m;
}

Vec3 shadingNormalAt(const Scene& scene, const Mesh& mesh, TrianglePoint p, Vec3 geometric) {
  Vec3 n = geometric;
  if (!mesh.normals.empty()) {
    n = interpolate(mesh.normals, mesh, p);
    const float l = length(n);
    n = l > 1e-6f ? n / l : geometric;
  }
  const Material& material = scene.materials[static_cast<size_t>(mesh.material)];
  if (!hasNormalMap(material, mesh)) return n;
  Vec3 tangent;
  float sign = 1;
  if (!mesh.tangents.empty()) {
    tangent = interpolate(mesh.tangents, mesh, p);
    sign = mesh.tangentSigns[mesh.indices[size_t{3} * p.triangle]];
  } else {
    tangent = triangleTangent(mesh, material.normalTexture, p.triangle, sign);
  }
  return bumpedNormal(scene, material, n, tangent, sign, vertexValuesAt(mesh, p));
}

Vec3 smoothNormalAt(const Mesh& mesh, const Affine& worldFromObject, TrianglePoint p, Vec3 geometric) {
  if (mesh.normals.empty()) return geometric;
  const Vec3 n = worldFromObject.normal(interpolate(mesh.normals, mesh, p));
  const float l = length(n);
  if (!(l > 0)) return geometric;
  return dot(n, geometric) < 0 ? -n / l : n / l;
}

bool hasNormalMap(const Material& material, const Mesh& mesh) {
  return material.normalTexture.texture >= 0 && !mesh.uv[material.normalTexture.uvSet].empty();
}

Vec3 triangleTangent(const Mesh& mesh, const TextureRef& ref, uint32_t triangle, float& sign) {
  const uint32_t* i = &mesh.indices[size_t{3} * triangle];
  const std::vector<Vec2>& uv = mesh.uv[ref.uvSet];
  const Vec2 d1 = uv[i[1]] - uv[i[0]], d2 = uv[i[2]] - uv[i[0]];
  const Vec3 e1 = mesh.positions[i[1]] - mesh.positions[i[0]], e2 = mesh.positions[i[2]] - mesh.positions[i[0]];
  const float det = d1.x * d2.y - d1.y * d2.x;
  sign = det < 0 ? 1.0f : -1.0f;  // v runs down the picture, so the bitangent is against +v
  if (det == 0) return {};
  return (e1 * d2.y - e2 * d1.y) * (1 / det);
}

Vec3 bumpedNormal(const Scene& scene, const Material& material, Vec3 n, Vec3 tangent, float sign,
                  const VertexValues& values) {
  tangent -= n * dot(n, tangent);
  const float l = length(tangent);
  if (!(l > 1e-12f)) return n;
  tangent = tangent / l;
  const Vec3 bitangent = cross(n, tangent) * sign;
  Vec3 t = textureAt(scene, material.normalTexture, values, false).rgb * 2 - Vec3(1);
  t.x *= material.normalScale;
  t.y *= material.normalScale;
  const Vec3 bumped = tangent * t.x + bitangent * t.y + n * t.z;
  const float bl = length(bumped);
  return bl > 1e-6f ? bumped / bl : n;
}

Vec3 bihemisphericalAlbedo(const MaterialSample& m) {
  if (m.glazed) return Vec3(m.glazed->glazingReflectance);
  const AlbedoTerms e = ggxHemisphericalAlbedo(m.roughness);
  const Vec3 specular = m.f0 * e.scale + m.f90 * e.bias;
  const Vec3 diffuse = m.baseColor * ((1 - m.metallic) * (1 - m.transmission));
  return specular + diffuse * (1 - std::min(1.0f, maxComponent(specular)));
}

MaterialSample whitened(const MaterialSample& m) {
  if (m.transmission > 0 || m.glazed) return m;
  MaterialSample white;
  white.baseColor = Vec3(1), white.alpha = m.alpha;
  return white;
}

void glaze(Material& material, const Glazing& glazing) {
  Material window;
  window.name = material.name;
  window.emission = material.emission, window.emissionTexture = material.emissionTexture;
  window.doubleSided = material.doubleSided;
  window.ior = glazing.ior;
  window.glazing = glazing;
  window.glazingReflectance = glazingHemisphericalReflectance(glazing);
  material = window;
}

bool letsLightThrough(const Material& m) {
  return m.glazing.panes > 0 || m.alphaMode != AlphaMode::Opaque || (m.transmission > 0 && m.metallic < 1);
}

bool isPolishedMetal(const Material& m) {
  constexpr float kPolished = 0.2f;  // roughness
  return m.metallic > 0.5f && m.roughness < kPolished;
}

bool throwsLight(const Material& m) {
  constexpr float kPolished = 0.2f;  // roughness
  return isPolishedMetal(m) || m.glazing.panes > 0 || (m.transmission > 0 && m.roughness < kPolished);
}

Vec3 straightTransmittance(const Material& material, const MaterialSample& m, float cosTheta) {
  Vec3 through{0, 0, 0};
  if (m.glazed) {
    through = m.baseColor * glazingLight(material.glazing, cosTheta).transmitted;
  } else if (m.transmission > 0 && m.metallic < 1) {
    // One interface of a thin wall, as KHR_materials_transmission defines it and CIE 171 test 5.5 expects.
    const Vec3 f = fresnelSchlick(m.f0, m.f90, cosTheta);
    through = m.baseColor * (Vec3(1) - f) * (m.transmission * (1 - m.metallic));
    if (material.thicknessM > 0 && std::isfinite(material.attenuationDistanceM) && material.attenuationDistanceM > 0) {
      const float path = 0.5f * material.thicknessM / std::max(cosTheta, 0.1f) / material.attenuationDistanceM;
      const Vec3 c = max(material.attenuationColor, Vec3(0));
      through *= Vec3{std::pow(c.x, path), std::pow(c.y, path), std::pow(c.z, path)};
    }
  }
  return through * m.alpha + Vec3(1 - m.alpha);
}

Vec3 straightTransmittance(const Scene& scene, const Mesh& mesh, TrianglePoint p, float cosTheta) {
  const Material& material = scene.materials[static_cast<size_t>(mesh.material)];
  if (material.glazing.panes == 0 && material.transmission <= 0) return Vec3(1 - alphaAt(scene, mesh, p));
  return straightTransmittance(material, materialAt(scene, mesh, p), cosTheta);
}

}  // namespace roomlight
