#include "scene/primitives.h"

#include <fmt/format.h>

#include <cmath>

namespace roomlight {

Material lambertian(float albedo, float emissionCdM2) {
  Material m;
  m.baseColor = Vec3(albedo);
  m.metallic = 0;
  m.roughness = 1;
  m.specular = 0;
  m.emission = Vec3(emissionCdM2);
  return m;
}

int addMaterial(Scene& scene, const Material& material) {
  scene.materials.push_back(material);
  return static_cast<int>(scene.materials.size()) - 1;
}

void addRectangle(Scene& scene, Vec3 corner, Vec3 u, Vec3 v, int material, int n) {
  Mesh mesh;
  mesh.material = material;
  for (int j = 0; j <= n; ++j) {
    for (int i = 0; i <= n; ++i) {
      mesh.positions.push_back(corner + u * (static_cast<float>(i) / static_cast<float>(n)) +
                               v * (static_cast<float>(j) / static_cast<float>(n)));
    }
  }
  for (int j = 0; j < n; ++j) {
    for (int i = 0; i < n; ++i) {
      const auto a = static_cast<uint32_t>(j * (n + 1) + i), b = a + 1, c = a + static_cast<uint32_t>(n) + 1, d = c + 1;
      for (const uint32_t k : {a, b, d, a, d, c}) mesh.indices.push_back(k);
    }
  }
  scene.meshes.push_back(mesh);
  scene.instances.push_back({fmt::format("rectangle {}", scene.instances.size()),
                             static_cast<int>(scene.meshes.size()) - 1,
                             static_cast<int>(scene.instances.size()),
                             {}});
}

void addRoom(Scene& scene, Vec3 lo, Vec3 hi, const std::vector<int>& materials) {
  const Vec3 s = hi - lo;
  const Vec3 x{s.x, 0, 0}, y{0, s.y, 0}, z{0, 0, s.z};
  addRectangle(scene, lo, y, z, materials[0]);
  addRectangle(scene, lo + x, z, y, materials[1]);
  addRectangle(scene, lo, z, x, materials[2]);
  addRectangle(scene, lo + y, x, z, materials[3]);
  addRectangle(scene, lo, x, y, materials[4]);
  addRectangle(scene, lo + z, y, x, materials[5]);
}

void addBox(Scene& scene, Vec3 lo, Vec3 hi, int material) {
  const Vec3 s = hi - lo;
  const Vec3 x{s.x, 0, 0}, y{0, s.y, 0}, z{0, 0, s.z};
  addRectangle(scene, lo, z, y, material);
  addRectangle(scene, lo + x, y, z, material);
  addRectangle(scene, lo, x, z, material);
  addRectangle(scene, lo + y, z, x, material);
  addRectangle(scene, lo, y, x, material);
  addRectangle(scene, lo + z, x, y, material);
}

namespace {

// `place(s, t)` with t up and s to the left as seen from the front; s and t from 0 to 1, in m and n steps.
template <class Place>
void addSheet(Scene& scene, const char* name, int material, int m, int n, const Place& place) {
  Mesh mesh;
  mesh.material = material;
  for (int j = 0; j <= n; ++j) {
    for (int i = 0; i <= m; ++i)
      mesh.positions.push_back(
          place(static_cast<float>(i % m) / static_cast<float>(m), static_cast<float>(j) / static_cast<float>(n)));
  }
  for (int j = 0; j < n; ++j) {
    for (int i = 0; i < m; ++i) {
      const auto a = static_cast<uint32_t>(j * (m + 1) + i), b = a + 1, c = a + static_cast<uint32_t>(m) + 1, d = c + 1;
      for (const uint32_t k : {a, d, b, a, c, d}) mesh.indices.push_back(k);
    }
  }
  scene.meshes.push_back(mesh);
  scene.instances.push_back({fmt::format("{} {}", name, scene.instances.size()),
                             static_cast<int>(scene.meshes.size()) - 1,
                             static_cast<int>(scene.instances.size()),
                             {}});
}

}  // namespace

void addSphere(Scene& scene, Vec3 centre, float radius, int material, int n) {
  addSheet(scene, "sphere", material, 2 * n, n, [&](float s, float t) {
    const float sine = std::sin(kPi * t);
    return centre + Vec3{sine * std::cos(2 * kPi * s), -std::cos(kPi * t), sine * std::sin(2 * kPi * s)} * radius;
  });
}

void addTube(Scene& scene, Vec3 base, float radius, float height, int material, int n) {
  addSheet(scene, "tube", material, n, 1, [&](float s, float t) {
    return base + Vec3{radius * std::cos(2 * kPi * s), height * t, radius * std::sin(2 * kPi * s)};
  });
}

Lamp pointLamp(Vec3 position, float candela) {
  Lamp lamp;
  lamp.position = position;
  lamp.intensityCd = Vec3(candela);
  return lamp;
}

}  // namespace roomlight
