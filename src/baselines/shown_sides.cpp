#include "baselines/shown_sides.h"

#include "base/parallel.h"
#include "trace/surface_point.h"

namespace roomlight {
namespace {

bool isShown(const RayScene& rays, const FaceSlot& slot, float voxelSizeM) {
  const Scene& scene = rays.scene();
  if (scene.materials[static_cast<size_t>(scene.meshes[static_cast<size_t>(scene.instances[slot.instance].mesh)].material)].doubleSided) return true;
  const Ray ray{slot.position + slot.normal * (0.05f * voxelSizeM), -slot.normal, 0, 0.5f * voxelSizeM};
  const Hit hit = rays.intersect(ray);
  return !hit.valid() || placeAt(scene, hit, ray.direction).front;
}

}  // namespace

std::vector<uint8_t> shownSides(const RayScene& rays, const Voxels& voxels) {
  std::vector<uint8_t> shown(voxels.slots.size());
  parallelFor(shown.size(), 1024, [&](size_t s) { shown[s] = isShown(rays, voxels.slots[s], voxels.voxelSizeM); });
  return shown;
}

}  // namespace roomlight
