#include "mix/layer_info.h"

#include <fmt/core.h>

#include <charconv>

#include "base/tone.h"
#include "photometry/colour_temperature.h"

namespace roomlight {
namespace {

constexpr double kMostPercent = 1000;
// Noise of a primary grows with its gain; a candle's blue (1850 K, 0.02 of white's) is still usable for 6500 K.
constexpr float kMostGain = 200;
constexpr float kLeastOfPrimary = 1e-3f;

std::optional<double> number(std::string_view text) {
  while (!text.empty() && text.back() == ' ') text.remove_suffix(1);
  double value = 0;
  const auto [end, code] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (code != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return value;
}

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && text.front() == ' ') text.remove_prefix(1);
  while (!text.empty() && text.back() == ' ') text.remove_suffix(1);
  return text;
}

Result<Vec3> tintOfHex(std::string_view text) {
  uint32_t rgb = 0;
  const auto [end, code] = std::from_chars(text.data() + 1, text.data() + text.size(), rgb, 16);
  if (text.size() != 7 || code != std::errc() || end != text.data() + text.size())
    return Error{fmt::format("'{}': write a colour as #rrggbb, for example #ffd080", text)};
  if (rgb == 0) return Error{"'#000000' is no colour of light; write off"};
  const auto channel = [rgb](int shift) { return srgbDecode(static_cast<float>((rgb >> shift) & 255u) / 255); };
  const Vec3 linear{channel(16), channel(8), channel(0)};
  return linear / luminance(linear);
}

Status readPart(std::string_view part, Dial& dial) {
  if (part == "on" || part == "off") {
    dial.level = part == "on" ? 1.0f : 0.0f;
    return Ok{};
  }
  if (part.starts_with('#')) {
    const Result<Vec3> tint = tintOfHex(part);
    if (!tint) return Error{tint.error()};
    dial.tint = tint.value();
    return Ok{};
  }
  const std::string_view digits = part.substr(0, part.empty() ? 0 : part.size() - 1);
  const std::optional<double> value = number(digits);
  if (value && part.back() == '%') {
    if (!(*value >= 0 && *value <= kMostPercent))
      return Error{fmt::format("'{}': must be from 0 to {} %", part, kMostPercent)};
    dial.level = static_cast<float>(*value / 100);
    return Ok{};
  }
  if (value && (part.back() == 'K' || part.back() == 'k')) {
    const Result<Vec3> tint = tintOfKelvin(*value);
    if (!tint) return Error{tint.error()};
    dial.tint = tint.value();
    return Ok{};
  }
  return Error{
      fmt::format("'{}': write on, off, a percentage (60%), a temperature (2700K) or a colour (#ffd080)", part)};
}

}  // namespace

Result<Vec3> tintOfKelvin(double kelvin) {
  if (!(kelvin >= kLowestKelvin && kelvin <= kHighestKelvin))
    return Error{fmt::format("{:g} K: must be from {:g} to {:g} K", kelvin, kLowestKelvin, kHighestKelvin)};
  return blackBodyColour(kelvin);
}

Result<Dial> parseDial(std::string_view text) {
  Dial dial;
  while (true) {
    const size_t comma = text.find(',');
    if (const Status s = readPart(trimmed(text.substr(0, comma)), dial); !s) return Error{s.error()};
    if (comma == std::string_view::npos) return dial;
    text.remove_prefix(comma + 1);
  }
}

Result<Vec3> gainOf(const LayerInfo& layer, const Dial& dial) {
  const float level = dial.level.value_or(1);
  if (!dial.tint || level == 0) return Vec3(level);
  const Vec3 own = layer.colour, wanted = *dial.tint;
  Vec3 gain;
  for (int c = 0; c < 3; ++c) {
    if (wanted[c] <= kLeastOfPrimary) continue;
    constexpr const char* kPrimaries[] = {"red", "green", "blue"};
    if (!(own[c] * kMostGain >= wanted[c])) {
      return Error{fmt::format(
          "'{}' was rendered with light that has next to no {}, so it cannot be given this colour; render it whiter",
          layer.name, kPrimaries[c])};
    }
    gain[c] = level * wanted[c] / own[c];
  }
  return gain;
}

}  // namespace roomlight
