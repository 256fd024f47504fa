// What the layers of a layered picture are: the header's JSON (docs/reference/layers.md) as plain data; how
// people name them, and how bright they shall be.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/result.h"
#include "base/vec.h"

namespace roomlight {

struct LayerInfo {
  std::string channel, name, kind;  // kind: lamp, group, mesh, sun or sky
  Vec3 colour{1, 1, 1};             // linear Rec.709 of its light; luminance 1 once read
  std::optional<Vec3> lightColour;  // what it gives surfaces in the picture, where the light of all has luminance 1
  std::optional<double> kelvin, fluxLm;
  std::string room;             // empty: none
  std::optional<Vec2> pixel;    // where it is in the picture: shares of width and height, from the top left
};

// Lamps are what people switch: everything but sun and sky.
bool isLamp(const LayerInfo& layer);

// The layer of a home that is cut open which is no light: of each pixel the shares of sections (R) and of the empty
// backdrop (G). The JSON names it as "sights".
inline constexpr const char* kSightsChannel = "sights";

// {"version": 1, "layers": [...]}; `where` begins the error's line.
Result<std::vector<LayerInfo>> layersFromJson(std::string_view text, const std::string& where);

// Layers as people name them. Indices into `layers`, of lamps alone. Tried in this order: the exact name or channel;
// the name in capital or small letters, if they are those of one name alone; a pattern with * (any text) and ? (any
// letter, of whatever bytes); the beginning of one single name. An error lists the lamps there are, or those the
// beginning fits.
Result<std::vector<size_t>> findLamps(const std::vector<LayerInfo>& layers, std::string_view wanted);

// How bright and of what colour a layer shall be: "60%", "off", "100%,2700K", "#ffd080".
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
