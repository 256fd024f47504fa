#include "engine/time_plan.h"

#include "base/progress.h"

namespace roomlight {

VoxelLight lightVoxels(const RayScene& rays, const Lights& lights, const VoxelSettings& voxel,
                       const RadianceSettings& radiance, Stages& stages) {
  VoxelLight out;
  out.voxels = stages.run("voxelise", [&](const Progress&) { return voxelise(rays.scene(), voxel).voxels; });
  out.field =
      stages.run("illuminate", [&](const Progress& p) { return illuminate(rays, lights, out.voxels, radiance, p); });
  return out;
}

VoxelLight lightVoxelsBefore(double seconds, const RayScene& rays, const Lights& lights, const VoxelSettings& voxel,
                             const RadianceSettings& radiance, Stages& stages) {
  const Stopwatch watch;
  VoxelLight out;
  out.voxels = stages.run("voxelise", [&](const Progress&) { return voxelise(rays.scene(), voxel).voxels; });
  out.field = stages.run("illuminate", [&](const Progress& p) {
    std::atomic<bool> over = watch.seconds() > seconds;
    Progress watched;
    watched.cancelled = &over;
    watched.report = [&](float fraction) {
      p.at(fraction);
      if (p.stop() || watch.seconds() > seconds) over = true;
    };
    return illuminate(rays, lights, out.voxels, radiance, watched);
  });
  return out;
}

void tellNumbers(const Voxels& voxels, const RadianceField& field, const GatheredPicture& picture, Stages& stages) {
  stages.number("voxelSizeM", static_cast<double>(voxels.voxelSizeM));
  stages.number("voxels", static_cast<double>(voxels.voxels.size()));
  stages.number("slots", static_cast<double>(voxels.slots.size()));
  stages.number("voxelMiB", static_cast<double>(voxels.bytes()) / 1048576);
  stages.number("radianceMiB", static_cast<double>(field.bytes()) / 1048576);
  stages.number("bounces", field.bounces);
  stages.number("residual", field.residual);
  if (!field.layers.empty()) {
    stages.number("layers", static_cast<double>(picture.layers.size()));
    stages.number("layersMiB", static_cast<double>(field.layers.bytes() + picture.layerBytes +
                                                   picture.layers.size() * picture.image.pixels.size() * sizeof(Vec3)) /
                                   1048576);
  }
  stages.number("samples", picture.samples);
  stages.number("rays", static_cast<double>(field.rays + picture.rays));
}

}  // namespace roomlight
