// UASTC LDR 4x4 (the Basis Universal project's specification, in the public domain): a block is 128 bits, the lowest
// bit of the first byte first: the mode's prefix code, hints for other codings (skipped), the pattern of subsets or the
// second plane's channel, the trits or quints of all endpoints, their bits, the weights. Endpoints and weights
// unquantise and blend as those of ASTC do.
#include <algorithm>
#include <array>

#include "import/bit_reader.h"
#include "import/failure.h"
#include "import/ktx2.h"

namespace roomlight::importers {
namespace {

constexpr int kTexels = 16;

enum class Digits : uint8_t {
  None,
  Trits,
  Quints,
};

struct Mode {
  int codeBits, hintBits, weightBits, endpointBits;
  Digits digits;
  int subsets, planes, channels;
};

constexpr Digits kN = Digits::None, kT = Digits::Trits, kQ = Digits::Quints;
constexpr int kSolid = 8, kModes = 19, kSecondPatterns = 7, kAlphaPlane = 17;

constexpr Mode kModeTable[kModes] = {
    {4, 15, 4, 6, kT, 1, 1, 3}, {6, 15, 2, 8, kN, 1, 1, 3}, {5, 15, 3, 4, kN, 2, 1, 3}, {5, 15, 2, 2, kT, 3, 1, 3},
    {5, 15, 2, 3, kQ, 2, 1, 3}, {5, 15, 3, 8, kN, 1, 1, 3}, {5, 15, 2, 5, kQ, 1, 2, 3}, {5, 15, 2, 3, kQ, 2, 1, 3},
    {5, 0, 0, 8, kN, 1, 1, 4},  {5, 23, 2, 4, kN, 2, 1, 4}, {3, 17, 4, 4, kT, 1, 1, 4}, {2, 17, 2, 4, kT, 1, 2, 4},
    {3, 17, 3, 6, kT, 1, 1, 4}, {5, 23, 1, 8, kN, 1, 2, 4}, {5, 23, 2, 8, kN, 1, 1, 4}, {7, 23, 4, 8, kN, 1, 1, 2},
    {6, 23, 2, 8, kN, 2, 1, 2}, {6, 23, 2, 8, kN, 1, 2, 2}, {4, 15, 5, 5, kN, 1, 1, 3}};

// The codes of the modes, lowest bit first; code 0x45 of 7 bits is no mode.
constexpr uint8_t kCodes[kModes] = {0x01, 0x35, 0x1d, 0x03, 0x13, 0x0b, 0x1b, 0x07, 0x17, 0x0f,
                                    0x02, 0x00, 0x06, 0x1f, 0x0d, 0x05, 0x15, 0x25, 0x09};

// Which subset each texel is of: two bits a texel, the first texel's lowest.
constexpr uint32_t kPatterns2[] = {0x50505050, 0x40404040, 0x01010101, 0x54505040, 0x05151555, 0x55545450,
                                   0x00010515, 0x01051555, 0x50400000, 0x00000105, 0x55544000, 0x01155555,
                                   0x00000115, 0x00005555, 0x55555500, 0x00555555, 0x55551501, 0x40545555,
                                   0x00405054, 0x00004050, 0x15050100, 0x50545555, 0x15050501, 0x00404050,
                                   0x50545455, 0x14141414, 0x55000055, 0x11111111, 0x00550055, 0x05145041};
constexpr uint32_t kPatternsOfMode7[] = {0x00005500, 0x10101010, 0x00010505, 0x50504000, 0x55005555,
                                         0x04040404, 0x55555040, 0x50505054, 0x05500005, 0x00005454,
                                         0x15150000, 0x05000005, 0x00005054, 0x55554000, 0x14555555,
                                         0x01050505, 0x01015555, 0x01051450, 0x00005455};
constexpr uint32_t kPatterns3[] = {0xa5a50000, 0xaa005555, 0xaa000055, 0x0000aa55, 0x25252525, 0x94949494,
                                   0x58585858, 0x56560202, 0x92929292, 0x55aa0055, 0xa05050a0};

[[noreturn]] void damaged() { fail("", "the KTX2 picture's UASTC data are damaged"); }

int modeOf(uint8_t firstByte) {
  for (int mode = 0; mode < kModes; ++mode) {
    if ((firstByte & ((1 << kModeTable[mode].codeBits) - 1)) == kCodes[mode]) return mode;
  }
  damaged();
}

template <size_t N>
uint32_t patternOf(const uint32_t (&patterns)[N], uint32_t index) {
  if (index >= N) damaged();
  return patterns[index];
}

int subsetOf(uint32_t pattern, int texel) { return static_cast<int>((pattern >> (2 * texel)) & 3); }

// Endpoints as 8-bit numbers, from ASTC's table of integer sequences (Khronos Data Format 1.3, section 23.13).
uint8_t unquantised(uint32_t bits, int count, Digits digits, uint32_t digit) {
  if (digits == Digits::None) {
    uint32_t v = bits << (8 - count);
    for (int filled = count; filled < 8; filled += count) v |= v >> filled;
    return static_cast<uint8_t>(v);
  }
  const uint32_t x = bits >> 1, a = bits & 1 ? 0x1ff : 0;
  uint32_t b = 0, c = 0;
  if (digits == Digits::Trits) {
    if (count == 2) b = x * 0x116, c = 93;
    if (count == 4) b = (x << 6) | x, c = 22;
    if (count == 6) b = (x << 4) | (x >> 4), c = 5;
  } else {
    if (count == 3) b = (x << 7) | (x << 1) | (x >> 1), c = 26;
    if (count == 5) b = (x << 5) | (x >> 3), c = 6;
  }
  const uint32_t t = (digit * c + b) ^ a;
  return static_cast<uint8_t>((a & 0x80) | (t >> 2));
}

constexpr int kMostEndpoints = 18;

void readEndpoints(BitReader& bits, const Mode& mode, std::array<uint8_t, kMostEndpoints>& endpoints) {
  const int count = 2 * mode.channels * mode.subsets;
  std::array<uint32_t, kMostEndpoints> digits{};
  const int base = mode.digits == Digits::Trits ? 3 : 5, group = mode.digits == Digits::Trits ? 5 : 3;
  for (int i = 0; mode.digits != Digits::None && i < count; i += group) {
    static constexpr int kTritBits[] = {0, 2, 4, 5, 7, 8}, kQuintBits[] = {0, 3, 5, 7};
    const int here = std::min(group, count - i);
    uint32_t packed = bits.bits(base == 3 ? kTritBits[here] : kQuintBits[here]);
    for (int k = 0; k < here; ++k, packed /= static_cast<uint32_t>(base))
      digits[static_cast<size_t>(i + k)] = packed % static_cast<uint32_t>(base);
  }
  for (size_t i = 0; i < static_cast<size_t>(count); ++i)
    endpoints[i] = unquantised(bits.bits(mode.endpointBits), mode.endpointBits, mode.digits, digits[i]);
}

// 0 to 64, as ASTC has them.
uint32_t unquantisedWeight(uint32_t v, int bits) {
  uint32_t w = v << (6 - bits);
  for (int filled = bits; filled < 6; filled += bits) w |= w >> filled;
  return w > 32 ? w + 1 : w;
}

uint8_t blend(uint8_t low, uint8_t high, uint32_t weight) {
  return static_cast<uint8_t>((low * 257u * (64 - weight) + high * 257u * weight + 32) >> 14);
}

using Block = std::array<uint8_t, 4 * kTexels>;

void decodeBlock(std::span<const uint8_t> bytes, Block& out) {
  const int index = modeOf(bytes[0]);
  const Mode& mode = kModeTable[index];
  BitReader bits(bytes, static_cast<size_t>(mode.codeBits + mode.hintBits));
  if (index == kSolid) {
    for (size_t c = 0; c < 4; ++c) out[c] = static_cast<uint8_t>(bits.bits(8));
    for (size_t i = 4; i < out.size(); ++i) out[i] = out[i - 4];
    return;
  }
  uint32_t pattern = 0, channelOfSecondPlane = 3;
  if (mode.subsets == 3) pattern = patternOf(kPatterns3, bits.bits(4));
  if (mode.subsets == 2)
    pattern =
        index == kSecondPatterns ? patternOf(kPatternsOfMode7, bits.bits(5)) : patternOf(kPatterns2, bits.bits(5));
  if (mode.planes == 2 && index != kAlphaPlane) channelOfSecondPlane = bits.bits(2);
  std::array<uint8_t, kMostEndpoints> endpoints{};
  readEndpoints(bits, mode, endpoints);

  bool met[3] = {};  // a subset's first texel lacks its weight's highest bit: it is 0
  for (int texel = 0; texel < kTexels; ++texel) {
    const int subset = subsetOf(pattern, texel), weightBits = mode.weightBits - (met[subset] ? 0 : 1);
    met[subset] = true;
    uint32_t weights[2];
    weights[0] = weights[1] = unquantisedWeight(bits.bits(weightBits), mode.weightBits);
    if (mode.planes == 2) weights[1] = unquantisedWeight(bits.bits(weightBits), mode.weightBits);
    const uint8_t* ends = &endpoints[static_cast<size_t>(2 * mode.channels * subset)];
    for (uint32_t c = 0; c < 4; ++c) {
      // Luminance and alpha: red, green and blue are the first channel.
      const uint32_t from = mode.channels == 2 ? c / 3 : c;
      const bool absent = from >= static_cast<uint32_t>(mode.channels);
      out[static_cast<size_t>(texel) * 4 + c] =
          absent ? 255
                 : blend(ends[2 * from], ends[2 * from + 1], weights[mode.planes == 2 && c == channelOfSecondPlane]);
    }
  }
}

}  // namespace

void decodeUastc(std::span<const uint8_t> blocks, int width, int height, std::span<uint8_t> rgba) {
  const size_t w = static_cast<size_t>(width), h = static_cast<size_t>(height), across = (w + 3) / 4,
               down = (h + 3) / 4;
  parallelOrFail(down, [&](size_t row) {
    Block block;
    for (size_t column = 0; column < across; ++column) {
      decodeBlock(blocks.subspan(16 * (row * across + column), 16), block);
      for (size_t y = 0; y < 4 && 4 * row + y < h; ++y) {
        for (size_t x = 0; x < 4 && 4 * column + x < w; ++x) {
          for (size_t c = 0; c < 4; ++c)
            rgba[4 * ((4 * row + y) * w + 4 * column + x) + c] = block[4 * (4 * y + x) + c];
        }
      }
    }
  });
}

}  // namespace roomlight::importers
