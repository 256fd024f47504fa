// A small room as a file, for tests that open one.
#pragma once

#include <fmt/format.h>

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "unit/temporary_folder.h"

namespace roomlight::testing {

// For studies of the room of writeRoom(): its floor with a target, to which a spacing may be added, and its ceiling
// with four places for a "Bulb".
constexpr const char* kHallZone = R"([[zone]]
room = "Hall"
floor = [[-2, -2], [-2, 2], [2, 2], [2, -2]]
ceiling = 3
mean = "60 lx"
)";
constexpr const char* kHallPlaces = R"([[place]]
name = "Ceiling"
on = "ceiling"
room = "Hall"
floor = [[-2, -2], [-2, 2], [2, 2], [2, -2]]
ceiling = 3
luminaires = ["Bulb"]
spacing = 1.5
fromWalls = 0.6
)";

// A closed white room of 4 x 3 x 4 m with a point light of 200 cd, a pillar and the cameras "Front" and "Back", as
// room.gltf and room.bin.
inline std::filesystem::path writeRoom(const TemporaryFolder& folder) {
  std::vector<float> positions;
  for (int i = 0; i < 8; ++i) {
    for (const int bit : {1, 2, 4}) positions.push_back(i & bit ? 0.5f : -0.5f);
  }
  const std::vector<uint16_t> indices = {0, 2, 1, 1, 2, 3, 4, 5, 6, 5, 7, 6, 0, 1, 4, 1, 5, 4,
                                         2, 6, 3, 3, 6, 7, 0, 4, 2, 2, 4, 6, 1, 3, 5, 3, 7, 5};
  std::string bytes(reinterpret_cast<const char*>(positions.data()), positions.size() * sizeof(float));
  bytes.append(reinterpret_cast<const char*>(indices.data()), indices.size() * sizeof(uint16_t));
  writeFile(folder / "room.bin", bytes);
  writeFile(folder / "room.gltf", fmt::format(R"({{
  "asset": {{"version": "2.0"}},
  "extensionsUsed": ["KHR_lights_punctual"],
  "extensions": {{"KHR_lights_punctual": {{"lights": [{{"name": "Bulb", "type": "point", "intensity": 200}}]}}}},
  "scene": 0,
  "scenes": [{{"nodes": [0, 1, 2, 3, 4]}}],
  "nodes": [
    {{"name": "Room", "mesh": 0, "scale": [4, 3, 4], "translation": [0, 1.5, 0]}},
    {{"name": "Pillar", "mesh": 0, "scale": [0.4, 2, 0.4], "translation": [0.8, 1, 0]}},
    {{"name": "Bulb", "translation": [0, 2.5, 0], "extensions": {{"KHR_lights_punctual": {{"light": 0}}}}}},
    {{"name": "Front", "camera": 0, "translation": [0, 1.5, 1.9]}},
    {{"name": "Back", "camera": 1, "translation": [0, 1.5, -1.9], "rotation": [0, 1, 0, 0]}}
  ],
  "cameras": [
    {{"name": "Front", "type": "perspective", "perspective": {{"yfov": 1.0, "znear": 0.01}}}},
    {{"name": "Back", "type": "perspective", "perspective": {{"yfov": 1.0, "znear": 0.01}}}}
  ],
  "materials": [{{"name": "White", "doubleSided": true,
    "pbrMetallicRoughness": {{"baseColorFactor": [0.7, 0.6, 0.5, 1], "metallicFactor": 0, "roughnessFactor": 1}}}}],
  "meshes": [{{"name": "Cube", "primitives": [{{"attributes": {{"POSITION": 0}}, "indices": 1, "material": 0}}]}}],
  "accessors": [
    {{"bufferView": 0, "componentType": 5126, "count": 8, "type": "VEC3", "min": [-0.5, -0.5, -0.5], "max": [0.5, 0.5, 0.5]}},
    {{"bufferView": 1, "componentType": 5123, "count": {0}, "type": "SCALAR"}}
  ],
  "bufferViews": [
    {{"buffer": 0, "byteOffset": 0, "byteLength": 96}},
    {{"buffer": 0, "byteOffset": 96, "byteLength": {1}}}
  ],
  "buffers": [{{"uri": "room.bin", "byteLength": {2}}}]
}})",
                                              indices.size(), indices.size() * sizeof(uint16_t), bytes.size()));
  return folder / "room.gltf";
}

}  // namespace roomlight::testing
