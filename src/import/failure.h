// Inside this folder readers throw; importGltf and importObj turn it into the one-line error of the contract.
#pragma once

#include <stdexcept>
#include <string>
#include <string_view>

namespace roomlight::importers {

struct Failure : std::runtime_error {
  using std::runtime_error::runtime_error;  // "place: what is wrong; what to do"
};

[[noreturn]] inline void fail(std::string_view place, std::string_view what) {
  throw Failure(std::string(place).append(place.empty() ? "" : ": ").append(what));
}

// Text from a file, safe to print on one line: control characters become '?', long text is cut between characters.
inline std::string printable(std::string_view text, size_t limit = 80) {
  std::string out(text.substr(0, limit));
  for (char& c : out) {
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) c = '?';
  }
  if (text.size() > limit) {
    while (!out.empty() && (static_cast<unsigned char>(out.back()) & 0xc0) == 0x80) out.pop_back();
    if (!out.empty() && static_cast<unsigned char>(out.back()) >= 0xc0) out.pop_back();
    out += "...";
  }
  return out;
}

}  // namespace roomlight::importers
