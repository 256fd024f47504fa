#include "mix/layer_info.h"

#include <fmt/core.h>

#include <algorithm>
#include <functional>

#include "base/words.h"

namespace roomlight {
namespace {

// * stands for any text, ? for one letter. Each * is tried at its shortest first and lengthened where the rest does not
// fit.
bool fits(std::u32string_view pattern, std::u32string_view text) {
  size_t p = 0, t = 0, star = std::u32string_view::npos, resume = 0;
  while (t < text.size()) {
    if (p < pattern.size() && pattern[p] == '*') {
      star = p++;
      resume = t;
    } else if (p < pattern.size() && (pattern[p] == '?' || pattern[p] == text[t])) {
      ++p, ++t;
    } else if (star != std::u32string_view::npos) {
      p = star + 1;
      t = ++resume;
    } else {
      return false;
    }
  }
  return std::all_of(pattern.begin() + static_cast<std::ptrdiff_t>(p), pattern.end(),
                     [](char32_t c) { return c == '*'; });
}

std::string listed(const std::vector<LayerInfo>& layers, const std::vector<size_t>& which) {
  std::string names;
  for (const size_t i : which) names += fmt::format("{}'{}'", names.empty() ? "" : ", ", layers[i].name);
  return names;
}

}  // namespace

Result<std::vector<size_t>> findLamps(const std::vector<LayerInfo>& layers, std::string_view wanted) {
  const auto where = [&](const std::function<bool(const LayerInfo&)>& fit) {
    std::vector<size_t> found;
    for (size_t i = 0; i < layers.size(); ++i) {
      if (isLamp(layers[i]) && fit(layers[i])) found.push_back(i);
    }
    return found;
  };
  std::vector<size_t> found = where([&](const LayerInfo& l) { return l.name == wanted || l.channel == wanted; });
  if (!found.empty()) return found;
  const std::u32string small = foldedCase(wanted);
  found = where([&](const LayerInfo& l) { return foldedCase(l.name) == small; });
  const bool oneName =
      std::all_of(found.begin(), found.end(), [&](size_t i) { return layers[i].name == layers[found[0]].name; });
  if (!oneName)
    return Error{
        fmt::format("'{}' may be {}; write capital and small letters as there", wanted, listed(layers, found))};
  if (found.empty() && wanted.find_first_of("*?") != std::string_view::npos)
    found = where([&](const LayerInfo& l) { return fits(small, foldedCase(l.name)); });
  if (!found.empty()) return found;
  if (!wanted.empty()) found = where([&](const LayerInfo& l) { return foldedCase(l.name).starts_with(small); });
  if (found.size() == 1) return found;
  if (found.size() > 1)
    return Error{fmt::format("'{}' may be {}; write more of the name, or '{}*' for all of them", wanted,
                             listed(layers, found), wanted)};
  const std::vector<size_t> all = where([](const LayerInfo&) { return true; });
  if (all.empty()) return Error{fmt::format("no lamp '{}': there are none, only sun and sky", wanted)};
  return Error{fmt::format("no lamp '{}'; there are {}", wanted, listed(layers, all))};
}

}  // namespace roomlight
