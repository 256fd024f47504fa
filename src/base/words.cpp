#include "base/words.h"

#include <algorithm>

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

}  // namespace roomlight
