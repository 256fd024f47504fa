// Voxels and their light as bytes, bit by bit, for the program that wrote them: numbers as they lie in memory.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "engine/time_plan.h"
#include "trace/light_layers.h"

namespace roomlight {

std::string bytesOf(const VoxelLight& light);

// `layers`: those that the light was found with (RadianceSettings::layers); what they are is not in the bytes. None
// where these are not such bytes, to the last one.
std::optional<VoxelLight> voxelLightFrom(std::string_view bytes, const std::shared_ptr<const LightLayers>& layers);

}  // namespace roomlight
