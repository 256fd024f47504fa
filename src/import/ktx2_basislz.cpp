// ETC1S with BasisLZ (KTX 2.0, appendices C and D). The global data hold two palettes, of endpoints (a 5-bit colour and
// a table of modifiers) and of selectors (which of four modifiers each of 4 x 4 texels has), and the Huffman tables of
// the slices. A slice names an endpoint and a selector for each block, row by row; alpha is a second slice of grey
// blocks.
#include <algorithm>
#include <array>
#include <cstring>
#include <span>
#include <vector>

#include "import/bit_reader.h"
#include "import/ktx2.h"

namespace roomlight::importers {
namespace {

// Canonical Huffman codes as Deflate has them (RFC 1951, section 3.2.2), the first bit of a code its highest.
constexpr size_t kLongestHuffmanCode = 16;

class HuffmanTable {
 public:
  HuffmanTable() = default;
  // The length of each symbol's code, 0: it has none. Throws Failure where the lengths are no prefix code.
  explicit HuffmanTable(std::span<const uint8_t> lengths);

  // The next symbol. Throws Failure where the bits are no code, or end.
  uint32_t next(BitReader& bits) const;

 private:
  std::array<uint32_t, kLongestHuffmanCode + 1> countOfLength_{};
  std::vector<uint16_t> symbols_;  // by length, then by number
};

HuffmanTable::HuffmanTable(std::span<const uint8_t> lengths) {
  for (const uint8_t length : lengths) {
    if (length > kLongestHuffmanCode) fail("", "the compressed data are damaged: a code is too long");
    ++countOfLength_[length];
  }
  countOfLength_[0] = 0;
  std::array<uint32_t, kLongestHuffmanCode + 2> start{};
  int64_t free = 1;  // codes of this length that are not taken
  for (size_t length = 1; length <= kLongestHuffmanCode; ++length) {
    free = 2 * free - countOfLength_[length];
    if (free < 0) fail("", "the compressed data are damaged: more codes than there can be");
    start[length + 1] = start[length] + countOfLength_[length];
  }
  symbols_.resize(start[kLongestHuffmanCode + 1]);
  for (size_t symbol = 0; symbol < lengths.size(); ++symbol) {
    if (lengths[symbol] > 0) symbols_[start[lengths[symbol]]++] = static_cast<uint16_t>(symbol);
  }
}

uint32_t HuffmanTable::next(BitReader& bits) const {
  uint32_t code = 0, first = 0, index = 0;  // first: the first code of this length; index: of its symbol
  for (size_t length = 1; length <= kLongestHuffmanCode; ++length) {
    code |= bits.bit();
    const uint32_t count = countOfLength_[length];
    if (code - first < count) return symbols_[index + code - first];
    index += count;
    first = (first + count) << 1;
    code <<= 1;
  }
  fail("", "the compressed data are damaged: no such code");
}

using ByteView = std::span<const uint8_t>;

[[noreturn]] void damaged(const char* what) {
  fail("", std::string("the KTX2 picture's BasisLZ data are damaged: ") + what);
}

ByteView take(ByteView& from, size_t length) {
  if (length > from.size()) damaged("they are cut short");
  const ByteView head = from.first(length);
  from = from.subspan(length);
  return head;
}

template <class T>
T number(ByteView& from) {
  T v;
  std::memcpy(&v, take(from, sizeof v).data(), sizeof v);
  return v;
}

// The lengths of a table's codes are Huffman coded themselves, with symbols for runs.
HuffmanTable readTable(BitReader& bits) {
  constexpr std::array<uint8_t, 21> kOrder = {17, 18, 19, 20, 0, 8, 7, 9, 6, 10, 5, 11, 4, 12, 3, 13, 2, 14, 1, 15, 16};
  const size_t symbols = bits.bits(14);
  if (symbols == 0) return {};
  const size_t codes = bits.bits(5);
  if (codes < 1 || codes > kOrder.size()) damaged("a table has no codes");
  std::array<uint8_t, kOrder.size()> ofLengths{};
  for (size_t i = 0; i < codes; ++i) ofLengths[kOrder[i]] = static_cast<uint8_t>(bits.bits(3));
  const HuffmanTable table(ofLengths);
  std::vector<uint8_t> lengths;
  while (lengths.size() < symbols) {
    const uint32_t symbol = table.next(bits);
    if (symbol <= kLongestHuffmanCode) {
      lengths.push_back(static_cast<uint8_t>(symbol));
      continue;
    }
    const bool repeats = symbol >= 19;
    if (repeats && (lengths.empty() || lengths.back() == 0)) damaged("nothing to repeat");
    const uint32_t run = symbol == 17   ? 3 + bits.bits(3)
                         : symbol == 18 ? 11 + bits.bits(7)
                         : symbol == 19 ? 3 + bits.bits(2)
                                        : 7 + bits.bits(7);
    if (run > symbols - lengths.size()) damaged("a run is too long");
    lengths.insert(lengths.end(), run, repeats ? lengths.back() : uint8_t{0});
  }
  return HuffmanTable(lengths);
}

struct Endpoint {
  std::array<uint8_t, 3> colour{};  // 5 bits each
  uint8_t modifiers = 0;
};

using Selector = std::array<uint8_t, 4>;  // rows, two bits a texel, the left one's lowest

struct Palettes {
  std::vector<Endpoint> endpoints;
  std::vector<Selector> selectors;
  HuffmanTable prediction, endpointDelta, selector, runLength;
  size_t history = 0;
};

std::vector<Endpoint> readEndpoints(ByteView data, size_t count) {
  BitReader bits(data);
  HuffmanTable ofColour[3];
  for (HuffmanTable& table : ofColour) table = readTable(bits);
  const HuffmanTable ofModifiers = readTable(bits);
  const bool grey = bits.bit() != 0;
  std::vector<Endpoint> out;
  Endpoint now{{16, 16, 16}, 0};
  for (size_t i = 0; i < count; ++i) {
    now.modifiers = static_cast<uint8_t>((now.modifiers + ofModifiers.next(bits)) & 7);
    for (size_t c = 0; c < (grey ? 1u : 3u); ++c) {
      uint8_t& v = now.colour[c];
      v = static_cast<uint8_t>((v + ofColour[v < 10 ? 0 : v < 22 ? 1 : 2].next(bits)) & 31);
    }
    if (grey) now.colour[1] = now.colour[2] = now.colour[0];
    out.push_back(now);
  }
  return out;
}

std::vector<Selector> readSelectors(ByteView data, size_t count) {
  BitReader bits(data);
  if (bits.bits(2) != 0) damaged("selectors of a kind that is not known");
  const bool plain = bits.bit() != 0;
  HuffmanTable delta;
  if (!plain) delta = readTable(bits);
  std::vector<Selector> out;
  Selector now{};
  for (size_t i = 0; i < count; ++i) {
    for (uint8_t& row : now)
      row = plain || i == 0 ? static_cast<uint8_t>(bits.bits(8)) : static_cast<uint8_t>(row ^ delta.next(bits));
    out.push_back(now);
  }
  return out;
}

// A short list of selectors used lately, the most used in front, roughly.
class History {
 public:
  explicit History(size_t size) : values_(size), next_(size / 2) {}

  size_t size() const { return values_.size(); }
  void add(uint32_t value) {
    if (values_.empty()) return;
    values_[next_++] = value;
    if (next_ == values_.size()) next_ = values_.size() / 2;
  }
  uint32_t use(size_t i) {
    if (i >= values_.size()) damaged("a selector is not in the history");
    const uint32_t value = values_[i];
    std::swap(values_[i], values_[i / 2]);
    return value;
  }

 private:
  std::vector<uint32_t> values_;
  size_t next_;
};

// Numbers in groups of `width` bits, each with one bit more that says whether another one follows.
uint32_t readGroups(BitReader& bits, int width) {
  uint64_t v = 0;
  for (int at = 0; at < 32; at += width) {
    v |= uint64_t{bits.bits(width)} << at;
    if (bits.bit() == 0) break;
  }
  return static_cast<uint32_t>(v);
}

// One slice on its way through the blocks.
class Slice {
 public:
  Slice(const Palettes& palettes, ByteView data, size_t across)
      : p_(palettes),
        bits_(data),
        history_(palettes.history),
        above_(across),
        here_(across),
        predictions_((across + 1) / 2) {}

  // Calls block(x, y, endpoint, selector) for every block.
  template <class OnBlock>
  void decode(size_t down, OnBlock&& block) {
    for (size_t y = 0; y < down; ++y) {
      for (size_t x = 0; x < here_.size(); ++x) {
        if (x % 2 == 0) pending_ = y % 2 == 0 ? firstOfPair(x) : predictions_[x / 2];
        const uint32_t endpoint = nextEndpoint(x, y), selector = nextSelector();
        if (endpoint >= p_.endpoints.size() || selector >= p_.selectors.size())
          damaged("a block names nothing of its palette");
        here_[x] = last_ = endpoint;
        block(x, y, p_.endpoints[endpoint], p_.selectors[selector]);
      }
      std::swap(here_, above_);
    }
  }

 private:
  static constexpr uint32_t kRepeat = 256;

  // How the endpoints of 2 x 2 blocks are told, two bits each.
  uint32_t firstOfPair(size_t x) {
    if (repeats_ > 0) {
      --repeats_;
    } else if (const uint32_t symbol = p_.prediction.next(bits_); symbol == kRepeat) {
      repeats_ = uint64_t{readGroups(bits_, 4)} + 2;
    } else {
      prediction_ = symbol;
    }
    predictions_[x / 2] = static_cast<uint8_t>(prediction_ >> 4);
    return prediction_;
  }

  uint32_t nextEndpoint(size_t x, size_t y) {
    const uint32_t how = pending_ & 3;
    pending_ >>= 2;
    if ((how == 0 || how == 2) && x == 0) damaged("there is no block to the left");
    if ((how == 1 || how == 2) && y == 0) damaged("there is no block above");
    if (how == 0) return last_;
    if (how == 1) return above_[x];
    if (how == 2) return above_[x - 1];
    const uint32_t index = last_ + p_.endpointDelta.next(bits_), count = static_cast<uint32_t>(p_.endpoints.size());
    return index >= count ? index - count : index;
  }

  uint32_t nextSelector() {
    const uint32_t count = static_cast<uint32_t>(p_.selectors.size());
    uint32_t symbol = count;
    if (run_ > 0) {
      --run_;
    } else {
      symbol = p_.selector.next(bits_);
      if (symbol == count + history_.size()) {
        const uint32_t length = p_.runLength.next(bits_);
        run_ = uint64_t{length == 63 ? readGroups(bits_, 7) : length} + 2;
        symbol = count;
      }
    }
    if (symbol >= count) return history_.use(symbol - count);
    history_.add(symbol);
    return symbol;
  }

  const Palettes& p_;
  BitReader bits_;
  History history_;
  std::vector<uint32_t> above_, here_;  // endpoints of two rows
  std::vector<uint8_t> predictions_;  // of the odd row
  uint32_t pending_ = 0, prediction_ = 0, last_ = 0;
  uint64_t repeats_ = 0, run_ = 0;
};

uint8_t texel(const Endpoint& endpoint, size_t channel, uint32_t selector) {
  static constexpr int kModifiers[8][2] = {{2, 8},   {5, 17},  {9, 29},   {13, 42},
                                           {18, 60}, {24, 80}, {33, 106}, {47, 183}};
  const int base = (endpoint.colour[channel] << 3) | (endpoint.colour[channel] >> 2),
            *m = kModifiers[endpoint.modifiers];
  const int offset = selector == 0 ? -m[1] : selector == 1 ? -m[0] : selector == 2 ? m[0] : m[1];
  return static_cast<uint8_t>(std::clamp(base + offset, 0, 255));
}

}  // namespace

void decodeBasisLz(const Ktx2Header& h, std::span<uint8_t> rgba) {
  ByteView global = h.global;
  const size_t endpoints = number<uint16_t>(global), selectors = number<uint16_t>(global);
  const uint32_t endpointBytes = number<uint32_t>(global), selectorBytes = number<uint32_t>(global),
                 tableBytes = number<uint32_t>(global);
  number<uint32_t>(global);  // of extensions, which come last
  ByteView images = global;
  if (h.images == 0 || h.images > global.size() / 20) damaged("they are cut short");
  take(global, 20 * h.images);
  const uint32_t flags = number<uint32_t>(images), colourAt = number<uint32_t>(images),
                 colourBytes = number<uint32_t>(images);
  const uint32_t alphaAt = number<uint32_t>(images), alphaBytes = number<uint32_t>(images);
  if (flags & 2) damaged("the first picture is a change to another");

  Palettes palettes;
  palettes.endpoints = readEndpoints(take(global, endpointBytes), endpoints);
  palettes.selectors = readSelectors(take(global, selectorBytes), selectors);
  BitReader tables(take(global, tableBytes));
  for (HuffmanTable* table : {&palettes.prediction, &palettes.endpointDelta, &palettes.selector, &palettes.runLength})
    *table = readTable(tables);
  palettes.history = tables.bits(13);

  const size_t width = static_cast<size_t>(h.width), height = static_cast<size_t>(h.height), across = (width + 3) / 4,
               down = (height + 3) / 4;
  // Alpha is the green of grey blocks.
  const auto decode = [&](uint32_t at, uint32_t bytes, bool isAlpha) {
    ByteView data = h.level;
    take(data, at);
    Slice(palettes, take(data, bytes), across)
        .decode(down, [&](size_t bx, size_t by, const Endpoint& endpoint, const Selector& selector) {
          for (size_t y = 0; y < 4 && 4 * by + y < height; ++y) {
            for (size_t x = 0; x < 4 && 4 * bx + x < width; ++x) {
              uint8_t* out = &rgba[4 * ((4 * by + y) * width + 4 * bx + x)];
              const uint32_t modifier = (selector[y] >> (2 * x)) & 3u;
              if (isAlpha) out[3] = texel(endpoint, 1, modifier);
              for (size_t c = 0; !isAlpha && c < 3; ++c) out[c] = texel(endpoint, c, modifier);
            }
          }
        });
  };
  std::fill(rgba.begin(), rgba.end(), uint8_t{255});
  decode(colourAt, colourBytes, false);
  if (alphaBytes > 0) decode(alphaAt, alphaBytes, true);
}

}  // namespace roomlight::importers
