// Sums of layers: light adds up, so any state of the lamps is one.
#pragma once

#include <span>

#include "base/byte_image.h"
#include "base/tone.h"
#include "mix/layer_stack.h"

namespace roomlight {

// How a mixed picture is shown (docs/reference/conventions.md, exposure and display).
struct Look {
  float ev100 = 0;
  Tone tone;
  Affine whiteBalance;  // linear Rec.709 to linear Rec.709; no translation
};

// The sum of layers times their gains, one gain a layer: linear, in the layers' unit.
Image mixLinear(const LayerStack& stack, std::span<const Vec3> gains);

// The same, white-balanced, exposed, tone-mapped, dithered and encoded in one pass over memory, which is what limits
// it: 9 bytes a pixel and layer.
ByteImage mixDisplay(const LayerStack& stack, std::span<const Vec3> gains, const Look& look);

}  // namespace roomlight
