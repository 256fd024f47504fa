#include "import/sh3d_paints.h"

#include <fmt/format.h>

#include <atomic>
#include <cmath>

#include "base/tone.h"
#include "base/utf8.h"
#include "import/failure.h"
#include "import/pictures.h"

namespace roomlight::importers::sh3d {

Vec3 linearColour(uint32_t rgb) {
  const auto channel = [&](int shift) { return srgbDecode(static_cast<float>((rgb >> shift) & 0xff) / 255); };
  return {channel(16), channel(8), channel(0)};
}

Material paintedMaterial(const std::string& name, Vec3 reflectance, double shininess) {
  Material m;
  m.name = name;
  m.baseColor = reflectance;
  m.metallic = 0;
  m.specular = shininess > 0 ? 1.0f : 0.0f;
  // Sweet Home 3D's shininess is Blinn-Phong's exponent over 128; as GGX: alpha² = 2 / (n + 2) (Walter et al. 2007),
  // alpha = roughness².
  m.roughness = static_cast<float>(std::pow(2 / (128 * shininess + 2), 0.25));
  return m;
}

Paints::Paints(const Archive& archive, const ContentDigests& digests, const std::set<std::string>& images, Scene& scene,
               Warnings& warnings)
    : scene_(scene) {
  struct Picture {
    std::string name;
    std::vector<Texture> decoded;
    Warnings warnings;
  };
  std::vector<Picture> pictures;
  for (const std::string& image : images) pictures.push_back({image, {}, {}});
  std::atomic<size_t> pixels = 0;
  parallelOrFail(pictures.size(), [&](size_t i) {
    Picture& p = pictures[i];
    try {
      Content content(archive);
      const Bytes* bytes = content.read(p.name);
      if (!bytes) return p.warnings.add("textures whose picture is not in the file are left out");
      if (const auto kind = undecodable(*bytes))
        return p.warnings.add(fmt::format("pictures of kind {} cannot be decoded", *kind));
      if ((pixels += claimedPixels(*bytes)) > kMaxAllPixels) return;
      p.decoded = decodePictures({{"", *bytes}}, p.warnings);
      const auto digest = digests.of(p.name);
      if (digest && !content.has(*digest, p.name)) {
        p.warnings.add(
            fmt::format("the picture '{}' is not what was saved, its digest differs: it is damaged, or was exchanged",
                        printable(p.name)));
      }
    } catch (const Failure& failure) {
      p.warnings.add(
          fmt::format("the picture '{}' is left out: {}", printable(p.name), printable(failure.what(), 200)));
    }
  });
  if (pixels > kMaxAllPixels) fail("", fmt::format("all pictures together have more than {} pixels", kMaxAllPixels));
  for (Picture& p : pictures) {
    warnings.add(p.warnings);
    if (p.decoded.empty()) continue;
    p.decoded[0].name = p.name;
    textures_.emplace(p.name, static_cast<int>(scene.textures.size()));
    scene.textures.push_back(std::move(p.decoded[0]));
  }
}

const Texture* Paints::picture(const std::string& image) const {
  const auto it = textures_.find(image);
  return it == textures_.end() ? nullptr : &scene_.textures[static_cast<size_t>(it->second)];
}

TextureRef Paints::reference(const TextureUse& use) {
  TextureRef ref;
  const auto it = textures_.find(use.image);
  if (it == textures_.end()) return ref;
  ref.texture = it->second;
  // Metres to repeats of the picture: moved by its offset (right and up, of its size), turned, then scaled. v points
  // down here.
  const double c = std::cos(use.angleRad), s = std::sin(use.angleRad);
  const double w = use.widthCm * use.scale / 100, h = use.heightCm * use.scale / 100, u0 = -use.xOffset * w,
               v0 = use.yOffset * h;
  const double rows[2][3] = {{c / w, s / w, (c * u0 + s * v0) / w}, {-s / h, c / h, (c * v0 - s * u0) / h}};
  for (size_t i = 0; i < 2; ++i) {
    for (size_t k = 0; k < 3; ++k) ref.m[i][k] = static_cast<float>(rows[i][k]);
  }
  return ref;
}

int Paints::material(const Paint& paint, const std::string& name) {
  if (!paint.texture) return plain(paint, name);
  const TextureRef ref = reference(*paint.texture);
  if (ref.texture < 0) return plain(paint, name);
  std::string key = fmt::format("{}\n{}\n{}", name, ref.texture, paint.shininess);
  for (const auto& row : ref.m) key += fmt::format("\n{}\n{}\n{}", row[0], row[1], row[2]);
  const auto [entry, isNew] = made_.emplace(key, static_cast<int>(scene_.materials.size()));
  if (isNew) {
    scene_.materials.push_back(paintedMaterial(name, Vec3(kWhiteReflectance), paint.shininess));
    scene_.materials.back().baseColorTexture = ref, scene_.materials.back().label = paint.texture->name;
  }
  return entry->second;
}

int Paints::plain(const Paint& paint, const std::string& name) {
  const uint32_t colour = paint.colour.value_or(0xffffff);
  const auto [entry, isNew] = made_.emplace(fmt::format("{}\n{:06x}\n{}", name, colour, paint.shininess),
                                            static_cast<int>(scene_.materials.size()));
  if (isNew) {
    scene_.materials.push_back(paintedMaterial(name, linearColour(colour) * kWhiteReflectance, paint.shininess));
    scene_.materials.back().label = name == "wall" || name == "ceiling" ? name + " paint" : name;
  }
  return entry->second;
}

}  // namespace roomlight::importers::sh3d
