#include "import/gltf_material_parts.h"

#include <fmt/format.h>

#include <cmath>

#include "import/failure.h"
#include "import/pictures.h"

namespace roomlight::importers {
namespace {

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

Wrap GltfTextures::wrapOf(const Json& sampler, const char* key) {
  const float mode = sampler.number(key, 10497);
  if (mode == 33071) return Wrap::ClampToEdge;
  if (mode == 33648) return Wrap::MirroredRepeat;
  if (mode != 10497) document_.warnings.add("textures with an unknown wrap mode repeat");
  return Wrap::Repeat;
}

// The picture in the best format that can be decoded; -1: none.
int GltfTextures::imageOf(const Json& texture) {
  const size_t count = document_.root().list("images").size();
  for (const char* extension : {"EXT_texture_webp", "", "KHR_texture_basisu", "EXT_texture_avif", "MSFT_texture_dds"}) {
    const auto holder = *extension ? texture.extension(extension) : texture;
    const int source = holder ? document_.looseIndex(*holder, "source", count) : -1;
    if (source >= 0) return source;
  }
  return -1;
}

std::string GltfTextures::nameOf(int image) const {
  const Json json = document_.root().list("images")[static_cast<size_t>(image)];
  const auto uri = json.find("uri");
  if (uri && uri->raw().is_string() && !uri->text().starts_with("data:")) return printable(uri->text());
  return json.name().empty() ? json.path() : json.name();
}

// What a picture's URI means; where it leads out of the folder or to nothing, a file of that name beside the scene.
std::optional<Bytes> GltfTextures::bytesOf(const Json& uri) {
  const std::string text = uri.text(), decoded = percentDecode(text);
  for (const std::string& reference : {text, decoded.substr(decoded.find_last_of("/\\") + 1)}) {
    try {
      if (auto embedded = dataUri(reference, uri.path())) return embedded;
      if (const auto file = fileOfUri(document_.folder, reference, uri.path())) return readWholeFile(*file, uri.path());
    } catch (const Failure&) {
      continue;
    }
  }
  return std::nullopt;
}

std::span<const uint8_t> GltfTextures::open(int image) {
  const auto [entry, isNew] = pictures_.try_emplace(image);
  if (!isNew) return entry->second;
  const Json json = document_.root().list("images")[static_cast<size_t>(image)];
  std::span<const uint8_t> bytes;
  if (const auto uri = json.find("uri")) {
    if (auto read = bytesOf(*uri)) bytes = *storage_.emplace_back(std::make_unique<Bytes>(std::move(*read)));
  } else if (const int view = document_.looseIndex(json, "bufferView", document_.views.size()); view >= 0) {
    bytes = document_.views[static_cast<size_t>(view)].bytes;
  }
  if (bytes.empty()) {
    missing_.add(nameOf(image));
  } else if (const auto kind = undecodable(bytes)) {
    document_.warnings.add(
        fmt::format("pictures of kind {} cannot be decoded, their materials show without them", *kind));
  } else {
    entry->second = bytes;
  }
  return entry->second;
}

TextureRef GltfTextures::reference(const std::optional<Json>& info) {
  TextureRef ref;
  if (!info) return ref;
  const Json textures = document_.root().list("textures");
  const auto transform = info->extension("KHR_texture_transform");
  uint64_t uvSet = info->integer("texCoord", 0, 1 << 20);
  if (transform) {
    applyTransform(*transform, ref);
    uvSet = transform->integer("texCoord", uvSet, 1 << 20);
  }
  Use use;
  bool isBroken = false;
  if (const int index = info->looseIndex("index", textures.size(), isBroken); index >= 0 && uvSet <= 1) {
    const Json texture = textures[static_cast<size_t>(index)];
    use.image = imageOf(texture);
    const Json samplers = document_.root().list("samplers");
    if (const int sampler = document_.looseIndex(texture, "sampler", samplers.size()); sampler >= 0) {
      use.wrapU = wrapOf(samplers[static_cast<size_t>(sampler)], "wrapS");
      use.wrapV = wrapOf(samplers[static_cast<size_t>(sampler)], "wrapT");
    }
  }
  if (uvSet > 1) {
    document_.warnings.add("textures with coordinates from a set above 1 are ignored");
  } else if (use.image < 0) {
    missing_.add(info->path());
  } else if (open(use.image).empty()) {
    use.image = -1;
  }
  ref.uvSet = uvSet > 1 ? 0 : static_cast<int>(uvSet);
  const auto [entry, isNew] = numbers_.emplace(use, static_cast<int>(uses_.size()));
  if (isNew) uses_.push_back(use);
  ref.texture = entry->second;
  return ref;
}

std::vector<int> GltfTextures::decode(Scene& scene) {
  const Json images = document_.root().list("images");
  std::vector<PictureJob> jobs;
  std::map<int, size_t> jobOfImage;
  std::vector<size_t> usesLeft;
  for (const Use& use : uses_) {
    if (use.image < 0) continue;
    const auto [entry, isNew] = jobOfImage.emplace(use.image, jobs.size());
    if (isNew)
      jobs.push_back({images[static_cast<size_t>(use.image)].path(), pictures_.at(use.image)}), usesLeft.push_back(0);
    ++usesLeft[entry->second];
  }
  std::vector<DecodedPicture> pictures = tryPictures(jobs, document_.warnings);
  Listed damaged;
  for (const auto& [image, job] : jobOfImage) {
    if (!pictures[job].failure.empty())
      damaged.add(fmt::format("{} ({})", nameOf(image), printable(pictures[job].failure, 100)));
  }
  std::vector<int> indices;
  size_t pixels = 0;
  for (const Use& use : uses_) {
    indices.push_back(-1);
    if (use.image < 0) continue;
    const size_t job = jobOfImage.at(use.image);
    if (!pictures[job].failure.empty()) continue;
    // A picture that wraps in several ways is copied for each.
    pixels += pictures[job].texture.rgba.size() / 4;
    if (pixels > kMaxAllPixels) {
      damaged.add(fmt::format("{} (used in so many ways that all pictures have more than {} pixels)", nameOf(use.image),
                              kMaxAllPixels));
      continue;
    }
    Texture texture = --usesLeft[job] == 0 ? std::move(pictures[job].texture) : pictures[job].texture;
    const std::string name = images[static_cast<size_t>(use.image)].name();
    texture.name = name.empty() ? nameOf(use.image) : name;
    texture.wrapU = use.wrapU, texture.wrapV = use.wrapV;
    indices.back() = static_cast<int>(scene.textures.size());
    scene.textures.push_back(std::move(texture));
  }
  missing_.addTo(document_.warnings, "pictures are missing, their materials show without them: ");
  damaged.addTo(document_.warnings, "pictures are damaged, their materials show without them: ");
  return indices;
}

}  // namespace roomlight::importers
