#include "baselines/scene_survey.h"

#include "base/parallel.h"
#include "trace/surface_point.h"

namespace roomlight {
bool isDoubleSided(const Scene& scene, const FaceSlot& slot) {
  return scene
      .materials[static_cast<size_t>(scene.meshes[static_cast<size_t>(scene.instances[slot.instance].mesh)].material)]
      .doubleSided;
}

bool isFront(const RayScene& rays, const FaceSlot& slot, float voxelSizeM) {
  const Ray ray{slot.position + slot.normal * (0.05f * voxelSizeM), -slot.normal, 0, 0.5f * voxelSizeM};
  const Hit hit = rays.intersect(ray);
  return !hit.valid() || placeAt(rays.scene(), hit, ray.direction).front;
}

std::vector<uint8_t> shownSides(const RayScene& rays, const Voxels& voxels) {
  std::vector<uint8_t> shown(voxels.slots.size());
  parallelFor(shown.size(), 1024, [&](size_t s) {
    const FaceSlot& slot = voxels.slots[s];
    shown[s] = isDoubleSided(rays.scene(), slot) || isFront(rays, slot, voxels.voxelSizeM);
  });
  return shown;
}

}  // namespace roomlight
