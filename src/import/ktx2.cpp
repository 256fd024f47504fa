// KTX 2.0: a 12-byte identifier, nine words (VkFormat, size of a type, width, height, depth, layers, faces, levels,
// supercompression), where descriptor, key/value data and global data lie, then offset, length and unpacked length of
// each level, the largest first. The descriptor's colour model says what a file of VkFormat 0 holds: 163 ETC1S, 166
// UASTC. All numbers little-endian.
#include "import/ktx2.h"

#include <fmt/format.h>
#include <zstd.h>

#include <algorithm>
#include <cstring>
#include <memory>

#include "import/failure.h"

namespace roomlight::importers {
namespace {

using ByteView = std::span<const uint8_t>;

constexpr uint8_t kIdentifier[12] = {0xab, 'K', 'T', 'X', ' ', '2', '0', 0xbb, '\r', '\n', 0x1a, '\n'};
constexpr size_t kHeaderBytes = 80, kLevelBytes = 24;
constexpr uint32_t kNoSupercompression = 0, kBasisLz = 1, kZstandard = 2;
constexpr uint8_t kModelEtc1s = 163, kModelUastc = 166;

template <class T>
T number(ByteView bytes, size_t at) {
  if (at > bytes.size() || bytes.size() - at < sizeof(T)) fail("", "the KTX2 picture is cut short");
  T v;
  std::memcpy(&v, bytes.data() + at, sizeof v);
  return v;
}

ByteView part(ByteView bytes, uint64_t offset, uint64_t length) {
  if (offset > bytes.size() || length > bytes.size() - offset) fail("", "the KTX2 picture is cut short");
  return bytes.subspan(offset, length);
}

struct PlainFormat {
  uint32_t vkFormat;
  int channels;
  bool blueFirst;
};

constexpr PlainFormat kPlain[] = {{9, 1, false},  {15, 1, false}, {16, 2, false}, {22, 2, false},
                                  {23, 3, false}, {29, 3, false}, {30, 3, true},  {36, 3, true},
                                  {37, 4, false}, {43, 4, false}, {44, 4, true},  {50, 4, true}};

const PlainFormat* plainFormat(uint32_t vkFormat) {
  const auto found =
      std::find_if(std::begin(kPlain), std::end(kPlain), [&](const PlainFormat& f) { return f.vkFormat == vkFormat; });
  return found == std::end(kPlain) ? nullptr : found;
}

uint8_t colourModel(ByteView bytes) {
  return number<uint8_t>(part(bytes, number<uint32_t>(bytes, 48), number<uint32_t>(bytes, 52)), 12);
}

bool decodable(ByteView bytes) {
  const uint32_t format = number<uint32_t>(bytes, 12), scheme = number<uint32_t>(bytes, 44);
  if (format != 0) return plainFormat(format) && (scheme == kNoSupercompression || scheme == kZstandard);
  const uint8_t model = colourModel(bytes);
  return (model == kModelUastc && (scheme == kNoSupercompression || scheme == kZstandard)) ||
         (model == kModelEtc1s && scheme == kBasisLz);
}

uint64_t imageCount(ByteView bytes, uint32_t levels) {
  const uint64_t depth = number<uint32_t>(bytes, 28);
  uint64_t slices = 0;
  for (uint32_t level = 0; level < levels; ++level) slices += std::max<uint64_t>(depth >> level, 1);
  return slices * std::max<uint64_t>(number<uint32_t>(bytes, 32), 1) *
         std::max<uint64_t>(number<uint32_t>(bytes, 36), 1);
}

// The first `size` bytes that the frame unpacks to.
std::vector<uint8_t> unpackZstandard(ByteView packed, size_t size) {
  std::vector<uint8_t> out(size);
  const std::unique_ptr<ZSTD_DStream, decltype([](ZSTD_DStream* s) { ZSTD_freeDStream(s); })> stream(
      ZSTD_createDStream());
  ZSTD_inBuffer in{packed.data(), packed.size(), 0};
  ZSTD_outBuffer to{out.data(), out.size(), 0};
  while (to.pos < to.size) {
    const size_t before = to.pos + in.pos, status = ZSTD_decompressStream(stream.get(), &to, &in);
    if (ZSTD_isError(status))
      fail("", fmt::format("the KTX2 picture's Zstandard data are damaged: {}", ZSTD_getErrorName(status)));
    if (to.pos < to.size && to.pos + in.pos == before) fail("", "the KTX2 picture's Zstandard data are cut short");
  }
  return out;
}

void spreadTexels(ByteView texels, const Ktx2Header& h, std::span<uint8_t> rgba) {
  const size_t channels = static_cast<size_t>(h.channels);
  for (size_t i = 0; i < rgba.size() / 4; ++i) {
    const uint8_t* in = &texels[i * channels];
    uint8_t* out = &rgba[i * 4];
    out[0] = in[0], out[1] = channels > 1 ? in[1] : 0, out[2] = channels > 2 ? in[2] : 0,
    out[3] = channels > 3 ? in[3] : 255;
    if (h.blueFirst) std::swap(out[0], out[2]);
  }
}

size_t blocksOf(int side) { return (static_cast<size_t>(side) + 3) / 4; }

}  // namespace

bool isKtx2(ByteView bytes) {
  return bytes.size() >= sizeof kIdentifier && std::memcmp(bytes.data(), kIdentifier, sizeof kIdentifier) == 0;
}

std::optional<std::string> undecodableKtx2(ByteView bytes) {
  try {
    if (decodable(bytes)) return std::nullopt;
    const uint32_t format = number<uint32_t>(bytes, 12), scheme = number<uint32_t>(bytes, 44);
    if (format != 0 && plainFormat(format) == nullptr) return fmt::format("KTX2 (format {})", format);
    return fmt::format("KTX2 (supercompression {})", scheme);
  } catch (const Failure&) {
    return std::nullopt;
  }
}

Ktx2Header readKtx2Header(ByteView bytes) {
  Ktx2Header h;
  if (!decodable(bytes)) fail("", "the KTX2 picture is of a kind that cannot be decoded");
  const uint32_t format = number<uint32_t>(bytes, 12), width = number<uint32_t>(bytes, 20),
                 height = number<uint32_t>(bytes, 24);
  if (width > INT32_MAX || height > INT32_MAX)
    fail("", fmt::format("the picture claims {} x {} pixels", width, height));
  h.width = static_cast<int>(width), h.height = std::max(1, static_cast<int>(height));
  h.zstandard = number<uint32_t>(bytes, 44) == kZstandard;
  if (const PlainFormat* plain = plainFormat(format)) {
    h.channels = plain->channels, h.blueFirst = plain->blueFirst;
  } else {
    h.coding = colourModel(bytes) == kModelUastc ? Ktx2Coding::Uastc : Ktx2Coding::BasisLz;
  }
  const uint32_t levels = std::max<uint32_t>(number<uint32_t>(bytes, 40), 1);
  if (levels > 32) fail("", "the KTX2 picture's header is damaged");
  h.images = imageCount(bytes, levels);
  part(bytes, kHeaderBytes, kLevelBytes * levels);
  h.level = part(bytes, number<uint64_t>(bytes, kHeaderBytes), number<uint64_t>(bytes, kHeaderBytes + 8));
  if (h.coding == Ktx2Coding::BasisLz) h.global = part(bytes, number<uint64_t>(bytes, 64), number<uint64_t>(bytes, 72));
  return h;
}

std::vector<uint8_t> decodeKtx2(const Ktx2Header& h) {
  const size_t pixels = static_cast<size_t>(h.width) * static_cast<size_t>(h.height);
  std::vector<uint8_t> rgba(4 * pixels);
  if (h.coding == Ktx2Coding::BasisLz) {
    decodeBasisLz(h, rgba);
    return rgba;
  }
  const size_t size = h.coding == Ktx2Coding::Uastc ? 16 * blocksOf(h.width) * blocksOf(h.height)
                                                    : pixels * static_cast<size_t>(h.channels);
  std::vector<uint8_t> unpacked;
  ByteView data = h.level;
  if (h.zstandard) data = unpacked = unpackZstandard(h.level, size);
  if (data.size() < size) fail("", fmt::format("the KTX2 picture has {} bytes of {}", data.size(), size));
  if (h.coding == Ktx2Coding::Uastc) {
    decodeUastc(data.first(size), h.width, h.height, rgba);
  } else {
    spreadTexels(data, h, rgba);
  }
  return rgba;
}

}  // namespace roomlight::importers
