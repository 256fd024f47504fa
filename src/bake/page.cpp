#include "bake/page.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <string_view>
#include <utility>

#include "bake/light_texels.h"
#include "report/page.h"

namespace roomlight::bake {
namespace {

constexpr std::string_view kMark = "<!--roomlight-home-->", kTitle = "<title>roomlight</title>";
constexpr uint64_t kBase = 125;
constexpr size_t kBytes = 6;  // of a group: 256^6 is below 125^7

char character(uint64_t digit) {
  const uint64_t beyondReturn = digit + 1 + (digit + 1 >= '\r');
  return static_cast<char>(beyondReturn + (beyondReturn >= '<'));
}

Result<std::string> withElement(std::string page, const std::string& title, const std::string& element) {
  const std::pair<std::string_view, std::string> places[] = {
      {kMark, element}, {kTitle, fmt::format("<title>{}</title>", report::escaped(title))}};
  for (const auto& [mark, text] : places) {
    const size_t at = page.find(mark);
    if (at == std::string::npos) return Error{"the page has no place for a home; build it anew with scripts/build"};
    page.replace(at, mark.size(), text);
  }
  return page;
}

}  // namespace

std::string textOf(std::span<const char> bytes) {
  std::string out(bytes.size() + (bytes.size() + kBytes - 1) / kBytes, ' ');
  size_t end = 0;
  for (size_t i = 0; i < bytes.size(); i += kBytes) {
    const size_t n = std::min(kBytes, bytes.size() - i);
    uint64_t group = 0;
    for (size_t k = 0; k < n; ++k) group = group << 8 | static_cast<uint8_t>(bytes[i + k]);
    end += n + 1;
    for (size_t k = 1; k <= n + 1; ++k, group /= kBase) out[end - k] = character(group % kBase);
  }
  return out;
}

Result<std::string> pageWithHome(const std::string& page, const std::string& title, const std::string& glb) {
  const std::string element =
      fmt::format("<script type=\"application/octet-stream\" id=\"roomlight-home\" data-bytes=\"{}\">{}</script>",
                  glb.size(), textOf(deflated(glb)));
  return withElement(page, title, element);
}

Result<std::string> pageWithLink(const std::string& page, const std::string& title, const std::string& file) {
  return withElement(page, title, fmt::format("<link id=\"roomlight-home\" href=\"{}\">", file));
}

}  // namespace roomlight::bake
