#include "import/lighting_ground.h"

#include "import/lighting_values.h"
#include "scene/primitives.h"

namespace roomlight {
namespace {

constexpr int kCorners = 96;

}  // namespace

Ground readGround(const JsonPlace& j) {
  Ground ground;
  if (!j.isObject({"elevation", "centre", "radius", "reflectance"})) return ground;
  ground.centre.y = static_cast<float>(j["elevation"].number(-kFarthestM, kFarthestM));
  if (j.has("centre")) {
    const JsonPlace centre = j["centre"];
    if (!centre.isArray() || centre.arraySize() != 2) {
      centre.fail("must be [x, z]");
    } else {
      ground.centre.x = static_cast<float>(centre[size_t{0}].number(-kFarthestM, kFarthestM));
      ground.centre.z = static_cast<float>(centre[size_t{1}].number(-kFarthestM, kFarthestM));
    }
  }
  ground.radiusM = static_cast<float>(j["radius"].number(1e-3, kFarthestM));
  ground.reflectance = static_cast<float>(j.number("reflectance", 0, 1, 0.2));
  return ground;
}

void addGround(const Ground& ground, Scene& scene) {
  Mesh mesh;
  mesh.name = "Ground";
  mesh.material = addMaterial(scene, lambertian(ground.reflectance));
  scene.materials.back().name = "Ground";
  mesh.positions.push_back(ground.centre);
  for (int i = 0; i < kCorners; ++i) {
    const float angle = 2 * kPi * static_cast<float>(i) / kCorners;
    mesh.positions.push_back(ground.centre + Vec3{std::sin(angle), 0, std::cos(angle)} * ground.radiusM);
  }
  for (uint32_t i = 0; i < kCorners; ++i) mesh.indices.insert(mesh.indices.end(), {0, 1 + i, 1 + (i + 1) % kCorners});
  int object = 0;
  for (const Instance& instance : scene.instances) object = std::max(object, instance.object + 1);
  Instance instance;
  instance.name = mesh.name;
  instance.mesh = static_cast<int>(scene.meshes.size());
  instance.object = object;
  scene.meshes.push_back(std::move(mesh));
  scene.instances.push_back(std::move(instance));
}

}  // namespace roomlight
