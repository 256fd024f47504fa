#include "base/words.h"

#include <algorithm>
#include <array>
#include <cstdint>

namespace roomlight {
namespace {

// Optimal string alignment.
size_t editsBetween(const std::string& a, const std::string& b) {
  std::vector<std::vector<size_t>> d(a.size() + 1, std::vector<size_t>(b.size() + 1));
  for (size_t i = 0; i <= a.size(); ++i) d[i][0] = i;
  for (size_t k = 0; k <= b.size(); ++k) d[0][k] = k;
  for (size_t i = 1; i <= a.size(); ++i) {
    for (size_t k = 1; k <= b.size(); ++k) {
      d[i][k] = std::min({d[i - 1][k] + 1, d[i][k - 1] + 1, d[i - 1][k - 1] + (a[i - 1] == b[k - 1] ? 0 : 1)});
      if (i > 1 && k > 1 && a[i - 1] == b[k - 2] && a[i - 2] == b[k - 1])
        d[i][k] = std::min(d[i][k], d[i - 2][k - 2] + 1);
    }
  }
  return d[a.size()][b.size()];
}

}  // namespace

std::string nearestWord(const std::string& word, const std::vector<std::string>& candidates) {
  const auto letters = static_cast<size_t>(std::count_if(word.begin(), word.end(), [](char c) { return c != '-'; }));
  std::string nearest;
  size_t fewest = letters / 3 + 1;
  for (const std::string& candidate : candidates) {
    const size_t edits = editsBetween(word, candidate);
    if (edits < fewest) fewest = edits, nearest = candidate;
  }
  return nearest;
}

namespace {

// Capital letters from `first` to `last`, every `step`th, whose small ones are `by` farther.
struct Run {
  char32_t first, last;
  int32_t step, by;
};

constexpr std::array kRuns = {
    Run{'A', 'Z', 1, 32},      Run{0xc0, 0xd6, 1, 32},        Run{0xd8, 0xde, 1, 32},   Run{0x100, 0x12e, 2, 1},
    Run{0x132, 0x136, 2, 1},   Run{0x139, 0x147, 2, 1},       Run{0x14a, 0x176, 2, 1},  Run{0x178, 0x178, 1, -121},
    Run{0x179, 0x17d, 2, 1},   Run{0x218, 0x21a, 2, 1},       Run{0x386, 0x386, 1, 38}, Run{0x388, 0x38a, 1, 37},
    Run{0x38c, 0x38c, 1, 64},  Run{0x38e, 0x38f, 1, 63},      Run{0x391, 0x3a1, 1, 32}, Run{0x3a3, 0x3ab, 1, 32},
    Run{0x3c2, 0x3c2, 1, 1},   Run{0x400, 0x40f, 1, 80},      Run{0x410, 0x42f, 1, 32}, Run{0x490, 0x490, 1, 1},
    Run{0x1e80, 0x1e84, 2, 1}, Run{0x1e9e, 0x1e9e, 1, -7615},
};

char32_t folded(char32_t c) {
  for (const Run& run : kRuns) {
    if (c >= run.first && c <= run.last && (c - run.first) % static_cast<char32_t>(run.step) == 0)
      return static_cast<char32_t>(static_cast<int32_t>(c) + run.by);
  }
  return c;
}

// Length of the sequence that begins with this byte; 0: none does.
size_t lengthOf(unsigned char first) {
  return first < 0x80                    ? 1
         : first >= 0xc2 && first < 0xe0 ? 2
         : first >= 0xe0 && first < 0xf0 ? 3
         : first >= 0xf0 && first < 0xf5 ? 4
                                         : 0;
}

}  // namespace

std::u32string foldedCase(std::string_view text) {
  std::u32string out;
  for (size_t i = 0; i < text.size();) {
    const auto first = static_cast<unsigned char>(text[i]);
    const size_t length = lengthOf(first);
    char32_t point = length > 1 ? first & (0x7fu >> length) : first;
    bool sound = length > 0 && i + length <= text.size();
    for (size_t k = 1; sound && k < length; ++k) {
      const auto next = static_cast<unsigned char>(text[i + k]);
      sound = (next & 0xc0u) == 0x80;
      point = point << 6 | (next & 0x3fu);
    }
    out += sound ? folded(point) : char32_t{0xdc00} + first;
    i += sound ? length : 1;
  }
  return out;
}

}  // namespace roomlight
