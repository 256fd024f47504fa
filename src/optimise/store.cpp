#include "optimise/store.h"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <iterator>

#include "base/write_file.h"
#include "search/checkpoint.h"

namespace roomlight::optimise {
namespace {

constexpr std::string_view kMagic = "roomlight response 2\n";

std::optional<std::string> contentOf(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  if (!in) return std::nullopt;
  return std::string{std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

template <class T>
void put(std::string& out, const std::vector<T>& values) {
  const uint64_t n = values.size();
  out.append(reinterpret_cast<const char*>(&n), sizeof(n));
  out.append(reinterpret_cast<const char*>(values.data()), n * sizeof(T));
}

class Fnv1a {
 public:
  void add(std::string_view bytes) {
    for (const char c : bytes) h_ = (h_ ^ static_cast<unsigned char>(c)) * 0x100000001b3ull;
  }
  template <class T>
  void add(const std::vector<T>& values) {
    add(std::string_view(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T)));
  }
  std::string text() const { return fmt::format("{:016x}", h_); }

 private:
  uint64_t h_ = 0xcbf29ce484222325ull;
};

void add(Fnv1a& hash, const Material& m) {
  hash.add(m.name);
  hash.add(fmt::format("{} {} {} {} {} {} {} {}", m.baseColor.x, m.baseColor.y, m.baseColor.z, m.alpha, m.metallic,
                       m.roughness, m.transmission, m.ior));
  hash.add(fmt::format("{} {} {} {}", m.emission.x, m.emission.y, m.emission.z, m.doubleSided));
}

// Whether a response has as many numbers of each kind as its sizes say.
bool isWhole(const Response& r, const ResponseSizes& sizes) {
  const bool candidates = r.elements == sizes.elements && r.eyes == sizes.eyes &&
                          r.lux.size() == sizes.candidates * sizes.elements &&
                          r.glare.size() == sizes.candidates * sizes.eyes;
  return candidates && r.base.size() == sizes.conditions &&
         std::all_of(r.base.begin(), r.base.end(),
                     [&](const Base& b) { return b.lux.size() == sizes.elements && b.glare.size() == sizes.eyes; });
}

// Reads what put() wrote; once something does not fit, nothing more.
class Reader {
 public:
  explicit Reader(std::string_view bytes) : bytes_(bytes) {}
  template <class T>
  void get(std::vector<T>& out) {
    uint64_t n = 0;
    if (!take(&n, sizeof(n)) || n > bytes_.size() / sizeof(T)) return void(ok = false);
    out.resize(n);
    if (n > 0) take(out.data(), n * sizeof(T));
  }
  bool done() const { return ok && bytes_.empty(); }
  bool ok = true;

 private:
  bool take(void* to, size_t count) {
    if (!ok || count > bytes_.size()) return ok = false;
    std::memcpy(to, bytes_.data(), count);
    bytes_.remove_prefix(count);
    return true;
  }
  std::string_view bytes_;
};

}  // namespace

std::string hashOf(std::string_view text) {
  Fnv1a hash;
  hash.add(text);
  return hash.text();
}

std::string hashOfFile(const std::filesystem::path& file) {
  const auto content = contentOf(file);
  return content ? hashOf(*content) : "-";
}

std::string inputHash(const std::filesystem::path& home, const StudyFile& study, const std::string& settings) {
  std::string all = std::string(kMagic) + hashOfFile(home) + hashOfFile(study.file) + hashOfFile(study.catalogueFile) +
                    (study.lightingFile.empty() ? "" : hashOfFile(study.lightingFile)) + settings;
  for (const Luminaire& l : study.catalogue.luminaires) {
    if (!l.file.empty()) all += hashOfFile(l.file);
  }
  return hashOf(all);
}

std::string hashOfScene(const Scene& scene) {
  static_assert(sizeof(Vec2) == 2 * sizeof(float) && sizeof(Vec3) == 3 * sizeof(float), "no bytes between numbers");
  Fnv1a hash;
  for (const Mesh& m : scene.meshes) hash.add(m.positions), hash.add(m.normals), hash.add(m.uv[0]), hash.add(m.indices);
  for (const Texture& t : scene.textures) hash.add(t.rgba);
  for (const Material& m : scene.materials) add(hash, m);
  return hash.text();
}

Status saveResponse(const std::filesystem::path& file, const std::string& hash, const Response& r) {
  std::string bytes = std::string(kMagic) + hash;
  const std::vector<uint64_t> sizes = {r.elements, r.eyes, r.base.size()};
  put(bytes, sizes), put(bytes, r.lux), put(bytes, r.glare), put(bytes, std::vector<float>{r.worstErrorPercent});
  for (const Base& b : r.base) put(bytes, b.lux), put(bytes, b.glare);
  return writeWhole(file, bytes);
}

std::optional<Response> loadResponse(const std::filesystem::path& file, const std::string& hash,
                                     const ResponseSizes& wanted) {
  const auto bytes = contentOf(file);
  const std::string head = std::string(kMagic) + hash;
  if (!bytes || !bytes->starts_with(head)) return std::nullopt;
  Reader in(std::string_view(*bytes).substr(head.size()));
  Response r;
  std::vector<uint64_t> sizes;
  std::vector<float> error;
  in.get(sizes);
  if (!in.ok || sizes.size() != 3) return std::nullopt;
  in.get(r.lux), in.get(r.glare), in.get(error);
  r.elements = sizes[0], r.eyes = sizes[1];
  for (uint64_t i = 0; i < sizes[2] && in.ok; ++i) {
    Base b;
    in.get(b.lux), in.get(b.glare);
    r.base.push_back(std::move(b));
  }
  if (!in.done() || error.size() != 1 || !isWhole(r, wanted)) return std::nullopt;
  r.worstErrorPercent = error[0];
  return r;
}

Status saveSearch(const std::filesystem::path& file, const std::string& hash, const search::State& state) {
  return writeWhole(file, hash + "\n" + search::toJson(state));
}

std::optional<search::State> loadSearch(const std::filesystem::path& file, const std::string& hash,
                                        const search::Problem& problem) {
  const auto text = contentOf(file);
  if (!text || !text->starts_with(hash + "\n")) return std::nullopt;
  const auto state = search::stateFromJson(std::string_view(*text).substr(hash.size() + 1), problem, file.string());
  if (!state) return std::nullopt;
  return state.value();
}

}  // namespace roomlight::optimise
