#include "display_options.h"

#include <fmt/format.h>

#include "arguments.h"
#include "photometry/white_balance.h"

namespace roomlight::cli {

void addDisplayOptions(CLI::App& command, DisplayOptions& options, const std::string& ofWhat) {
  command.add_option("--exposure", options.exposure, "auto, or EV100 as on a light meter")->capture_default_str();
  command.add_option("--tone", options.tone, fmt::format("Tone curve of {}: neutral, agx, filmic or clip", ofWhat))->capture_default_str();
  command.add_option("--white-balance", options.whiteBalance, fmt::format("White of {}: auto, none, or the temperature in kelvin of light that shall look white", ofWhat))->capture_default_str();
}

Result<Display> readDisplay(const DisplayOptions& o) {
  Display display;
  if (o.exposure != "auto") {
    display.ev100 = parseNumber<float>(o.exposure);
    if (!display.ev100 || !(std::abs(*display.ev100) <= 64)) return Error{fmt::format("--exposure {}: write auto or an EV100 from -64 to 64", o.exposure)};
  }
  const Result<ToneCurve> tone = toneCurveFromName(o.tone);
  if (!tone) return Error{"--tone: " + tone.error()};
  display.tone = tone.value();
  display.automaticWhite = o.whiteBalance == "auto";
  if (!display.automaticWhite && o.whiteBalance != "none") {
    display.whiteK = parseNumber<double>(o.whiteBalance);
    if (!display.whiteK || !(*display.whiteK >= kLowestWhiteK && *display.whiteK <= kHighestWhiteK)) {
      return Error{fmt::format("--white-balance {}: write auto, none or a temperature from {} to {} K", o.whiteBalance, kLowestWhiteK, kHighestWhiteK)};
    }
  }
  return display;
}

}  // namespace roomlight::cli
