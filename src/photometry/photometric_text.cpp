#include "photometry/photometric_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>

namespace roomlight::photometric {
namespace {

constexpr size_t kMostBytes = size_t{16} << 20;
constexpr double kMost = 1e12;

bool isBlank(char c) {
  return c == ' ' || c == '\t' || c == '\f' || c == '\v' || c == '\x1a';
}  // DOS ends files with 0x1a
bool separates(char c) { return isBlank(c) || c == ','; }

std::string_view trimmed(std::string_view s) {
  while (!s.empty() && isBlank(s.front())) s.remove_prefix(1);
  while (!s.empty() && isBlank(s.back())) s.remove_suffix(1);
  return s;
}

bool isUtf8(std::string_view s) {
  for (size_t i = 0; i < s.size();) {
    const auto c = static_cast<unsigned char>(s[i]);
    const size_t more = c < 0x80                ? 0
                        : c >= 0xc2 && c < 0xe0 ? 1
                        : c >= 0xe0 && c < 0xf0 ? 2
                        : c >= 0xf0 && c < 0xf5 ? 3
                                                : 4;
    if (more > 3 || i + more >= s.size()) return false;
    for (size_t k = 1; k <= more; ++k) {
      if ((static_cast<unsigned char>(s[i + k]) & 0xc0) != 0x80) return false;
    }
    i += more + 1;
  }
  return true;
}

std::string utf8FromLatin1(std::string_view s) {
  std::string out;
  for (const char c : s) {
    const auto b = static_cast<unsigned char>(c);
    if (b < 0x80) {
      out += c;
    } else {
      out += static_cast<char>(0xc0 | b >> 6);
      out += static_cast<char>(0x80 | (b & 0x3f));
    }
  }
  return out;
}

std::string quoted(std::string_view word) {
  std::string s(word.substr(0, 24));
  for (char& c : s) {
    if (static_cast<unsigned char>(c) < 0x20 || static_cast<unsigned char>(c) >= 0x7f) c = '?';
  }
  return word.size() > 24 ? s + "..." : s;
}

}  // namespace

void damage(size_t line, const std::string& what) {
  throw Damage(line > 0 ? fmt::format("line {}: {}", line, what) : what);
}

void Oddities::add(const std::string& what) {
  if (std::find(lines_.begin(), lines_.end(), what) == lines_.end()) lines_.push_back(what);
}

std::vector<Line> linesOf(std::string_view text, Oddities& odd) {
  if (text.size() > kMostBytes) damage(0, "is larger than 16 MiB");
  if (text.starts_with("\xef\xbb\xbf")) {
    text.remove_prefix(3);
    odd.add("begins with a byte-order mark");
  }
  const size_t nul = text.find('\0');
  std::vector<Line> lines;
  for (size_t i = 0; i < text.size();) {
    const size_t end = std::min(text.find_first_of("\r\n", i), text.size());
    if (nul >= i && nul < end) damage(lines.size() + 1, "holds a NUL character; it is no text");
    std::string line(trimmed(text.substr(i, end - i)));
    if (!isUtf8(line)) {
      line = utf8FromLatin1(line);
      odd.add("letters are read as Latin-1");
    }
    lines.push_back({lines.size() + 1, std::move(line)});
    i = end + (text.substr(end, 2) == "\r\n" ? 2 : 1);
  }
  return lines;
}

double numberIn(std::string_view text, size_t line, const std::string& what) {
  std::string_view digits = text.starts_with('+') ? text.substr(1) : text;
  double v = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), v);
  if (end != digits.data() + digits.size() || digits.empty() || error != std::errc()) {
    damage(line, fmt::format("{}: '{}' is not a number", what, quoted(text)));
  }
  if (!(std::abs(v) <= kMost)) damage(line, fmt::format("{}: {} is out of range", what, quoted(text)));
  return v;
}

// Steps to where the next value begins.
bool Words::find() {
  for (; line_ < lines_.size(); ++line_, at_ = 0) {
    const std::string& s = lines_[line_].text;
    while (at_ < s.size() && separates(s[at_])) ++at_;
    if (at_ < s.size()) return true;
  }
  return false;
}

bool Words::atEnd() { return !find(); }

size_t Words::left() const {
  size_t characters = 0;
  for (size_t i = line_; i < lines_.size(); ++i) characters += lines_[i].text.size() + 1;
  return characters / 2 + 1;
}

double Words::number(const std::string& what) {
  if (!find()) damage(lines_.empty() ? 1 : lines_.back().number, fmt::format("the file ends before {}", what));
  const std::string& s = lines_[line_].text;
  const size_t begin = at_;
  while (at_ < s.size() && !separates(s[at_])) ++at_;
  lastLine_ = lines_[line_].number;
  return numberIn(std::string_view(s).substr(begin, at_ - begin), lastLine_, what);
}

size_t Words::count(const std::string& what, size_t most) {
  const double v = number(what);
  if (!(v >= 1 && v <= static_cast<double>(most)) || v != std::floor(v))
    damage(lastLine_, fmt::format("{}: {} is not a whole number from 1 to {}", what, v, most));
  return static_cast<size_t>(v);
}

std::vector<double> Words::numbers(size_t count, const std::string& what) {
  if (count > left())
    damage(lines_.empty() ? 1 : lines_.back().number,
           fmt::format("the file is too short for {} values of {}", count, what));
  std::vector<double> out;
  out.reserve(count);
  for (size_t i = 0; i < count; ++i) out.push_back(number(what));
  return out;
}

}  // namespace roomlight::photometric
