#include "import/obj_lines.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>

#include "import/failure.h"

namespace roomlight::importers {
namespace {

constexpr size_t kLongestLine = 1 << 20;
constexpr std::string_view kBlank = " \t";

std::string_view nextWord(std::string_view& text) {
  text.remove_prefix(std::min(text.find_first_not_of(kBlank), text.size()));
  const std::string_view word = text.substr(0, text.find_first_of(kBlank));
  text.remove_prefix(word.size());
  return word;
}

bool isFiniteFloat(std::string_view word) {
  if (word.starts_with('+')) word.remove_prefix(1);
  double v = 0;
  const auto [end, code] = std::from_chars(word.data(), word.data() + word.size(), v);
  const bool tiny = code == std::errc::result_out_of_range && word.find("e-") != std::string_view::npos;
  return end == word.data() + word.size() && (code == std::errc() || tiny) && std::abs(v) <= std::numeric_limits<float>::max();
}

void checkNumbers(const std::string& place, std::string_view text, size_t least, const char* what) {
  size_t count = 0;
  for (std::string_view word = nextWord(text); !word.empty(); word = nextWord(text), ++count) {
    if (word.starts_with('#')) break;
    if (!isFiniteFloat(word)) fail(place, fmt::format("'{}' is not a finite number", printable(word, 30)));
  }
  if (count < least) fail(place, fmt::format("a {} needs {} numbers", what, least));
}

void checkIndices(const std::string& place, std::string_view text) {
  for (std::string_view word = nextWord(text); !word.empty(); word = nextWord(text)) {
    size_t digits = 0;
    for (const char c : word) {
      const bool digit = c >= '0' && c <= '9';
      digits = digit ? digits + 1 : 0;
      if ((!digit && c != '-' && c != '/') || digits > 9) fail(place, fmt::format("'{}' is not a corner of a face", printable(word, 30)));
    }
  }
}

// find_first_of would call a function for every character.
size_t lineEnd(std::string_view text) {
  size_t end = 0;
  while (end < text.size() && text[end] != '\n' && text[end] != '\r') ++end;
  return end;
}

}  // namespace

// Trailing blanks and comments after a blank are cut; a backslash at the end joins the next line.
void ObjLines::takeLine() {
  line_.clear();
  number_ = next_;
  for (bool joined = true; joined && !rest_.empty();) {
    const size_t end = lineEnd(rest_);
    std::string_view part = rest_.substr(0, end);
    const bool both = rest_.substr(end).starts_with("\r\n");
    rest_.remove_prefix(std::min(end + (both ? 2 : 1), rest_.size()));
    ++next_;
    joined = part.ends_with('\\');
    if (joined) part.remove_suffix(1);
    if (line_.size() + part.size() > kLongestLine) fail(place(), fmt::format("is longer than {} characters; this is no OBJ file", kLongestLine));
    line_ += part;
    if (joined) line_ += ' ';
  }
  line_.erase(line_.find_last_not_of(kBlank) + 1);
}

void ObjLines::check() {
  if (line_.find('\0') != std::string::npos) fail(place(), "holds a NUL character; this is no OBJ file");
  std::string_view text = line_;
  const std::string_view word = nextWord(text);
  if (word == "v") checkNumbers(place(), text, 3, "vertex");
  if (word == "vn") checkNumbers(place(), text, 3, "normal");
  if (word == "vt") checkNumbers(place(), text, 1, "texture coordinate");
  if (word == "f") {
    line_.erase(std::min(line_.find('#'), line_.size()));
    checkIndices(place(), std::string_view(line_).substr(line_.find('f') + 1));
  }
  if (word == "l" || word == "p") ++linesAndPoints_;
  if (word == "curv" || word == "curv2" || word == "surf") ++freeForm_;
  if (word == "mtllib") {
    text.remove_prefix(std::min(text.find_first_not_of(kBlank), text.size()));
    libraries_.emplace_back(text);
  }
}

ObjLines::int_type ObjLines::underflow() {
  if (rest_.empty() || !failure_.empty()) return traits_type::eof();
  try {
    takeLine();
    check();
  } catch (const Failure& e) {
    // Streams swallow exceptions, so it is kept and the stream ends here.
    failure_ = e.what();
    return traits_type::eof();
  }
  line_ += '\n';
  setg(line_.data(), line_.data(), line_.data() + line_.size());
  return traits_type::to_int_type(line_.front());
}

}  // namespace roomlight::importers
