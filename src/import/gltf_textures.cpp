#include "import/gltf_textures.h"

#include <fmt/format.h>

#include <cmath>

#include "import/failure.h"
#include "import/pictures.h"

namespace roomlight::importers {
namespace {

Wrap wrapOf(const Json& sampler, const char* key) {
  switch (sampler.integer(key, 10497, 65535)) {
    case 10497: return Wrap::Repeat;
    case 33071: return Wrap::ClampToEdge;
    case 33648: return Wrap::MirroredRepeat;
    default: sampler.at(key).fail("is no wrap mode");
  }
}

float at(const Json& list, size_t i, float most) {
  const double v = list[i].number();
  if (std::abs(v) > most) list[i].fail(fmt::format("is {}, outside -{} to {}", v, most, most));
  return static_cast<float>(v);
}

// KHR_texture_transform: offset * rotation * scale, the rotation clockwise on the picture (v points down).
void applyTransform(const Json& transform, TextureRef& ref) {
  constexpr float kMost = 1e6f;
  float offset[2] = {0, 0}, scale[2] = {1, 1};
  for (size_t k = 0; k < 2; ++k) {
    if (const auto v = transform.find("offset")) offset[k] = at(*v, k, kMost);
    if (const auto v = transform.find("scale")) scale[k] = at(*v, k, kMost);
  }
  const float r = transform.number("rotation", 0), c = std::cos(r), s = std::sin(r);
  ref.m[0][0] = c * scale[0], ref.m[0][1] = s * scale[1], ref.m[0][2] = offset[0];
  ref.m[1][0] = -s * scale[0], ref.m[1][1] = c * scale[1], ref.m[1][2] = offset[1];
}

}  // namespace

// The picture in the best format that can be decoded; -1: none.
int GltfTextures::imageOf(const Json& texture) {
  const size_t count = document_.root().list("images").size();
  if (const auto webp = texture.extension("EXT_texture_webp"); webp && webp->find("source")) return webp->index("source", count);
  const int source = texture.index("source", count);
  if (source < 0 && texture.extension("KHR_texture_basisu")) {
    return texture.extension("KHR_texture_basisu")->index("source", count);  // found undecodable when it is opened
  }
  if (source < 0) document_.warnings.add("textures without a picture are ignored");
  return source;
}

GltfTextures::Picture& GltfTextures::open(int image) {
  const auto [entry, isNew] = pictures_.try_emplace(image);
  Picture& picture = entry->second;
  if (!isNew) return picture;
  const Json json = document_.root().list("images")[static_cast<size_t>(image)];
  if (const auto uri = json.find("uri")) {
    storage_.push_back(std::make_unique<Bytes>(readUri(document_.folder, uri->text(), uri->path())));
    picture.bytes = *storage_.back();
  } else {
    picture.bytes = document_.views[static_cast<size_t>(json.at("bufferView").index(document_.views.size()))].bytes;
  }
  if (const auto kind = undecodable(picture.bytes)) {
    document_.warnings.add(fmt::format("pictures of kind {} cannot be decoded, their materials show without them", *kind));
    picture.honoured = false;
  }
  return picture;
}

TextureRef GltfTextures::reference(const std::optional<Json>& info) {
  TextureRef ref;
  if (!info) return ref;
  const Json textures = document_.root().list("textures");
  const Json texture = textures[static_cast<size_t>(info->at("index").index(textures.size()))];
  const auto transform = info->extension("KHR_texture_transform");
  uint64_t uvSet = info->integer("texCoord", 0, 1 << 20);
  if (transform) {
    applyTransform(*transform, ref);
    uvSet = transform->integer("texCoord", uvSet, 1 << 20);
  }
  if (uvSet > 1) {
    document_.warnings.add("textures with coordinates from a set above 1 are ignored");
    return {};
  }
  ref.uvSet = static_cast<int>(uvSet);
  Use use{.image = imageOf(texture)};
  if (use.image < 0 || !open(use.image).honoured) return {};
  const Json samplers = document_.root().list("samplers");
  if (const int sampler = texture.index("sampler", samplers.size()); sampler >= 0) {
    use.wrapU = wrapOf(samplers[static_cast<size_t>(sampler)], "wrapS");
    use.wrapV = wrapOf(samplers[static_cast<size_t>(sampler)], "wrapT");
  }
  const auto [entry, isNew] = indices_.emplace(use, static_cast<int>(uses_.size()));
  if (isNew) uses_.push_back(use);
  ref.texture = entry->second;
  return ref;
}

void GltfTextures::decode(Scene& scene) {
  const Json images = document_.root().list("images");
  std::vector<PictureJob> jobs;
  std::vector<size_t> jobOfUse;
  std::map<int, size_t> jobOfImage;
  for (const Use& use : uses_) {
    const auto [entry, isNew] = jobOfImage.emplace(use.image, jobs.size());
    if (isNew) jobs.push_back({images[static_cast<size_t>(use.image)].path(), pictures_.at(use.image).bytes});
    jobOfUse.push_back(entry->second);
  }
  std::vector<Texture> pictures = decodePictures(jobs, document_.warnings);
  std::vector<size_t> usesLeft(jobs.size());
  for (const size_t job : jobOfUse) ++usesLeft[job];
  for (size_t i = 0; i < uses_.size(); ++i) {
    Texture& picture = pictures[jobOfUse[i]];
    Texture texture = --usesLeft[jobOfUse[i]] == 0 ? std::move(picture) : picture;
    const Json image = images[static_cast<size_t>(uses_[i].image)];
    texture.name = image.name();
    if (texture.name.empty() && image.find("uri")) texture.name = printable(image.at("uri").text());
    texture.wrapU = uses_[i].wrapU, texture.wrapV = uses_[i].wrapV;
    scene.textures.push_back(std::move(texture));
  }
}

}  // namespace roomlight::importers
