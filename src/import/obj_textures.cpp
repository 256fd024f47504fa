#include "import/obj.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/parallel.h"
#include "import/failure.h"
#include "import/pictures.h"

namespace roomlight::importers {
namespace {

// The texel of `t` that lies where texel (x, y) of a w x h picture does.
const uint8_t* texelAt(const Texture& t, int x, int y, int w, int h) {
  const size_t column = static_cast<size_t>(x) * static_cast<size_t>(t.width) / static_cast<size_t>(w);
  const size_t row = static_cast<size_t>(y) * static_cast<size_t>(t.height) / static_cast<size_t>(h);
  return t.rgba.data() + 4 * (row * static_cast<size_t>(t.width) + column);
}

// Masks are grey pictures, or pictures whose alpha is the mask.
bool hasAlpha(const Texture& t) {
  for (size_t i = 3; i < t.rgba.size(); i += 4) {
    if (t.rgba[i] != 255) return true;
  }
  return false;
}

}  // namespace

ObjTextures::ObjTextures(const ReadCompanion& companions, const std::set<std::string>& names, Warnings& warnings) {
  std::vector<std::string> found;
  std::vector<Bytes> files;
  for (const std::string& name : names) {
    std::optional<Bytes> bytes = companions(name, fmt::format("picture '{}'", printable(name)));
    if (!bytes) {
      warnings.add("pictures are missing, a plain colour stands in their place");
      continue;
    }
    if (const auto kind = undecodable(*bytes)) {
      warnings.add(fmt::format("pictures of kind {} cannot be decoded", *kind));
      continue;
    }
    found.push_back(name);
    files.push_back(std::move(*bytes));
  }
  std::vector<PictureJob> jobs;
  size_t pixels = 0;
  for (size_t i = 0; i < found.size(); ++i) {
    jobs.push_back({fmt::format("picture '{}'", printable(found[i])), files[i]});
    pixels += claimedPixels(files[i]);
  }
  if (pixels > kMaxAllPixels) fail("", fmt::format("the pictures together have more than {} pixels", kMaxAllPixels));
  // Each by itself, so that a damaged one costs no more than itself.
  std::vector<std::optional<Texture>> textures(jobs.size());
  std::vector<Warnings> said(jobs.size());
  parallelFor(jobs.size(), 1, [&](size_t i) {
    try {
      textures[i] = std::move(decodePictures({jobs[i]}, said[i])[0]);
    } catch (const Failure& failure) {
      said[i].add(fmt::format("{}; a plain colour stands in its place", printable(failure.what(), 200)));
    }
  });
  for (size_t i = 0; i < jobs.size(); ++i) {
    warnings.add(said[i]);
    if (textures[i]) pictures_.emplace(found[i], std::move(*textures[i]));
  }
}

const Texture* ObjTextures::find(const std::string& name) const {
  const auto it = pictures_.find(name);
  return it == pictures_.end() ? nullptr : &it->second;
}

template <class Combine>
int ObjTextures::combined(const char* kind, const std::string& a, const std::string& b, Wrap wrap, Scene& scene,
                          Combine&& combine) {
  const Texture *ta = find(a), *tb = find(b);
  if (!ta && !tb) return -1;
  const auto [entry, isNew] = made_.emplace(fmt::format("{}\n{}\n{}\n{}", kind, a, b, static_cast<int>(wrap)),
                                            static_cast<int>(scene.textures.size()));
  if (!isNew) return entry->second;
  Texture t;
  t.name = ta ? a : b;
  t.wrapU = t.wrapV = wrap;
  t.width = std::max(ta ? ta->width : 0, tb ? tb->width : 0);
  t.height = std::max(ta ? ta->height : 0, tb ? tb->height : 0);
  const size_t pixels = static_cast<size_t>(t.width) * static_cast<size_t>(t.height);
  if ((madePixels_ += pixels) > kMaxAllPixels)
    fail("", fmt::format("the pictures in all their combinations have more than {} pixels", kMaxAllPixels));
  t.rgba.resize(4 * pixels);
  static constexpr uint8_t kWhite[4] = {255, 255, 255, 255};
  uint8_t* out = t.rgba.data();
  for (int y = 0; y < t.height; ++y) {
    for (int x = 0; x < t.width; ++x, out += 4) {
      combine(ta ? texelAt(*ta, x, y, t.width, t.height) : kWhite, tb ? texelAt(*tb, x, y, t.width, t.height) : kWhite,
              out);
    }
  }
  scene.textures.push_back(std::move(t));
  return entry->second;
}

int ObjTextures::colourWithAlpha(const std::string& colour, const std::string& alpha, Wrap wrap, Scene& scene) {
  const Texture* mask = find(alpha);
  const auto [known, isNew] = maskChannels_.try_emplace(alpha, 0);
  if (isNew && mask && hasAlpha(*mask)) known->second = 3;
  const int channel = known->second;
  return combined("colour", colour, alpha, wrap, scene, [&](const uint8_t* c, const uint8_t* a, uint8_t* out) {
    std::copy(c, c + 3, out);
    out[3] = a[channel];
  });
}

int ObjTextures::metallicRoughness(const std::string& metallic, const std::string& roughness, Wrap wrap, Scene& scene) {
  return combined(
      "metallicRoughness", metallic, roughness, wrap, scene,
      [](const uint8_t* m, const uint8_t* r, uint8_t* out) { out[0] = 0, out[1] = r[0], out[2] = m[0], out[3] = 255; });
}

}  // namespace roomlight::importers
