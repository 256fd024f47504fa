#include "import/sh3d_archive.h"

#include <fmt/format.h>
#include <zip.h>

#include <algorithm>
#include <atomic>
#include <map>
#include <mutex>

#include "import/failure.h"

namespace roomlight::importers {
namespace {

using Zip = std::unique_ptr<zip_t, decltype([](zip_t* z) { zip_discard(z); })>;
using ZipFile = std::unique_ptr<zip_file_t, decltype([](zip_file_t* f) { zip_fclose(f); })>;

std::string textOf(zip_error_t& error) {
  std::string text = printable(zip_error_strerror(&error), 200);
  zip_error_fini(&error);
  return text;
}

Zip opened(std::span<const uint8_t> bytes, const std::string& place) {
  zip_error_t error;
  zip_error_init(&error);
  zip_source_t* source = zip_source_buffer_create(bytes.data(), bytes.size(), 0, &error);
  if (!source) fail(place, "the archive cannot be read: " + textOf(error));
  Zip zip(zip_open_from_source(source, ZIP_RDONLY, &error));
  if (!zip) {
    zip_source_free(source);
    fail(place, fmt::format("is no zip file, or a damaged one ({}); save it once more", textOf(error)));
  }
  zip_error_fini(&error);
  return zip;
}

}  // namespace

std::optional<std::string> normalisedEntryName(std::string_view name) {
  if (name.empty() || name.size() > 2048 || name.find('\0') != std::string_view::npos) return {};
  std::string slashes(name), out;
  std::replace(slashes.begin(), slashes.end(), '\\', '/');
  if (slashes.front() == '/' || (slashes.size() > 1 && slashes[1] == ':')) return {};
  for (size_t at = 0; at <= slashes.size();) {
    const size_t end = std::min(slashes.find('/', at), slashes.size());
    const std::string part = slashes.substr(at, end - at);
    if (part == "..") return {};
    if (!part.empty() && part != ".") out += (out.empty() ? "" : "/") + part;
    at = end + 1;
  }
  if (out.empty()) return {};
  return out;
}

struct Archive::State {
  std::span<const uint8_t> bytes;
  std::string place;
  ArchiveLimits limits;
  std::map<std::string, zip_uint64_t, std::less<>> entries;
  std::atomic<size_t> unpacked{0};
  std::mutex guard;        // of `idle`
  std::vector<Zip> idle;   // the library's handles serve one thread at a time

  Zip take() {
    {
      const std::lock_guard lock(guard);
      if (!idle.empty()) {
        Zip zip = std::move(idle.back());
        idle.pop_back();
        return zip;
      }
    }
    return opened(bytes, place);
  }
  void giveBack(Zip zip) {
    const std::lock_guard lock(guard);
    idle.push_back(std::move(zip));
  }
};

Archive::Archive(std::span<const uint8_t> bytes, const std::string& place, const ArchiveLimits& limits)
    : state_(std::make_unique<State>()) {
  state_->bytes = bytes, state_->place = place, state_->limits = limits;
  Zip zip = opened(bytes, place);
  const zip_int64_t count = zip_get_num_entries(zip.get(), 0);
  if (count < 0 || static_cast<size_t>(count) > limits.entries)
    fail(place, fmt::format("holds {} entries; the limit is {}", count, limits.entries));
  for (zip_uint64_t i = 0; i < static_cast<zip_uint64_t>(count); ++i) {
    const char* raw = zip_get_name(zip.get(), i, ZIP_FL_ENC_GUESS);
    const std::string_view name = raw ? raw : "";
    if (name.ends_with('/')) continue;  // a folder
    if (const auto normalised = normalisedEntryName(name)) {
      if (state_->entries.emplace(*normalised, i).second) names_.push_back(*normalised);
    } else {
      ++refused_;
    }
  }
  state_->giveBack(std::move(zip));
}

Archive::~Archive() = default;

bool Archive::has(std::string_view name) const { return indexOf(name).has_value(); }

size_t Archive::sizeOf(std::string_view name) const {
  const auto index = indexOf(name);
  if (!index) return 0;
  Zip zip = state_->take();
  zip_stat_t stat;
  const bool known = zip_stat_index(zip.get(), *index, 0, &stat) == 0 && (stat.valid & ZIP_STAT_SIZE);
  state_->giveBack(std::move(zip));
  return known ? static_cast<size_t>(stat.size) : 0;
}

std::vector<std::string> Archive::namesIn(std::string_view folder) const {
  std::vector<std::string> names;
  for (auto it = state_->entries.lower_bound(folder); it != state_->entries.end() && it->first.starts_with(folder);
       ++it)
    names.push_back(it->first);
  return names;
}

std::optional<uint64_t> Archive::indexOf(std::string_view name) const {
  auto it = state_->entries.find(name);
  if (it == state_->entries.end() && name.find('%') != std::string_view::npos)
    it = state_->entries.find(percentDecode(name));
  return it == state_->entries.end() ? std::nullopt : std::optional<uint64_t>(it->second);
}

std::optional<Bytes> Archive::read(std::string_view name) const {
  const auto index = indexOf(name);
  if (!index) return {};
  const std::string place =
      fmt::format("{}{}entry '{}'", state_->place, state_->place.empty() ? "" : ": ", printable(name));
  Zip zip = state_->take();
  Bytes bytes = unpacked(zip.get(), *index, place);
  state_->giveBack(std::move(zip));
  return bytes;
}

Bytes Archive::unpacked(zip* zip, uint64_t index, const std::string& place) const {
  const ArchiveLimits& limits = state_->limits;
  zip_stat_t stat;
  if (zip_stat_index(zip, index, 0, &stat) != 0) fail(place, "is damaged");
  constexpr zip_uint64_t kWanted = ZIP_STAT_SIZE | ZIP_STAT_COMP_SIZE;
  if ((stat.valid & kWanted) != kWanted) fail(place, "is damaged: it does not say how large it is");
  if ((stat.valid & ZIP_STAT_ENCRYPTION_METHOD) && stat.encryption_method != ZIP_EM_NONE)
    fail(place, "is encrypted; save it without a password");
  if (stat.size > limits.entryBytes)
    fail(place, fmt::format("unpacks to {} bytes; the limit is {}", stat.size, limits.entryBytes));
  const size_t ratio = stat.size > limits.largeBytes ? limits.largeRatio : limits.ratio;
  if (stat.size / ratio > stat.comp_size)
    fail(place, fmt::format("unpacks {} bytes to {}, which no home does", stat.comp_size, stat.size));
  if (state_->unpacked += stat.size; state_->unpacked > limits.totalBytes)
    fail(place, fmt::format("all entries together unpack to more than {} bytes", limits.totalBytes));

  const ZipFile file(zip_fopen_index(zip, index, 0));
  if (!file) fail(place, fmt::format("cannot be unpacked: {}", printable(zip_strerror(zip), 200)));
  Bytes bytes(stat.size);
  size_t filled = 0;
  while (filled < bytes.size()) {
    const zip_int64_t got = zip_fread(file.get(), bytes.data() + filled, bytes.size() - filled);
    if (got <= 0) fail(place, "is damaged or cut short");
    filled += static_cast<size_t>(got);
  }
  // The last read, of nothing, checks the sum over the bytes; more bytes than claimed are damage too.
  uint8_t more = 0;
  if (zip_fread(file.get(), &more, 1) != 0) fail(place, "is damaged: its checksum or its size is wrong");
  return bytes;
}

}  // namespace roomlight::importers
