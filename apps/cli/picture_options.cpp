#include "picture_options.h"

#include <fmt/format.h>

#include <sstream>

#include "arguments.h"
#include "console.h"
#include "look/display.h"
#include "look/exposure.h"
#include "photometry/colour_temperature.h"

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
  command.add_option("--tone", options.tone, fmt::format("Tone curve: {}", fmt::join(toneCurveNames(), ", ")));
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

namespace {

Result<Vec3> parsePlace(const std::string& option, const std::string& text) {
  const Result<std::vector<float>> n = parseList(option, text, "x,y,z in metres", {3});
  if (!n) return Error{n.error()};
  return Vec3{n.value()[0], n.value()[1], n.value()[2]};
}

Status checkCombination(const ViewOptions& o, View view, bool cameraNamed) {
  const bool above = view == View::Top || view == View::Plan, around = view == View::Panorama || view == View::Stereo,
             camera = view == View::Camera;
  const auto useless = [&](const char* option, const char* where) {
    return Error{fmt::format("{}: is of no use with --view {}; it goes with {}", option, o.view, where)};
  };
  if (o.cutM && around) return useless("--cut", "camera, top and plan");
  if (!o.level.empty() && (around || (camera && !o.cutM)))
    return useless("--level", "top and plan, and with camera where there is a --cut");
  if (!o.room.empty() && camera) return useless("--room", "top, plan, panorama and stereo");
  if (!o.room.empty() && !o.level.empty())
    return Error{"--room and --level: a room is on its own level; give one of them"};
  if (o.metresPerPixel && view != View::Plan) return useless("--metres-per-pixel", "plan");
  if (o.fovDeg && view != View::Camera && view != View::Top) return useless("--fov", "camera and top");
  if (!o.eye.empty() && above) return useless("--eye", "camera, panorama and stereo");
  if (cameraNamed && above) return useless("--camera", "camera, panorama and stereo");
  const int places = (o.eye.empty() ? 0 : 1) + (cameraNamed ? 1 : 0) + (around && !o.room.empty() ? 1 : 0);
  if (places > 1) return Error{"--eye, --camera and --room: each says from where to look; give one of them"};
  if (!o.target.empty() && o.eye.empty()) return Error{"--target: says where an eye looks; give --eye as well"};
  if (camera && !o.eye.empty() && o.target.empty()) return Error{"--eye: looks nowhere; give --target as well"};
  return Ok{};
}

}  // namespace

void addViewOptions(CLI::App& app, ViewOptions& o) {
  app.add_option("--view", o.view,
                 "camera; top: from above, cut open; plan: the same without perspective; panorama: all around, 2:1; "
                 "stereo: two of them for headsets, left eye on top")
      ->capture_default_str();
  app.add_option("--cut", o.cutM,
                 "Metres above the level's floor above which nothing is seen, though it gives and takes light; top and "
                 "plan: just under the ceiling");
  app.add_option("--level", o.level,
                 "Storey shown by top and plan: its number from 0, the lowest; default: at the ground");
  app.add_option("--room", o.room,
                 "top and plan: only this room; panorama and stereo: from its middle. Name, or number from 0");
  app.add_option("--eye", o.eye, "x,y,z in metres: look from there instead of from a camera of the scene");
  app.add_option("--target", o.target, "x,y,z in metres: what --eye looks at");
  app.add_option("--fov", o.fovDeg, "Full vertical angle in degrees, of camera and top");
  app.add_option("--metres-per-pixel", o.metresPerPixel,
                 "Scale of a plan; without --size the picture is as large as the home needs");
  app.add_option(
      "--backdrop", o.backdrop,
      "What is seen beside the home: sky, or none (transparent in .png); default: none for top and plan, else sky");
}

Result<ViewWish> readViewWish(const ViewOptions& o, bool cameraNamed) {
  const Result<View> view = viewFromName(o.view);
  if (!view) return Error{view.error()};
  if (const Status s = checkCombination(o, view.value(), cameraNamed); !s) return Error{s.error()};
  ViewWish wish;
  wish.view = view.value();
  wish.level = o.level, wish.room = o.room;
  if (o.cutM && !(*o.cutM > 0 && *o.cutM <= 1000))
    return Error{fmt::format("--cut {}: write metres above the floor, above 0 and at most 1000", *o.cutM)};
  wish.cutM = o.cutM;
  if (o.metresPerPixel && !(*o.metresPerPixel >= 1e-4f && *o.metresPerPixel <= 10))
    return Error{fmt::format("--metres-per-pixel {}: write 0.0001 to 10", *o.metresPerPixel)};
  wish.metresPerPixel = o.metresPerPixel;
  if (o.fovDeg && !(*o.fovDeg >= 1 && *o.fovDeg <= 170))
    return Error{fmt::format("--fov {}: write degrees from 1 to 170", *o.fovDeg)};
  if (o.fovDeg) wish.yFovRad = *o.fovDeg * kPi / 180;
  if (!o.backdrop.empty() && o.backdrop != "sky" && o.backdrop != "none")
    return Error{fmt::format("--backdrop {}: write sky or none", o.backdrop)};
  if (!o.backdrop.empty()) wish.emptyBackdrop = o.backdrop == "none";
  if (!o.eye.empty()) {
    const Result<Vec3> eye = parsePlace("--eye", o.eye);
    if (!eye) return Error{eye.error()};
    wish.eye = eye.value();
  }
  if (!o.target.empty()) {
    const Result<Vec3> target = parsePlace("--target", o.target);
    if (!target) return Error{target.error()};
    wish.target = target.value();
  }
  return wish;
}

}  // namespace roomlight::cli
