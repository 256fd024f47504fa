// TZif (RFC 8536): header "TZif", version, 15 zero bytes, six big-endian counts (isut, isstd, leap, transitions, types,
// abbreviations), then transition times, their types, and types of 6 bytes (offset, daylight saving, abbreviation).
// From version 2 on the same follows once more with times of 8 bytes.
#include "import/sh3d_environment.h"

#include <cctype>
#include <span>

#include "import/failure.h"
#include "import/file_access.h"

namespace roomlight::importers::sh3d {
namespace {

constexpr size_t kHeader = 44;
constexpr uintmax_t kMaxBytes = 1 << 20;

int64_t bigEndian(std::span<const uint8_t> bytes) {
  uint64_t v = bytes[0] & 0x80 ? ~uint64_t{0} : 0;
  for (const uint8_t b : bytes) v = v << 8 | b;
  return static_cast<int64_t>(v);
}

struct Block {
  std::span<const uint8_t> times, types, rules;
  size_t timeBytes = 4, bytes = 0;
};

std::optional<Block> blockOf(std::span<const uint8_t> file, size_t timeBytes) {
  if (file.size() < kHeader || file[0] != 'T' || file[1] != 'Z' || file[2] != 'i' || file[3] != 'f') return {};
  size_t counts[6];
  for (size_t i = 0; i < 6; ++i) {
    const int64_t v = bigEndian(file.subspan(20 + 4 * i, 4));
    if (v < 0 || v > static_cast<int64_t>(kMaxBytes)) return {};
    counts[i] = static_cast<size_t>(v);
  }
  const auto [isUt, isStd, leaps, transitions, types, letters] = counts;
  Block b;
  b.timeBytes = timeBytes;
  b.bytes = kHeader + transitions * (timeBytes + 1) + types * 6 + letters + leaps * (timeBytes + 4) + isStd + isUt;
  if (types == 0 || b.bytes > file.size()) return {};
  b.times = file.subspan(kHeader, transitions * timeBytes);
  b.types = file.subspan(kHeader + transitions * timeBytes, transitions);
  b.rules = file.subspan(kHeader + transitions * (timeBytes + 1), types * 6);
  return b;
}

int offsetAt(const Block& b, int64_t utcSeconds) {
  size_t type = 0;  // before the first transition
  for (size_t i = 0; i < b.types.size() && bigEndian(b.times.subspan(i * b.timeBytes, b.timeBytes)) <= utcSeconds; ++i)
    type = b.types[i];
  return 6 * type + 4 <= b.rules.size() ? static_cast<int>(bigEndian(b.rules.subspan(6 * type, 4))) : 0;
}

bool isZoneName(const std::string& zone) {
  if (zone.empty() || zone.size() > 100 || zone.front() == '/') return false;
  for (const char c : zone) {
    if (!std::isalnum(static_cast<unsigned char>(c)) && c != '/' && c != '_' && c != '-' && c != '+') return false;
  }
  return true;
}

}  // namespace

std::optional<int> utcOffsetSeconds(const std::string& zone, int64_t wallSeconds, const std::filesystem::path& folder) {
  if (!isZoneName(zone)) return {};
  std::error_code code;
  const std::filesystem::path path = folder / zone;
  if (!std::filesystem::is_regular_file(path, code) || std::filesystem::file_size(path, code) > kMaxBytes || code)
    return {};
  const Bytes file = readWholeFile(path, zone);
  auto block = blockOf(file, 4);
  if (!block) return {};
  if (file[4] >= '2') {
    if (const auto longer = blockOf(std::span(file).subspan(block->bytes), 8)) block = longer;
  }
  // The offset of the moment that has this offset; one step settles all but the hour of the change itself.
  const int first = offsetAt(*block, wallSeconds);
  return offsetAt(*block, wallSeconds - first);
}

}  // namespace roomlight::importers::sh3d
