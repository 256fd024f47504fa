#include "display_options.h"

#include <fmt/format.h>

#include <sstream>

#include "arguments.h"
#include "console.h"
#include "look/exposure.h"
#include "look/look.h"
#include "photometry/white_balance.h"

namespace roomlight::cli {
namespace {

Status readWhite(const std::string& text, Display& display) {
  const bool percent = text.ends_with('%');
  display.automaticWhite = text == "auto" || percent;
  display.whiteK.reset(), display.warmth.reset();
  if (percent) {
    const std::optional<double> warmth = parseNumber<double>(text.substr(0, text.size() - 1));
    if (!warmth || !(*warmth >= 0 && *warmth <= 100))
      return Error{fmt::format("--white-balance {}: the warmth that is kept is from 0% to 100%", text)};
    display.warmth = *warmth / 100;
  } else if (!display.automaticWhite && text != "none") {
    display.whiteK = parseNumber<double>(text.ends_with('K') ? text.substr(0, text.size() - 1) : text);
    if (!display.whiteK || !(*display.whiteK >= kLowestWhiteK && *display.whiteK <= kHighestWhiteK)) {
      return Error{
          fmt::format("--white-balance {}: write auto, none, a warmth from 0% to 100% or a temperature from {} to {} K",
                      text, kLowestWhiteK, kHighestWhiteK)};
    }
  }
  return Ok{};
}

}  // namespace

void addDisplayOptions(CLI::App& command, DisplayOptions& options, const std::string& ofWhat) {
  command
      .add_option("--look", options.look,
                  listed(fmt::format("How {} shall look; the options below decide otherwise:", ofWhat), lookNames()))
      ->capture_default_str();
  command
      .add_option(
          "--exposure", options.exposure,
          fmt::format("auto, home (one for all rooms and hours: EV100 {}), or EV100 as on a light meter", kHomeEv100))
      ->capture_default_str();
  command
      .add_option("--local-exposure", options.localExposure,
                  "How far windows are held and dark corners opened: 0, not at all, to 1, by up to five and two stops")
      ->check(CLI::Range(0.0, 1.0));
  command.add_option("--white-balance", options.whiteBalance,
                     "auto: surfaces have their own colours, with a trace of the light's warmth; 0% to 100%: so much "
                     "of it; none; or the temperature in kelvin of light that shall look white");
  command.add_option("--tone", options.tone, "Tone curve: neutral, agx, filmic or clip");
  command.add_option("--contrast", options.contrast, "Of luminance, about middle grey; 1: as the light is")
      ->check(CLI::Range(0.5, 2.0));
  command.add_option("--saturation", options.saturation, "Of colours; 1: as the light is, 0: grey")
      ->check(CLI::Range(0.0, 2.0));
  command.add_option("--glare", options.glare, "Share of the light that is scattered around lamps, as in an eye")
      ->check(CLI::Range(0.0, 0.5));
  command.add_option("--vignette", options.vignette, "How much darker the corners are")->check(CLI::Range(0.0, 1.0));
}

Result<Display> readDisplay(const DisplayOptions& o) {
  Result<Display> look = displayOfLook(o.look);
  if (!look) return Error{"--look: " + look.error()};
  Display display = look.value();
  if (o.exposure == "home") {
    display.ev100 = kHomeEv100;
  } else if (o.exposure != "auto") {
    display.ev100 = parseNumber<float>(o.exposure);
    if (!display.ev100 || !(std::abs(*display.ev100) <= 64))
      return Error{fmt::format("--exposure {}: write auto, home or an EV100 from -64 to 64", o.exposure)};
  }
  if (!o.tone.empty()) {
    const Result<ToneCurve> curve = toneCurveFromName(o.tone);
    if (!curve) return Error{"--tone: " + curve.error()};
    display.tone = curve.value();  // contrast and saturation go with the look's own
  }
  if (!o.whiteBalance.empty()) {
    if (const Status s = readWhite(o.whiteBalance, display); !s) return Error{s.error()};
  }
  display.tone.contrast = o.contrast.value_or(display.tone.contrast),
  display.tone.saturation = o.saturation.value_or(display.tone.saturation);
  display.localExposure = o.localExposure.value_or(display.localExposure);
  display.glare = o.glare.value_or(display.glare), display.vignette = o.vignette.value_or(display.vignette);
  return display;
}

std::optional<Vec3> lightColourIn(const Metadata& metadata) {
  const auto found = metadata.find(kLightColourKey);
  if (found == metadata.end()) return std::nullopt;
  std::istringstream text(found->second);
  Vec3 colour;
  return text >> colour.x >> colour.y >> colour.z ? std::optional(colour) : std::nullopt;
}

}  // namespace roomlight::cli
