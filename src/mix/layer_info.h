// What the layers of a layered picture are: the header's JSON (docs/reference/layers.md) as plain data.
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

}  // namespace roomlight
