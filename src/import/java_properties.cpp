#include "import/java_properties.h"

#include <fmt/format.h>

#include <charconv>
#include <string_view>

#include "import/failure.h"

namespace roomlight::importers {
namespace {

constexpr std::string_view kBlank = " \t\f";

void appendUtf8(uint32_t c, std::string& out) {
  const auto tail = [&](int shift) { out += static_cast<char>(0x80 | (c >> shift & 0x3f)); };
  if (c < 0x80) {
    out += static_cast<char>(c);
  } else if (c < 0x800) {
    out += static_cast<char>(0xc0 | c >> 6), tail(0);
  } else if (c < 0x10000) {
    out += static_cast<char>(0xe0 | c >> 12), tail(6), tail(0);
  } else {
    out += static_cast<char>(0xf0 | c >> 18), tail(12), tail(6), tail(0);
  }
}

class Lines {
 public:
  explicit Lines(std::string_view text) : rest_(text) {}

  // The next line that says something, joined with those it goes on with, without leading blanks; false at the end.
  bool next(std::string& line) {
    line.clear();
    bool joined = false;
    while (!rest_.empty()) {
      std::string_view part = natural();
      part.remove_prefix(std::min(part.find_first_not_of(kBlank), part.size()));
      if (!joined && (part.empty() || part.front() == '#' || part.front() == '!')) continue;
      const size_t last = part.find_last_not_of('\\');
      const size_t backslashes = part.size() - (last == std::string_view::npos ? 0 : last + 1);
      joined = backslashes % 2 == 1;
      if (joined) part.remove_suffix(1);
      line += part;
      if (!joined) return true;
    }
    return !line.empty();
  }
  size_t number() const { return number_; }

 private:
  std::string_view natural() {
    const size_t end = std::min(rest_.find_first_of("\r\n"), rest_.size());
    const std::string_view part = rest_.substr(0, end);
    const bool both = rest_.substr(end).starts_with("\r\n");
    rest_.remove_prefix(std::min(end + (both ? 2 : 1), rest_.size()));
    ++number_;
    return part;
  }

  std::string_view rest_;
  size_t number_ = 0;
};

// One character from `text`, with its escapes taken away; surrogates as they are.
uint32_t takeCharacter(std::string_view& text, size_t line) {
  const auto first = static_cast<unsigned char>(text.front());
  text.remove_prefix(1);
  if (first != '\\' || text.empty()) return first;
  const char escape = text.front();
  text.remove_prefix(1);
  switch (escape) {
    case 't': return '\t';
    case 'n': return '\n';
    case 'r': return '\r';
    case 'f': return '\f';
    case 'u': break;
    default: return static_cast<unsigned char>(escape);
  }
  uint32_t code = 0;
  const std::string_view digits = text.substr(0, 4);
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), code, 16);
  if (error != std::errc() || digits.size() < 4 || end != digits.data() + 4)
    fail(fmt::format("line {}", line), "\\u is not followed by four hexadecimal digits");
  text.remove_prefix(4);
  return code;
}

bool isHigh(uint32_t c) { return c >= 0xd800 && c < 0xdc00; }
bool isLow(uint32_t c) { return c >= 0xdc00 && c < 0xe000; }

// Up to `end` of unescaped characters, of which the first found stays in `text`.
std::string take(std::string_view& text, std::string_view end, size_t line) {
  std::string out;
  uint32_t high = 0;
  while (!text.empty() && end.find(text.front()) == std::string_view::npos) {
    uint32_t c = takeCharacter(text, line);
    if (high != 0 && isLow(c)) {
      c = 0x10000 + ((high - 0xd800) << 10) + (c - 0xdc00);
    } else if (high != 0) {
      appendUtf8(0xfffd, out);
    }
    high = isHigh(c) ? c : 0;
    if (high == 0) appendUtf8(isLow(c) ? 0xfffd : c, out);
  }
  if (high != 0) appendUtf8(0xfffd, out);
  return out;
}

}  // namespace

std::map<std::string, std::string> javaProperties(std::span<const uint8_t> bytes) {
  Lines lines({reinterpret_cast<const char*>(bytes.data()), bytes.size()});
  std::map<std::string, std::string> out;
  std::string line;
  while (lines.next(line)) {
    std::string_view text = line;
    const std::string key = take(text, "=: \t\f", lines.number());
    text.remove_prefix(std::min(text.find_first_not_of(kBlank), text.size()));
    if (!text.empty() && (text.front() == '=' || text.front() == ':')) text.remove_prefix(1);
    text.remove_prefix(std::min(text.find_first_not_of(kBlank), text.size()));
    out[key] = take(text, "", lines.number());
  }
  return out;
}

}  // namespace roomlight::importers
