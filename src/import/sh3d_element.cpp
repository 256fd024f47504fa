#include "import/sh3d_element.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>

#include "import/failure.h"

namespace roomlight::importers::sh3d {
namespace {

// The whole of `text`, or none. Java writes 1.0E-4 and NaN; the latter is no number here.
std::optional<double> parsedNumber(std::string_view text) {
  if (text.starts_with('+')) text.remove_prefix(1);
  double v = 0;
  const auto [end, code] = std::from_chars(text.data(), text.data() + text.size(), v);
  if (code != std::errc() || end != text.data() + text.size() || !std::isfinite(v)) return {};
  return v;
}

}  // namespace

LineNumbers::LineNumbers(std::string_view text) {
  for (size_t i = 0; i < text.size(); ++i) {
    if (text[i] == '\n') starts_.push_back(i + 1);
  }
}

size_t LineNumbers::at(size_t offset) const {
  return 1 + static_cast<size_t>(std::upper_bound(starts_.begin(), starts_.end(), offset) - starts_.begin());
}

std::string Element::place() const {
  std::string name = text("id");
  if (name.empty()) name = text("name");
  const ptrdiff_t offset = node_.offset_debug();
  std::string place = fmt::format("Home.xml: line {}: {}", lines_->at(offset < 0 ? 0 : static_cast<size_t>(offset)),
                                  printable(kind(), 40));
  if (!name.empty()) place += fmt::format(" '{}'", printable(name, 40));
  return place;
}

void Element::failAt(const char* key, std::string_view what) const { fail(place(), fmt::format("{} {}", key, what)); }

bool Element::flag(const char* key, bool absent) const {
  if (!has(key)) return absent;
  const std::string word = text(key);
  if (word != "true" && word != "false") failAt(key, fmt::format("is '{}', neither true nor false", printable(word)));
  return word == "true";
}

std::optional<double> Element::numberIfAny(const char* key, double low, double high) const {
  if (!has(key)) return {};
  const std::string word = text(key);
  const auto v = parsedNumber(word);
  if (!v) failAt(key, fmt::format("is '{}', which is no finite number", printable(word)));
  if (*v < low || *v > high) failAt(key, fmt::format("is {}, outside {:g} to {:g}", printable(word), low, high));
  return v;
}

double Element::number(const char* key, double low, double high, std::optional<double> absent) const {
  const auto v = numberIfAny(key, low, high);
  if (v) return *v;
  if (!absent) failAt(key, "is missing");
  return *absent;
}

std::optional<uint32_t> Element::colour(const char* key) const {
  if (!has(key)) return {};
  const std::string word = text(key);
  uint32_t v = 0;
  const auto [end, code] = std::from_chars(word.data(), word.data() + word.size(), v, 16);
  if (code != std::errc() || end != word.data() + word.size())
    failAt(key, fmt::format("is '{}', no colour as AARRGGBB", printable(word)));
  return v & 0xffffffu;
}

std::optional<int64_t> Element::integerIfAny(const char* key) const {
  if (!has(key)) return {};
  const std::string word = text(key);
  int64_t v = 0;
  const auto [end, code] = std::from_chars(word.data(), word.data() + word.size(), v);
  if (code != std::errc() || end != word.data() + word.size())
    failAt(key, fmt::format("is '{}', no whole number", printable(word)));
  return v;
}

void Element::readNumbers(const char* key, double* out, size_t count) const {
  const std::string words = text(key);
  size_t at = 0, found = 0;
  while (true) {
    at = words.find_first_not_of(" \t\r\n", at);
    if (at == std::string::npos) break;
    const size_t end = std::min(words.find_first_of(" \t\r\n", at), words.size());
    const auto v = parsedNumber(std::string_view(words).substr(at, end - at));
    if (!v || std::abs(*v) > kFarthestCm) failAt(key, "holds something that is no finite number");
    if (found < count) out[found] = *v;
    ++found, at = end;
  }
  if (found != count) failAt(key, fmt::format("holds {} numbers instead of {}", found, count));
}

}  // namespace roomlight::importers::sh3d
