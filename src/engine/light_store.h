// Light that processes which render one home share: what one has found in its voxels the others read.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>

namespace roomlight {

class Lights;
class RayScene;
class Stages;
struct RadianceSettings;
struct Scene;
struct VoxelLight;
struct VoxelSettings;

// A folder that any number of processes may use at the same time.
struct LightStore {
  std::filesystem::path folder;
  uint64_t mostBytes = 2'000'000'000;  // of all that is kept; what was used longest ago goes first
  std::function<void(const std::string& line)> warn;  // of damaged files, and where nothing can be kept; may be empty
};

// The name of light in a store: hashes of this program, the scene, and all settings that light in voxels depends on.
std::string lightName(const Scene& scene, const VoxelSettings& voxel, const RadianceSettings& radiance);

// lightVoxels() where the store does not have it yet, bit by bit the same. Stage "light read"; where nothing was there
// to read also those of lightVoxels() and "light write". Waits for another process that is finding the same light.
VoxelLight sharedLight(const LightStore& store, const RayScene& rays, const Lights& lights, const VoxelSettings& voxel,
                       const RadianceSettings& radiance, Stages& stages);

}  // namespace roomlight
