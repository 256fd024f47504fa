#include "roomlight/layers.h"

#include <fmt/format.h>

#include "conversions.h"

namespace roomlight::v1 {
namespace {

constexpr const char* kOfThisMix = "mix";

Result<Mixture> mixtureOf(const Layers::State& state, const Dials& dials) {
  DialOptions options;
  for (const auto& [name, dial] : dials.lamps) options.lamps.push_back(name + "=" + dial);
  options.kelvin = dials.kelvin;
  if (!dials.sun.empty()) options.sun = dials.sun;
  if (!dials.sky.empty()) options.sky = dials.sky;
  roomlight::Result<Mixture> mixture = roomlight::mixtureOf(state.home.layers, options);
  if (!mixture) return badInput(mixture.error());
  return std::move(mixture).value();
}

}  // namespace

Result<Layers> toPublic(roomlight::Result<MixHome> opened) {
  if (!opened) return badInput(opened.error());
  auto state = std::make_shared<Layers::State>();
  state->home = std::move(opened).value();
  for (const roomlight::LayerInfo& l : state->home.layers)
    state->list.push_back({l.name, l.kind, toPublic(l.colour), l.kelvin, l.fluxLm, l.room});
  return Layers(std::shared_ptr<const Layers::State>(std::move(state)));
}

Result<Layers> Layers::open(const std::string& file) {
  return guarded([&] { return toPublic(openLayers(file)); });
}

int Layers::width() const { return state_->home.stack.width; }
int Layers::height() const { return state_->home.stack.height; }
const std::vector<LayerInfo>& Layers::list() const { return state_->list; }

Result<std::vector<Vec3>> Layers::gains(const Dials& dials) const {
  return guarded([&]() -> Result<std::vector<Vec3>> {
    const Result<Mixture> mixture = mixtureOf(*state_, dials);
    if (!mixture) return mixture.error();
    std::vector<Vec3> gains;
    for (const roomlight::Vec3 g : mixture->gains) gains.push_back(toPublic(g));
    return gains;
  });
}

Result<Image> Layers::image(size_t layer) const {
  return guarded([&]() -> Result<Image> {
    if (layer >= state_->list.size())
      return badInput(fmt::format("layer {}: there are {}, numbered from 0", layer, state_->list.size()));
    std::vector<roomlight::Vec3> gains(state_->list.size());
    gains[layer] = roomlight::Vec3(1);
    return toPublic(linearMix(state_->home, gains));
  });
}

Result<Image> Layers::mix(const Dials& dials) const {
  return guarded([&]() -> Result<Image> {
    const Result<Mixture> mixture = mixtureOf(*state_, dials);
    if (!mixture) return mixture.error();
    return toPublic(linearMix(state_->home, mixture->gains));
  });
}

Result<DisplayImage> Layers::display(const Dials& dials, const DisplayOptions& options) const {
  return guarded([&]() -> Result<DisplayImage> {
    const Result<Mixture> mixture = mixtureOf(*state_, dials);
    if (!mixture) return mixture.error();
    DisplayOptions fixed = options;
    const FollowMix follow{fixed.exposure == kOfThisMix, fixed.whiteBalance == kOfThisMix};
    if (follow.exposure) fixed.exposure = "auto";
    if (follow.white) fixed.whiteBalance = "auto";
    const Result<Display> display = toInternal(fixed);
    if (!display) return display.error();
    const ShownMix shown = showMix(state_->home, *mixture, *display, follow);
    ByteImage bytes;
    if (isPlain(shown)) {
      bytes = displayMix(state_->home, mixture->gains, shown.look, true);
    } else {
      MixHome retouched = state_->home;
      applyLook(retouched, shown);
      bytes = displayMix(retouched, mixture->gains, shown.look, true);
    }
    return DisplayImage{bytes.width, bytes.height, bytes.channels, std::move(bytes.samples)};
  });
}

}  // namespace roomlight::v1
