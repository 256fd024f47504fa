#include "radiance/light_sources.h"

namespace roomlight {

EmissiveMesh::EmissiveMesh(const Scene& scene, uint32_t index) : instance(index) {
  const Instance& i = scene.instances[index];
  const Material& m = scene.materials[static_cast<size_t>(scene.meshes[static_cast<size_t>(i.mesh)].material)];
  mesh = i.mesh, texture = m.emissionTexture.texture, doubleSided = m.doubleSided, place = i.worldFromObject,
  emission = m.emission;
}

bool EmissiveMesh::shinesLike(const EmissiveMesh& o) const {
  if (instance != o.instance || mesh != o.mesh || texture != o.texture || doubleSided != o.doubleSided ||
      !(place == o.place))
    return false;
  for (int c = 0; c < 3; ++c) {
    if (emission[c] > 0 && !(o.emission[c] > 0)) return false;  // nothing to scale
  }
  return true;
}

Vec3 scaleBetween(Vec3 from, Vec3 to) {
  const auto scale = [](float a, float b) { return a > 0 ? b / a : 0; };
  return {scale(from.x, to.x), scale(from.y, to.y), scale(from.z, to.z)};
}

}  // namespace roomlight
