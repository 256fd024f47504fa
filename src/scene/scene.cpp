#include "scene/scene.h"

namespace roomlight {

size_t Scene::triangleCount() const {
  size_t n = 0;
  for (const Instance& instance : instances) n += meshes[static_cast<size_t>(instance.mesh)].triangleCount();
  return n;
}

Bounds3 instanceBounds(const Scene& scene, const Instance& instance) {
  Bounds3 bounds;
  const Mesh& mesh = scene.meshes[static_cast<size_t>(instance.mesh)];
  for (const uint32_t index : mesh.indices) bounds.add(instance.worldFromObject.point(mesh.positions[index]));
  return bounds;
}

Bounds3 Scene::bounds() const {
  Bounds3 bounds;
  for (const Instance& instance : instances) bounds.add(instanceBounds(*this, instance));
  return bounds;
}

void addAreaLampMeshes(Scene& scene, size_t firstLamp) {
  int object = 0;
  for (const Instance& instance : scene.instances) object = std::max(object, instance.object + 1);
  for (size_t i = firstLamp; i < scene.lamps.size(); ++i) {
    const Lamp& lamp = scene.lamps[i];
    if (lamp.kind != LampKind::Area) continue;
    Material material;
    material.name = lamp.name;
    material.baseColor = Vec3(0);
    material.metallic = 0;
    material.specular = 0;
    material.emission = lamp.luminanceCdM2;
    scene.materials.push_back(material);

    // Counter-clockwise seen from the side the normal points to: right x up = direction.
    const Vec3 up = lamp.up * (lamp.heightM / 2);
    const Vec3 right = cross(lamp.up, lamp.direction) * (lamp.widthM / 2);
    Mesh mesh;
    mesh.name = lamp.name;
    mesh.positions = {lamp.position - right - up, lamp.position + right - up, lamp.position + right + up,
                      lamp.position - right + up};
    mesh.indices = {0, 1, 2, 0, 2, 3};
    mesh.material = static_cast<int>(scene.materials.size()) - 1;
    scene.meshes.push_back(mesh);
    scene.instances.push_back({lamp.name, static_cast<int>(scene.meshes.size()) - 1, object++, {}});
  }
}

Affine looking(Vec3 from, Vec3 forward) {
  const Vec3 back = -normalize(forward);
  const Vec3 side = cross({0, 1, 0}, back);
  const Vec3 right = length(side) > 1e-4f ? normalize(side) : Vec3{1, 0, 0};
  return {right, cross(back, right), back, from};
}

Camera defaultCamera(const Scene& scene) {
  if (!scene.cameras.empty()) return scene.cameras[static_cast<size_t>(scene.cameraInUse) % scene.cameras.size()];
  const Bounds3 bounds = scene.bounds();
  const Vec3 size = bounds.size(), centre = bounds.centre();
  const float eye = bounds.lo.y + std::min(1.6f, size.y * 0.6f);
  const Vec3 from{bounds.lo.x + 0.9f * size.x, eye, bounds.lo.z + 0.9f * size.z};
  Vec3 back = from - Vec3{centre.x, eye - 0.1f * size.y, centre.z};
  if (lengthSquared(back) == 0) back = {0, 0, 1};
  back = normalize(back);
  const Vec3 side = cross({0, 1, 0}, back);
  const Vec3 right = lengthSquared(side) > 0 ? normalize(side) : Vec3{1, 0, 0};
  Camera camera;
  camera.name = "default";
  camera.yFovRad = 1.05f;
  camera.worldFromCamera = {right, cross(back, right), back, from};
  return camera;
}

}  // namespace roomlight
