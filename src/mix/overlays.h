// One picture a lamp to be laid over the picture without lamps, for pages that switch lamps by CSS. Light adds up in
// linear units, but pages blend what is already encoded and tone-mapped: one lamp over the base is exact to rounding
// with every blend here, several are not.
#pragma once

#include <array>
#include <string_view>

#include "mix/mixer.h"

namespace roomlight {

enum class BlendMode { Screen, Normal, PlusLighter, Lighten };
inline constexpr std::array<BlendMode, 4> kBlendModes = {BlendMode::Screen, BlendMode::Normal, BlendMode::PlusLighter,
                                                         BlendMode::Lighten};
std::string_view cssName(
    BlendMode blend);  // of mix-blend-mode: W3C Compositing and Blending Level 1, plus-lighter of Level 2

// The overlay, with alpha, that turns `base` into `lit` where it is laid over with that blend. Only `normal` can darken
// a pixel.
ByteImage overlayOf(const ByteImage& base, const ByteImage& lit, BlendMode blend);

// Lays overlays in order over `base` as a browser does: opacities 0..1, one an overlay. Encoded values 0..255, not
// rounded.
std::vector<float> composite(const ByteImage& base, const std::vector<ByteImage>& overlays,
                             std::span<const float> opacities, BlendMode blend);

// How far overlays are from the true mix, in steps of 1/255 of the display, over states taken at random.
struct BlendError {
  double mean = 0, rms = 0, percentile99 = 0;
};
struct OverlayTrial {
  std::array<BlendError, kBlendModes.size()> errors;  // in the order of kBlendModes
  // What opacity shows a lamp at 0, 10, .. 100 % of its flux best (least squares over the base alone). The same for
  // every blend but lighten.
  std::vector<std::array<float, 11>> opacities;
};
// Of pixels spread over the picture, and of 64 states.
OverlayTrial tryOverlays(const LayerStack& stack, const Switches& switches, const Look& look);

}  // namespace roomlight
