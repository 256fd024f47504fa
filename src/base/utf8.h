// Text from files: as UTF-8, whatever its encoding, and fit for an error message.
#pragma once

#include <string>
#include <string_view>

namespace roomlight {

bool isUtf8(std::string_view text);

// The text itself where it is UTF-8, otherwise its bytes taken as Latin-1.
std::string asUtf8(std::string_view text);

// On one line: control characters become spaces, text of more than `most` bytes is cut between two characters.
inline std::string printable(std::string_view text, size_t most = 80) {
  size_t end = text.size() > most ? most : text.size();
  while (end < text.size() && end > 0 && (static_cast<unsigned char>(text[end]) & 0xc0) == 0x80) --end;  // inside UTF-8
  std::string line(text.substr(0, end));
  for (char& c : line) {
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) c = ' ';
  }
  return end < text.size() ? line + "..." : line;
}

}  // namespace roomlight
