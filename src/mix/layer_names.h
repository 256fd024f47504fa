// Layers as people name them.
#pragma once

#include <string_view>

#include "mix/layer_info.h"

namespace roomlight {

// Indices into `layers`, of lamps alone. Tried in this order: the exact name or channel; the name in capital or small
// letters, if they are those of one name alone; a pattern with * (any text) and ? (any letter, of whatever bytes); the
// beginning of one single name. An error lists the lamps there are, or those the beginning fits.
Result<std::vector<size_t>> findLamps(const std::vector<LayerInfo>& layers, std::string_view wanted);

}  // namespace roomlight
