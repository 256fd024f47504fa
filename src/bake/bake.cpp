#include "bake/bake.h"

#include <fmt/format.h>

#include <algorithm>

#include "bake/lit_places.h"
#include "bake/simplify.h"
#include "look/display.h"
#include "report/page.h"

namespace roomlight::bake {
namespace {

constexpr std::string_view kMark = "<!--roomlight-home-->", kTitle = "<title>roomlight</title>";

// The lamps of the home, those that are off too.
Scene withAllLamps(const Scene& home, const std::vector<Lamp>& offLamps) {
  Scene scene = home;
  scene.lamps.insert(scene.lamps.end(), offLamps.begin(), offLamps.end());
  return scene;
}

struct LaidOut {
  Atlas atlas;
  LitPlaces lit;
};

LaidOut layOut(const Scene& scene, const BakeSettings& settings, Stages& stages) {
  const RayScene rays(scene);
  const SeenSides seen =
      stages.run("seen", [&](const Progress&) { return seenFrom(rays, eyesIn(rays), settings.seenRays); });
  return stages.run("charts", [&](const Progress&) {
    LaidOut out;
    out.atlas = fittingAtlasOf(scene, chartsOf(scene, seen, settings.charts), settings.atlas);
    out.lit = litPlacesOf(out.atlas, rays, seen, settings.placesApartM);
    return out;
  });
}

// From places to the atlas, with less noise.
void spread(const LaidOut& laid, std::vector<BakedLayer>& layers) {
  for (BakedLayer& layer : layers) {
    layer.lux = laid.lit.spread<Vec3>(layer.lux);
    layer.errorLux = laid.lit.spread<float>(layer.errorLux);
  }
  smoothLayers(laid.atlas, layers);
}

constexpr int kShownWidth = 320, kShownHeight = 180;

Result<ShownAs> shownAs(const Scene& scene, Stages& stages) {
  RenderSettings render;
  applyQuality("draft", render);
  render.width = kShownWidth, render.height = kShownHeight, render.blend = false;
  Camera camera = defaultCamera(scene);
  if (camera.projection != Projection::Perspective) camera.projection = Projection::Perspective;
  const Result<Rendered> picture = stages.run("exposure", [&](const Progress& p) {
    RenderProgress progress;
    progress.cancelled = p.cancelled;
    return roomlight::render(scene, camera, render, progress);
  });
  if (!picture) return Error{picture.error()};
  ShownAs shown;
  if (picture.value().image.pixels.empty()) return shown;
  const Display display = usualDisplay();
  shown.curve = display.tone.curve;
  shown.ev100 = ev100Of(display, picture.value().image);
  shown.whiteGains = whiteOf(display, picture.value().lightColour).gains;
  return shown;
}

void markOff(const std::vector<Lamp>& offLamps, std::vector<BakedLayer>& layers) {
  for (BakedLayer& layer : layers)
    layer.on = std::none_of(offLamps.begin(), offLamps.end(), [&](const Lamp& l) { return l.name == layer.name; });
}

}  // namespace

Result<BakeSettings> bakeSettings(const std::string& quality) {
  BakeSettings s;
  if (const Status status = applyQuality(quality, s.layers.render); !status) return Error{status.error()};
  if (quality == "draft")
    s.charts.texelM = s.atlas.texelM = s.placesApartM = 0.12f, s.simplifyM = 0.004f, s.layers.meters = {0.4, 16, 32, 0};
  if (quality == "best") s.charts.texelM = s.atlas.texelM = 0.025f, s.layers.meters = {0.03, 64, 512, 0};
  return s;
}

Result<BakedHome> bakeHome(const Scene& home, const BakeWish& wish, const BakeSettings& settings, Stages& stages) {
  Scene scene = withAllLamps(home, wish.offLamps);
  stages.run("simplify", [&](const Progress&) { return simplifyMeshes(scene, settings.simplifyM), 0; });
  const LaidOut laid = layOut(scene, settings, stages);
  if (laid.lit.places.empty()) return Error{"nothing of the home can be seen from its rooms or cameras"};
  const std::vector<SurfaceElement>& places = laid.lit.places;
  Result<LampLayers> lamps = lampLayers(scene, places, settings.layers, stages);
  if (!lamps) return Error{lamps.error()};
  if (stages.cancelled()) return BakedHome{};
  markOff(wish.offLamps, lamps.value().layers);
  std::vector<BakedLayer> daylight;
  for (const DaylightHour& hour : wish.hours) {
    Scene day = scene;
    day.suns = hour.suns, day.sky = hour.sky;
    Result<std::vector<BakedLayer>> layers = daylightLayers(day, hour.hour, places, settings.layers, stages);
    if (!layers) return Error{layers.error()};
    if (stages.cancelled()) return BakedHome{};
    std::move(layers.value().begin(), layers.value().end(), std::back_inserter(daylight));
  }
  const Result<ShownAs> shown = shownAs(home, stages);
  if (!shown) return Error{shown.error()};
  return stages.run("pack", [&](const Progress&) -> Result<BakedHome> {
    spread(laid, lamps.value().layers), spread(laid, daylight);
    Result<Glb> glb = glbOf(scene, laid.atlas, lamps.value(), daylight, shown.value(), settings.glb);
    if (!glb) return Error{glb.error()};
    BakedHome out;
    out.glb = std::move(glb.value()), out.shown = shown.value();
    out.places = places.size(), out.layers = lamps.value().layers.size() + daylight.size();
    out.atlasWidth = laid.atlas.width, out.atlasHeight = laid.atlas.height;
    for (const PlacedChart& chart : laid.atlas.charts) out.triangles += chart.indices.size() / 3;
    return out;
  });
}

namespace {

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

Result<std::string> pageWithHome(const std::string& page, const std::string& title, const std::string& glb) {
  return withElement(
      page, title,
      fmt::format("<script type=\"application/octet-stream\" id=\"roomlight-home\">{}</script>", report::base64(glb)));
}

Result<std::string> pageWithLink(const std::string& page, const std::string& title, const std::string& file) {
  return withElement(page, title, fmt::format("<link id=\"roomlight-home\" href=\"{}\">", file));
}

}  // namespace roomlight::bake
