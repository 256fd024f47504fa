// How bright and of what colour a layer shall be: "60%", "off", "100%,2700K", "#ffd080".
#pragma once

#include <string_view>

#include "mix/layer_info.h"

namespace roomlight {

struct Dial {
  std::optional<float> level;  // of luminous flux; 1: as rendered
  std::optional<Vec3> tint;    // linear Rec.709 of luminance 1
};

// Parts with commas between: on, off, a percentage from 0 to 1000, a temperature in K, #rrggbb (sRGB).
Result<Dial> parseDial(std::string_view text);

// The tint of a black body; an error outside kLowestKelvin..kHighestKelvin.
Result<Vec3> tintOfKelvin(double kelvin);

// What the layer's linear channels are multiplied by: its light in the new colour at the same luminous flux, dimmed. An
// error where its own light has next to nothing of a primary that the new colour needs: what was not rendered cannot be
// mixed.
Result<Vec3> gainOf(const LayerInfo& layer, const Dial& dial);

}  // namespace roomlight
