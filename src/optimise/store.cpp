#include "optimise/store.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <map>
#include <set>

#include "base/hash.h"
#include "base/sealed_file.h"
#include "scene/scene_hash.h"
#include "search/search.h"

namespace roomlight::optimise {
namespace {

constexpr std::string_view kMagic = "roomlight response 3\n", kItemMagic = "roomlight response item 1\n";
constexpr size_t kHashSize = 16;  // of inputHash()

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

// What saveItem() writes before the numbers of the item.
std::vector<uint64_t> headOf(const ResponseSizes& sizes, const ItemPlace& place, const ResponseItem& item) {
  return {place.index,      place.all,    sizes.candidates, sizes.elements, sizes.eyes,
          sizes.conditions, sizes.points, item.first,       item.count};
}

struct KeptItem {
  std::string hash;
  ResponseSizes sizes;
  ItemPlace place;
  ResponseItem item;
};

// None where it is something else, or not as many numbers as its sizes say.
std::optional<KeptItem> itemIn(std::string_view bytes) {
  if (!bytes.starts_with(kItemMagic) || bytes.size() < kItemMagic.size() + kHashSize) return std::nullopt;
  KeptItem kept;
  kept.hash = bytes.substr(kItemMagic.size(), kHashSize);
  Reader in(bytes.substr(kItemMagic.size() + kHashSize));
  std::vector<uint64_t> head;
  in.get(head), in.get(kept.item.lux), in.get(kept.item.errorsLux), in.get(kept.item.glare);
  if (!in.done() || head.size() != 9) return std::nullopt;
  kept.place = {head[0], head[1]};
  kept.sizes = {head[2], head[3], head[4], head[5], head[6]};
  kept.item.first = head[7], kept.item.count = head[8];
  const size_t rows = std::max<size_t>(1, kept.item.count);
  const bool fits = kept.item.lux.size() == rows * kept.sizes.elements &&
                    kept.item.glare.size() == rows * kept.sizes.eyes &&
                    kept.item.errorsLux.size() == kept.item.count * kept.sizes.points;
  return fits ? std::optional(std::move(kept)) : std::nullopt;
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

std::string itemFileName(const ItemPlace& place) {
  return fmt::format("response_{:04}_of_{:04}.item", place.index, place.all);
}

Status saveItem(const std::filesystem::path& folder, const std::string& hash, const ResponseSizes& sizes,
                const ItemPlace& place, const ResponseItem& item) {
  std::string bytes = std::string(kItemMagic) + hash;
  put(bytes, headOf(sizes, place, item)), put(bytes, item.lux), put(bytes, item.errorsLux), put(bytes, item.glare);
  return saveSealed(folder / itemFileName(place), std::move(bytes));
}

Result<std::optional<ResponseItem>> loadItem(const std::filesystem::path& folder, const std::string& hash,
                                             const ResponseSizes& sizes, const ItemPlace& place) {
  const Result<std::optional<std::string>> bytes = loadSealed(folder / itemFileName(place));
  if (!bytes) return Error{bytes.error()};
  if (!bytes.value()) return std::optional<ResponseItem>();
  std::optional<KeptItem> kept = itemIn(*bytes.value());
  if (!kept || kept->hash != hash || kept->sizes != sizes || kept->place != place) return std::optional<ResponseItem>();
  return std::optional(std::move(kept->item));
}

Result<size_t> joinItems(const std::vector<std::filesystem::path>& files, const std::filesystem::path& response) {
  std::map<size_t, KeptItem> items;
  for (const std::filesystem::path& file : files) {
    if (file.extension() != ".item") continue;
    const Result<std::optional<std::string>> bytes = loadSealed(file);
    if (!bytes) return Error{bytes.error()};
    std::optional<KeptItem> kept = bytes.value() ? itemIn(*bytes.value()) : std::nullopt;
    if (!kept) return Error{fmt::format("{}: holds no part of a response", file.string())};
    const KeptItem& first = items.empty() ? *kept : items.begin()->second;
    if (kept->hash != first.hash || kept->sizes != first.sizes || kept->place.all != first.place.all)
      return Error{fmt::format("{}: is of another study than the others", file.string())};
    items.insert_or_assign(kept->place.index, std::move(*kept));
  }
  const size_t all = items.empty() ? 0 : items.begin()->second.place.all;
  if (items.empty() || items.size() != all)
    return Error{fmt::format("{} of {} parts of the response are there", items.size(), all)};
  std::vector<ResponseItem> inOrder;
  for (auto& [index, kept] : items) inOrder.push_back(std::move(kept.item));
  const KeptItem& any = items.begin()->second;
  const Response whole = responseOf(any.sizes, inOrder);
  if (!isWhole(whole, any.sizes)) return Error{"parts of the response do not fit together"};
  const Status saved = saveResponse(response, any.hash, whole);
  return saved ? Result<size_t>(all) : Error{saved.error()};
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
