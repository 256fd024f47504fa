#include "mix/layer_names.h"

#include <fmt/core.h>

#include <algorithm>
#include <cctype>
#include <functional>

namespace roomlight {
namespace {

std::string lower(std::string_view text) {
  std::string out(text);
  std::transform(out.begin(), out.end(), out.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return out;
}

// * stands for any text, ? for one letter. Each * is tried at its shortest first and lengthened where the rest does not fit.
bool fits(std::string_view pattern, std::string_view text) {
  size_t p = 0, t = 0, star = std::string_view::npos, resume = 0;
  while (t < text.size()) {
    if (p < pattern.size() && pattern[p] == '*') {
      star = p++;
      resume = t;
    } else if (p < pattern.size() && (pattern[p] == '?' || pattern[p] == text[t])) {
      ++p, ++t;
    } else if (star != std::string_view::npos) {
      p = star + 1;
      t = ++resume;
    } else {
      return false;
    }
  }
  return std::all_of(pattern.begin() + static_cast<std::ptrdiff_t>(p), pattern.end(), [](char c) { return c == '*'; });
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
  const std::string small = lower(wanted);
  std::vector<size_t> found = where([&](const LayerInfo& l) { return l.name == wanted || l.channel == wanted; });
  if (found.empty()) found = where([&](const LayerInfo& l) { return lower(l.name) == small; });
  if (found.empty() && wanted.find_first_of("*?") != std::string_view::npos) found = where([&](const LayerInfo& l) { return fits(small, lower(l.name)); });
  if (!found.empty()) return found;
  if (!wanted.empty()) found = where([&](const LayerInfo& l) { return lower(l.name).starts_with(small); });
  if (found.size() == 1) return found;
  if (found.size() > 1) return Error{fmt::format("'{}' may be {}; write more of the name, or '{}*' for all of them", wanted, listed(layers, found), wanted)};
  const std::vector<size_t> all = where([](const LayerInfo&) { return true; });
  if (all.empty()) return Error{fmt::format("no lamp '{}': there are none, only sun and sky", wanted)};
  return Error{fmt::format("no lamp '{}'; there are {}", wanted, listed(layers, all))};
}

}  // namespace roomlight
