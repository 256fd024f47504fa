#include "import/obj_lines.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>

namespace roomlight::importers {
namespace {

constexpr std::string_view kBlank = " \t\v\f";
constexpr float kNone = std::numeric_limits<float>::quiet_NaN();

// find_first_of would call a function for every character.
size_t lineEnd(std::string_view text) {
  size_t end = 0;
  while (end < text.size() && text[end] != '\n' && text[end] != '\r') ++end;
  return end;
}

std::string_view trimmed(std::string_view text) {
  text.remove_prefix(std::min(text.find_first_not_of(kBlank), text.size()));
  return text.substr(0, text.find_last_not_of(kBlank) + 1);
}

}  // namespace

ObjLines::ObjLines(std::string_view text) : rest_(text) {
  if (rest_.starts_with("\xef\xbb\xbf")) rest_.remove_prefix(3);
}

std::string_view ObjLines::takePart(bool& joined) {
  const size_t end = lineEnd(rest_);
  std::string_view part = rest_.substr(0, end);
  const bool both = rest_.substr(end).starts_with("\r\n");
  rest_.remove_prefix(std::min(end + (both ? 2 : 1), rest_.size()));
  ++next_;
  joined = part.ends_with('\\') && !rest_.empty();
  if (part.ends_with('\\')) part.remove_suffix(1);
  return part;
}

bool ObjLines::next(std::string_view& line) {
  if (rest_.empty()) return false;
  number_ = next_;
  bool joined = false;
  line = takePart(joined);
  if (joined) {
    joined_.assign(line);
    while (joined) joined_.append(" ").append(takePart(joined));
    line = joined_;
  }
  line = trimmed(line);
  return true;
}

std::string_view nextWord(std::string_view& text) {
  text.remove_prefix(std::min(text.find_first_not_of(kBlank), text.size()));
  size_t end = 0;
  while (end < text.size() && text[end] != ' ' && text[end] != '\t' && text[end] != '\v' && text[end] != '\f') ++end;
  const std::string_view word = text.substr(0, end);
  text.remove_prefix(end);
  return word;
}

float objNumber(std::string_view word) {
  if (word.starts_with('+')) word.remove_prefix(1);
  char point[64];
  if (const size_t comma = word.find(','); comma != std::string_view::npos && word.size() < sizeof(point)) {
    std::copy(word.begin(), word.end(), point);
    point[comma] = '.';
    word = {point, word.size()};
  }
  double v = 0;
  const auto [end, code] = std::from_chars(word.data(), word.data() + word.size(), v);
  if (end != word.data() + word.size()) return kNone;
  if (code == std::errc::result_out_of_range)
    return word.find("e-") != std::string_view::npos || word.find("E-") != std::string_view::npos ? 0 : kNone;
  if (code != std::errc() || !(std::abs(v) <= std::numeric_limits<float>::max())) return kNone;
  return static_cast<float>(v);
}

std::optional<ObjCorner> objCorner(std::string_view word) {
  ObjCorner corner;
  const char *at = word.data(), *end = at + word.size();
  for (int64_t* index : {&corner.v, &corner.vt, &corner.vn}) {
    if (at != end && *at != '/') {
      const auto [after, code] = std::from_chars(at, end, *index);
      if (code != std::errc()) return {};
      at = after;
    }
    if (at == end) break;
    if (*at++ != '/') return {};
  }
  if (at != end || corner.v == 0) return {};
  return corner;
}

}  // namespace roomlight::importers
