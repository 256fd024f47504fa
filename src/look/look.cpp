#include "look/display.h"

#include <fmt/format.h>

namespace roomlight {
namespace {

Display natural() {
  Display d;
  d.brighterEv = 0.3f;
  d.tone = {ToneCurve::PbrNeutral, 1.08f, 1.05f};
  d.localExposure = 1;
  return d;
}

Display bright() {
  Display d = natural();
  d.brighterEv = 1.0f;
  return d;
}

Display evening() {
  Display d = natural();
  d.brighterEv = -0.3f;
  d.warmth = 0.3;
  d.glare = 0.05f;
  d.vignette = 0.15f;
  return d;
}

Display technical() {
  Display d;
  d.warmth = 0;
  return d;
}

}  // namespace

Display usualDisplay() { return natural(); }

const std::vector<std::pair<std::string, std::string>>& lookNames() {
  static const std::vector<std::pair<std::string, std::string>> names = {
      {"natural", "as an eye sees it: windows and corners within reach, a trace of the lamps' warmth"},
      {"bright", "as a brochure has it: 0.7 EV brighter than natural"},
      {"evening", "darker and warmer, with glare around lamps"},
      {"technical", "one exposure all over, no contrast added, white is white"}};
  return names;
}

Result<Display> displayOfLook(const std::string& name) {
  if (name == "natural") return natural();
  if (name == "bright") return bright();
  if (name == "evening") return evening();
  if (name == "technical") return technical();
  std::string names;
  for (const auto& [known, what] : lookNames()) names += (names.empty() ? "" : ", ") + known;
  return Error{fmt::format("unknown look '{}'; there are {}", name, names)};
}

}  // namespace roomlight
