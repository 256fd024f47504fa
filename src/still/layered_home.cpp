#include "still/layered_home.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/parallel.h"
#include "still/developed.h"

namespace roomlight {
namespace {

// A layer's own dial, and what is laid over it: of either, the part that is said.
void apply(const Dial& dial, Dial& onto) {
  if (dial.level) onto.level = dial.level;
  if (dial.tint) onto.tint = dial.tint;
}

Status applyToKind(const std::vector<LayerInfo>& layers, const std::string& kind,
                   const std::optional<std::string>& text, std::vector<Dial>& dials) {
  if (!text) return Ok{};
  const Result<Dial> dial = parseDial(*text);
  if (!dial) return Error{fmt::format("--{} {}", kind, dial.error())};
  bool any = false;
  for (size_t i = 0; i < layers.size(); ++i) {
    if (layers[i].kind != kind) continue;
    apply(dial.value(), dials[i]);
    any = true;
  }
  const bool off = dial.value().level && *dial.value().level == 0;  // of what is not there: it is off
  if (!any && !off) return Error{fmt::format("--{}: the picture has no layer of the {}", kind, kind)};
  return Ok{};
}

Status applyToLamps(const std::vector<LayerInfo>& layers, const std::string& text, std::vector<Dial>& dials) {
  const Result<Assignment> assignment = splitAssignment("--lamp", text);
  if (!assignment) return Error{assignment.error()};
  const Result<std::vector<size_t>> found = findLamps(layers, assignment.value().name);
  if (!found) return Error{fmt::format("--lamp: {}", found.error())};
  const Result<Dial> dial = parseDial(assignment.value().value);
  if (!dial) return Error{fmt::format("--lamp {}: {}", text, dial.error())};
  for (const size_t i : found.value()) apply(dial.value(), dials[i]);
  return Ok{};
}

bool changesNothing(const Retouch& by) { return by.gains.values.empty() && by.glare <= 0 && by.vignette <= 0; }

Image sidesOf(const std::vector<EdgePixel>& edges, const Plane& gains, const Image& retouched) {
  const size_t count = edges.size();
  Image sides(static_cast<int>(count), 3);
  const Image rests = retouchedRests(edges, gains, retouched);
  for (size_t i = 0; i < count; ++i) {
    sides.pixels[i] = rests.pixels[i], sides.pixels[count + i] = retouched.pixels[edges[i].bright],
    sides.pixels[2 * count + i] = retouched.pixels[edges[i].pixel];
  }
  return sides;
}

// As mixDisplay() shows them, before they are cut to bytes.
void showEdges(const MixHome& home, std::span<const Vec3> gains, const Look& look, ByteImage& mixed) {
  const size_t count = home.edges.size();
  Image sides = mixLinear(home.sides, gains);
  for (Vec3& p : sides.pixels) p = look.whiteBalance.vector(p);
  sides = toneMap(std::move(sides), look.ev100, look.tone);
  parallelFor(count, 1024, [&](size_t i) {
    const EdgePixel& e = home.edges[i];
    const Vec3 shown = shownEdge(e, sides.pixels[2 * count + i], sides.pixels[count + i], sides.pixels[i]);
    const int x = static_cast<int>(e.pixel) % mixed.width, y = static_cast<int>(e.pixel) / mixed.width;
    for (int c = 0; c < 3; ++c)
      mixed.samples[size_t{3} * e.pixel + static_cast<size_t>(c)] =
          static_cast<uint8_t>(static_cast<int>(shown[c] * 255 + ditherAt(x, y)));
  });
}

// By what the file tells of each layer's light on surfaces; older ones do not, so the layers' own colours stand for it.
Vec3 lightColourOf(const MixHome& home, const Mixture& mixture) {
  Vec3 sum;
  const bool told =
      std::all_of(home.layers.begin(), home.layers.end(), [](const LayerInfo& l) { return l.lightColour.has_value(); });
  for (size_t i = 0; i < home.layers.size(); ++i)
    sum += told ? *home.layers[i].lightColour * mixture.gains[i]
                : mixture.hues[i] * luminance(home.stack.meanRgb[i] * mixture.gains[i]);
  return sum;
}

}  // namespace

Image linearMix(const MixHome& home, std::span<const Vec3> gains) {
  Image mixed = mixLinear(home.stack, gains);
  for (size_t i = 0; i < home.sights.section.size(); ++i)
    mixed.pixels[i] *= 1 - home.sights.section[i] - home.sights.backdrop[i];
  return mixed;
}

ByteImage displayMix(const MixHome& home, std::span<const Vec3> gains, const Look& look, bool transparent) {
  ByteImage mixed = mixDisplay(home.stack, gains, look);
  if (!home.edges.empty()) showEdges(home, gains, look, mixed);
  const Sights& sights = home.sights;
  if (sights.section.empty()) return mixed;
  const bool alpha =
      transparent && std::any_of(sights.backdrop.begin(), sights.backdrop.end(), [](float b) { return b > 0; });
  ByteImage out(mixed.width, mixed.height, alpha ? 4 : 3);
  const size_t channels = alpha ? 4 : 3;
  parallelFor(mixed.pixelCount(), 16384, [&](size_t i) {
    const float cut = sights.section[i], nothing = sights.backdrop[i], solid = 1 - nothing;
    for (size_t c = 0; c < 3; ++c) {
      const float inside = static_cast<float>(mixed.samples[3 * i + c]) * std::max(0.0f, solid - cut) +
                           255 * kSectionColour[static_cast<int>(c)] * cut;
      const float shown = !alpha      ? inside + 255 * kPaperColour[static_cast<int>(c)] * nothing
                          : solid > 0 ? inside / solid
                                      : 255;
      out.samples[channels * i + c] = static_cast<uint8_t>(std::clamp(shown + 0.5f, 0.0f, 255.0f));
    }
    if (alpha) out.samples[channels * i + 3] = static_cast<uint8_t>(solid * 255 + 0.5f);
  });
  return out;
}

Result<MixHome> openLayers(const std::string& file) {
  Result<LayeredImage> read = readLayers(file);
  if (!read) return Error{read.error()};
  return layersOf(std::move(read.value()), file);
}

Result<MixHome> layersOf(LayeredImage picture, const std::string& file) {
  const auto text = picture.metadata.find(kLayersKey);
  if (text == picture.metadata.end())
    return Error{
        fmt::format("{}: does not say what its layers are ({}); make it by render --layers", file, kLayersKey)};
  Result<std::vector<LayerInfo>> layers = layersFromJson(text->second, fmt::format("{}: {}", file, kLayersKey));
  if (!layers) return Error{layers.error()};
  const auto isSights = [](const PictureLayer& l) { return l.channel == kSightsChannel; };
  MixHome home;
  home.layers = std::move(layers).value(), home.lightColour = lightColourIn(picture.metadata);
  if (const auto found = std::find_if(picture.layers.begin(), picture.layers.end(), isSights);
      found != picture.layers.end()) {
    for (const Vec3 p : found->image.pixels) {
      const bool shares = p.x >= 0 && p.y >= 0 && p.x + p.y <= 1.001f;
      if (!shares)
        return Error{fmt::format("{}: layer '{}' must hold shares of pixels from 0 to 1", file, kSightsChannel)};
      home.sights.section.push_back(p.x), home.sights.backdrop.push_back(p.y);
    }
    picture.layers.erase(found);
  }
  home.stack = makeLayerStack(picture.whole.width, picture.whole.height, picture.layers.size());
  picture.whole = {};
  if (home.layers.size() != picture.layers.size())
    return Error{fmt::format("{}: tells of {} layers and holds {}; render it again", file, home.layers.size(),
                             picture.layers.size())};
  for (size_t i = 0; i < home.layers.size(); ++i) {
    const auto layer = std::find_if(picture.layers.begin(), picture.layers.end(),
                                    [&](const PictureLayer& l) { return l.channel == home.layers[i].channel; });
    if (layer == picture.layers.end())
      return Error{fmt::format("{}: has no channels {}.R, .G and .B; render it again", file, home.layers[i].channel)};
    const bool sound = std::all_of(layer->image.pixels.begin(), layer->image.pixels.end(),
                                   [](Vec3 p) { return isFinite(p) && minComponent(p) >= 0; });
    if (!sound)
      return Error{
          fmt::format("{}: layer '{}' has light that is negative or not a finite number", file, home.layers[i].name)};
    setLayer(home.stack, i, unmixed(layer->image, home.sights));
    layer->image = {};
  }
  return home;
}

Result<Mixture> mixtureOf(const std::vector<LayerInfo>& layers, const DialOptions& options) {
  std::vector<Dial> dials(layers.size());
  if (options.kelvin) {
    const Result<Vec3> tint = tintOfKelvin(*options.kelvin);
    if (!tint) return Error{"--kelvin " + tint.error()};
    for (size_t i = 0; i < layers.size(); ++i) {
      if (isLamp(layers[i])) dials[i].tint = tint.value();
    }
  }
  for (const std::string& text : options.lamps) {
    if (const Status s = applyToLamps(layers, text, dials); !s) return Error{s.error()};
  }
  if (const Status s = applyToKind(layers, "sun", options.sun, dials); !s) return Error{s.error()};
  if (const Status s = applyToKind(layers, "sky", options.sky, dials); !s) return Error{s.error()};
  Mixture mixture;
  for (size_t i = 0; i < layers.size(); ++i) {
    const Result<Vec3> gain = gainOf(layers[i], dials[i]);
    if (!gain) return Error{gain.error()};
    mixture.gains.push_back(gain.value());
    mixture.hues.push_back(dials[i].tint.value_or(layers[i].colour));
  }
  return mixture;
}

ShownMix showMix(const MixHome& home, const Mixture& mixture, const Display& display, const FollowMix& follow) {
  ShownMix shown;
  Mixture unmixed;
  for (const LayerInfo& l : home.layers) unmixed.gains.push_back(Vec3(1)), unmixed.hues.push_back(l.colour);
  const std::vector<Vec3>& meteredGains = follow.exposure ? mixture.gains : unmixed.gains;
  Image metered = linearMix(home, meteredGains);
  shown.look.ev100 = ev100Of(display, metered);
  shown.look.tone = display.tone;
  shown.white = whiteOf(
      display, follow.white ? lightColourOf(home, mixture) : home.lightColour.value_or(lightColourOf(home, unmixed)));
  shown.look.whiteBalance = matrixOf(shown.white);
  if (!home.sights.section.empty())
    metered = mixLinear(home.stack, meteredGains);  // as layers are, without sections and backdrop
  for (Vec3& p : metered.pixels) p *= shown.white.gains;
  shown.edges = edgePixels(metered);
  shown.retouch = retouchOf(metered, display, shown.look.ev100);
  return shown;
}

bool isPlain(const ShownMix& shown) { return changesNothing(shown.retouch) && shown.edges.empty(); }

void applyLook(MixHome& home, const ShownMix& shown) {
  if (isPlain(shown)) return;
  const size_t count = home.layers.size();
  home.edges = shown.edges;
  home.sides = makeLayerStack(static_cast<int>(home.edges.size()), 3, count);
  std::vector<Vec3> alone(count);
  for (size_t i = 0; i < count; ++i) {
    alone[i] = Vec3(1);
    Image layer = mixLinear(home.stack, alone);
    alone[i] = {};
    const std::vector<EdgePixel> edges = edgesIn(layer, home.edges);
    if (!changesNothing(shown.retouch)) {
      retouch(layer, shown.retouch);
      setLayer(home.stack, i, layer);
    }
    if (!edges.empty()) setLayer(home.sides, i, sidesOf(edges, shown.retouch.gains, layer));
  }
}

Result<Assignment> splitAssignment(const std::string& option, const std::string& text) {
  const size_t equals = text.rfind('=');
  if (equals == std::string::npos || equals == 0)
    return Error{fmt::format("{} {}: write NAME=VALUE, for example \"Sofa lamp\"=60%", option, text)};
  return Assignment{text.substr(0, equals), text.substr(equals + 1)};
}

}  // namespace roomlight
