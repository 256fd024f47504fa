#include "optimise/store.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <set>

#include "base/hash.h"
#include "base/sealed_file.h"
#include "scene/scene_hash.h"
#include "search/search.h"

namespace roomlight::optimise {
namespace {

constexpr std::string_view kMagic = "roomlight response 3\n";

template <class T>
void put(std::string& out, const std::vector<T>& values) {
  const uint64_t n = values.size();
  out.append(reinterpret_cast<const char*>(&n), sizeof(n));
  out.append(reinterpret_cast<const char*>(values.data()), n * sizeof(T));
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

// What saveResponse() wrote behind the hash of the inputs; none where it is of other sizes.
std::optional<Response> responseIn(std::string_view bytes, const ResponseSizes& wanted) {
  Reader in(bytes);
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

}  // namespace

std::string hashOfFile(const std::filesystem::path& file) {
  const auto content = contentOf(file);
  return content ? hashOf(*content) : "-";
}

Result<std::string> inputHash(const Scene& home, const StudyFile& study, const std::string& settings) {
  std::string all = std::string(kMagic) + hashOfFile(study.file) + hashOfFile(study.catalogueFile) + settings;
  all += hashOfScene(home);
  for (const Condition& c : study.conditions) {
    const Result<Scene> lit = litBy(home, study, c.daylight, nlohmann::json::array(), true);
    if (!lit) return Error{lit.error()};
    all += hashOfScene(lit.value());
  }
  // Photometric files count as the lamps that they make.
  std::set<size_t> used;
  for (const PlaceRule& p : study.places) used.insert(p.luminaires.begin(), p.luminaires.end());
  nlohmann::json lamps = nlohmann::json::array();
  for (const size_t l : used) lamps.push_back(lampEntry(study.catalogue.luminaires[l], {0, 0, 0}, {0, -1, 0}));
  const Result<Scene> lit = litBy(home, study, nullptr, lamps, false);
  if (!lit) return Error{lit.error()};
  return hashOf(all + hashOfScene(lit.value()));
}

Status saveResponse(const std::filesystem::path& file, const std::string& hash, const Response& r) {
  std::string bytes = std::string(kMagic) + hash;
  const std::vector<uint64_t> sizes = {r.elements, r.eyes, r.base.size()};
  put(bytes, sizes), put(bytes, r.lux), put(bytes, r.glare), put(bytes, std::vector<float>{r.worstErrorPercent});
  for (const Base& b : r.base) put(bytes, b.lux), put(bytes, b.glare);
  return saveSealed(file, std::move(bytes));
}

Result<std::optional<Response>> loadResponse(const std::filesystem::path& file, const std::string& hash,
                                             const ResponseSizes& wanted) {
  const Result<std::optional<std::string>> bytes = loadSealed(file);
  if (!bytes) return Error{bytes.error()};
  const std::string head = std::string(kMagic) + hash;
  if (!bytes.value() || !bytes.value()->starts_with(head)) return std::optional<Response>();
  return responseIn(std::string_view(*bytes.value()).substr(head.size()), wanted);
}

Status saveSearch(const std::filesystem::path& file, const std::string& hash, const search::State& state) {
  return saveSealed(file, hash + "\n" + search::toJson(state));
}

Result<std::optional<search::State>> loadSearch(const std::filesystem::path& file, const std::string& hash,
                                                const search::Problem& problem) {
  const Result<std::optional<std::string>> text = loadSealed(file);
  if (!text) return Error{text.error()};
  if (!text.value() || !text.value()->starts_with(hash + "\n")) return std::optional<search::State>();
  Result<search::State> state =
      search::stateFromJson(std::string_view(*text.value()).substr(hash.size() + 1), problem, file.string());
  if (!state) return std::optional<search::State>();
  return std::optional(std::move(state.value()));
}

}  // namespace roomlight::optimise
