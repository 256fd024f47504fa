// The lighting file: JSON with lamps, sun and sky in photometric units. Schema: docs/reference/lighting.md.
#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "base/result.h"
#include "scene/scene.h"

namespace roomlight {

// Reads the file and applies it to the scene: adds its lamps (Area lamps as emissive meshes too), suns and sky; where
// the file says so, switches off lights and emissive materials that the scene already has. Unknown keys, wrong types,
// missing units and values out of range are errors that name the file and the JSON path. The scene is untouched then.
// What was odd in photometric files goes to `warnings`, one line each.
Status applyLightingFile(const std::filesystem::path& file, Scene& scene, std::vector<std::string>* warnings = nullptr);

// The same of a document that was read, as that file.
Status applyLighting(const nlohmann::json& document, const std::filesystem::path& file, Scene& scene,
                     std::vector<std::string>* warnings = nullptr);

}  // namespace roomlight
