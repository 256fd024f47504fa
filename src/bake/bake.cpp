#include "bake/bake.h"

#include <algorithm>
#include <cmath>

#include "bake/budget.h"
#include "bake/home_places.h"
#include "bake/lean.h"
#include "bake/light_texels.h"
#include "bake/lit_places.h"
#include "bake/page.h"
#include "bake/simplify.h"
#include "bake/smooth.h"
#include "home/cameras.h"
#include "look/display.h"

namespace roomlight::bake {
namespace {

bool sameLamp(const Lamp& a, const Lamp& b) { return a.name == b.name && length(a.position - b.position) < 1e-3f; }

constexpr const char* kOff = "\x1foff";  // at the end of a name; no file has it

// The lamps of the home, and those that are off as groups of their own: a lamp that is on may bear the same name. None
// of these where there are too many lamps to be told apart.
Scene withAllLamps(const Scene& home, const std::vector<Lamp>& offLamps) {
  Scene scene = home;
  for (Lamp lamp : offLamps) {
    if (std::any_of(home.lamps.begin(), home.lamps.end(), [&](const Lamp& l) { return sameLamp(l, lamp); })) continue;
    lamp.group = (lamp.group.empty() ? lamp.name : lamp.group) + kOff;
    scene.lamps.push_back(std::move(lamp));
  }
  return layersOf(scene, Lights(scene)) ? scene : home;
}

// As if the others were none; and the cameras in them, if there are any.
void keepRooms(Scene& scene, const std::vector<size_t>& rooms) {
  if (rooms.empty()) return;
  std::vector<Room> kept;
  for (const size_t r : rooms) kept.push_back(scene.rooms[r]);
  scene.rooms = std::move(kept);
  std::vector<Camera> inside;
  int inUse = 0;
  for (size_t i = 0; i < scene.cameras.size(); ++i) {
    if (roomAt(scene, scene.cameras[i].worldFromCamera.w) < 0) continue;
    if (static_cast<int>(i) == scene.cameraInUse) inUse = static_cast<int>(inside.size());
    inside.push_back(scene.cameras[i]);
  }
  if (inside.empty()) inside = home::proposeCameras(RayScene(scene), scene.rooms, false);
  scene.cameras = std::move(inside), scene.cameraInUse = inUse;
}

struct LaidOut {
  Scene scene;  // simplified
  Atlas atlas;
  LitPlaces lit;  // on the home as it is
  std::vector<float> movedM;       // of each mesh
  std::vector<bool> buriedCells;   // for masks of suns; empty: there are none
  Smoothing smoothing;
  SunCells sunCells() const { return {scene, atlas, lit, movedM, buriedCells}; }
};

Result<LaidOut> layOut(const RayScene& home, bool sun, const BakeSettings& settings, Stages& stages) {
  Scene scene = home.scene();
  const std::vector<Vec3> eyes = eyesIn(home);
  AtlasSettings ofAtlas = settings.atlas;
  ofAtlas.coarser = coarserFar(scene, eyes);
  std::vector<float> moved = stages.run(
      "simplify", [&](const Progress&) { return simplifyMeshes(scene, settings.simplifyM, ofAtlas.coarser); });
  const Rings rings = cutIntoRings(scene, static_cast<float>(kMostOutside) * settings.atlas.texelM);
  const RayScene rays(scene);
  const SeenSides seen = stages.run("seen", [&](const Progress&) {
    return seenFrom(rays, eyes, std::max(settings.seenRays, eyes.size() * settings.raysAnEye));
  });
  return stages.run("charts", [&](const Progress&) -> Result<LaidOut> {
    Result<Atlas> atlas = atlasOf(scene, chartsOf(scene, seen, settings.charts, rings), ofAtlas);
    if (!atlas) return Error{atlas.error()};
    LitPlaces lit = litPlacesOf(atlas.value(), rays, seen, settings.placesApartM);
    std::vector<bool> buried;
    if (sun) buried = buriedCells(rays, atlas.value(), lit, seen);
    putOnHome(lit, home, moved);
    Smoothing smoothing(atlas.value(), lit.buried, rays);
    return LaidOut{std::move(scene), std::move(atlas.value()), std::move(lit),
                   std::move(moved), std::move(buried),        std::move(smoothing)};
  });
}

constexpr double kBytesATexel = 4;         // of light, before it is compressed
constexpr double kBytesOfLightMap = 2;     // of it, a texel

size_t writtenSize(const BakeWish& wish, const std::string& glb) {
  return wish.asText ? static_cast<size_t>(kCharactersAByte * static_cast<double>(deflated(glb).size())) : glb.size();
}

// Of the file as it will be written, as far as that is known before there is light.
Result<FileParts> partsOf(const LaidOut& laid, const BakeWish& wish, const BakeSettings& settings) {
  const Result<Glb> dark =
      glbOf(laid.scene, laid.atlas, {{}, std::vector<int32_t>(laid.scene.instances.size(), -1)}, {}, {}, settings.glb);
  if (!dark) return Error{dark.error()};
  const Result<LightLayers> lamps = layersOf(laid.scene, Lights(laid.scene));
  const size_t layers = (lamps ? lamps.value().size() : laid.scene.rooms.size()) + 2 * wish.hours.size();
  // Textures and light are compressed already, and grow as all does that becomes text.
  const double grows = wish.asText ? kCharactersAByte : 1;
  const double size = static_cast<double>(writtenSize(wish, dark.value().bytes)),
               textures = grows * static_cast<double>(dark.value().textureBytes);
  const double bytesATexel =
      kBytesATexel * static_cast<double>(layers) + (settings.glb.lightMap ? kBytesOfLightMap : 0);
  return FileParts{size - textures, textures, grows * bytesATexel * static_cast<double>(laid.atlas.elements.size())};
}

constexpr float kLookedAtM = 2;      // things smaller than that are looked at from nearer,
constexpr float kLeastScale = 0.05f;  // down to a tenth of a metre

// Where a scene has no rooms its things are what is looked at: of small ones all lengths are in proportion.
void fitToThings(const Scene& scene, BakeSettings& s) {
  if (!scene.rooms.empty()) return;
  const float extentM = extentLookedAt(scene);
  if (!(extentM > 0)) return;
  const float scale = std::clamp(extentM / kLookedAtM, kLeastScale, 1.0f);
  for (float* length : {&s.charts.texelM, &s.atlas.texelM, &s.atlas.vertexM, &s.placesApartM, &s.simplifyM})
    *length *= scale;
  s.charts.smallM2 *= scale * scale;
}

// With settings coarse enough for the budget.
Result<LaidOut> layOutWithin(const Scene& home, const BakeWish& wish, BakeSettings& settings, Stages& stages) {
  const RayScene rays(home);
  const bool sun =
      std::any_of(wish.hours.begin(), wish.hours.end(), [](const DaylightHour& h) { return h.suns.size() == 1; });
  Result<LaidOut> laid = layOut(rays, sun, settings, stages);
  if (!laid || wish.budgetBytes == 0 || stages.cancelled()) return laid;
  const Result<FileParts> parts = partsOf(laid.value(), wish, settings);
  if (!parts) return Error{parts.error()};
  const float texelM = settings.charts.texelM, simplifyM = settings.simplifyM;
  settings = withinBudget(settings, parts.value(), wish.budgetBytes);
  return texelM == settings.charts.texelM && simplifyM == settings.simplifyM ? std::move(laid)
                                                                             : layOut(rays, sun, settings, stages);
}

// From places to the atlas, with less noise.
void spread(const LaidOut& laid, std::vector<BakedLayer>& layers) {
  for (BakedLayer& layer : layers) {
    layer.lux = laid.lit.spread<Vec3>(layer.lux);
    layer.errorLux = laid.lit.spread<float>(layer.errorLux);
  }
  laid.smoothing.smooth(laid.atlas, layers);
}

constexpr int kShownWidth = 320, kShownHeight = 180;
constexpr float kMostWhite = 0.3f;  // of a picture,
constexpr float kAlmostWhite = 0.9f;
constexpr float kMostHeldEv = 1.5f;

// Pages expose all of a picture alike, where `render` holds what is bright by local exposure: where most of a picture
// would be white it is exposed darker.
float heldEv100(float ev100, const Image& image) {
  std::vector<float> light;
  for (const Vec3& p : image.pixels) light.push_back(luminance(p));
  const auto bright = light.begin() + static_cast<ptrdiff_t>((1 - kMostWhite) * static_cast<float>(light.size()));
  std::nth_element(light.begin(), bright, light.end());
  const float over = *bright * exposureFromEv100(ev100) / kAlmostWhite;
  return ev100 + std::clamp(std::log2(std::max(over, 1.0f)), 0.0f, kMostHeldEv);
}

Result<ShownAs> shownAs(const Scene& scene, Stages& stages) {
  RenderSettings render;
  applyQuality("draft", render);
  render.width = kShownWidth, render.height = kShownHeight, render.blend = false;
  const std::vector<Camera> cameras = camerasInside(scene);
  const Camera camera = cameras.empty() ? defaultCamera(scene) : cameras[cameraInUse(scene, cameras)];
  const Result<Rendered> picture = stages.run("exposure", [&](const Progress& p) {
    RenderProgress progress;
    progress.cancelled = p.cancelled;
    return roomlight::render(scene, camera, render, progress);
  });
  if (!picture) return Error{picture.error()};
  ShownAs shown;
  if (picture.value().image.pixels.empty()) return shown;
  const Display display = usualDisplay();
  shown.tone = display.tone;
  shown.ev100 = heldEv100(ev100Of(display, picture.value().image), picture.value().image);
  shown.whiteGains = whiteOf(display, picture.value().lightColour).gains;
  shown.whites = shownWhites(display);
  return shown;
}

void markOff(std::vector<BakedLayer>& layers) {
  for (BakedLayer& layer : layers) {
    if (!layer.name.ends_with(kOff)) continue;
    layer.on = false;
    layer.name.resize(layer.name.size() - std::string_view(kOff).size());
  }
}

// Links a slot, times those of a picture: all places share the light that they find, and what chance does to it.
constexpr int kMoreLinks = 4;

}  // namespace

Result<BakeSettings> bakeSettings(const std::string& quality) {
  BakeSettings s;
  if (const Status status = applyQuality(quality, s.layers.render); !status) return Error{status.error()};
  s.layers.render.radiance.links *= kMoreLinks;
  if (quality == "draft")
    s.charts.texelM = s.atlas.texelM = s.placesApartM = 0.12f, s.simplifyM = 0.002f, s.layers.meters.tolerance = 0.4;
  if (quality == "best")
    s.charts.texelM = s.atlas.texelM = 0.025f, s.layers.meters = {0.03, 64, 512, 0, true, kTogether};
  return s;
}

Result<BakedHome> bakeHome(const Scene& home, const BakeWish& wish, const BakeSettings& wanted, Stages& stages) {
  Scene whole = withAllLamps(home, wish.offLamps);
  keepRooms(whole, wish.rooms);
  BakeSettings settings = wanted;
  fitToThings(whole, settings);
  const Result<LaidOut> laidOut = layOutWithin(whole, wish, settings, stages);
  if (!laidOut) return Error{laidOut.error()};
  if (stages.cancelled()) return BakedHome{};
  const LaidOut& laid = laidOut.value();
  if (laid.lit.places.empty()) return Error{"nothing of the home can be seen from its rooms or cameras"};
  const TurnedPlaces turned = turnedPlaces(laid.scene, laid.atlas, laid.lit);
  std::vector<SurfaceElement> places = laid.lit.places;
  places.insert(places.end(), turned.turned.begin(), turned.turned.end());
  Result<LampLayers> lamps = lampLayers(whole, places, settings.layers, stages);
  if (!lamps) return Error{lamps.error()};
  if (stages.cancelled()) return BakedHome{};
  markOff(lamps.value().layers);
  std::vector<BakedLayer> daylight;
  for (const DaylightHour& hour : wish.hours) {
    Scene day = whole;
    day.suns = hour.suns, day.sky = hour.sky;
    Result<std::vector<BakedLayer>> layers =
        daylightLayers(day, hour.hour, places, laid.sunCells(), settings.layers, stages);
    if (!layers) return Error{layers.error()};
    if (stages.cancelled()) return BakedHome{};
    std::move(layers.value().begin(), layers.value().end(), std::back_inserter(daylight));
  }
  const Result<ShownAs> shown = shownAs(whole, stages);
  if (!shown) return Error{shown.error()};
  if (stages.cancelled()) return BakedHome{};
  return stages.run("pack", [&](const Progress&) -> Result<BakedHome> {
    for (std::vector<BakedLayer>* layers : {&lamps.value().layers, &daylight}) {
      for (BakedLayer& layer : *layers) takeLean(turned, laid.lit, layer);
      spread(laid, *layers);
    }
    const auto pack = [&] {
      return glbOf(laid.scene, laid.atlas, lamps.value(), daylight, shown.value(), settings.glb);
    };
    Result<Glb> glb = pack();
    // What was foreseen too small.
    while (glb && wish.budgetBytes > 0 && writtenSize(wish, glb.value().bytes) > wish.budgetBytes &&
           settings.glb.mostTexturePixels > kSmallestTexture) {
      settings.glb.mostTexturePixels /= 2;
      glb = pack();
    }
    if (!glb) return Error{glb.error()};
    BakedHome out;
    out.glb = std::move(glb.value()), out.shown = shown.value(), out.settings = settings;
    out.places = laid.lit.places.size(), out.layers = lamps.value().layers.size() + daylight.size();
    out.atlasWidth = laid.atlas.width, out.atlasHeight = laid.atlas.height;
    for (const PlacedChart& chart : laid.atlas.charts) out.triangles += chart.indices.size() / 3;
    return out;
  });
}

}  // namespace roomlight::bake
