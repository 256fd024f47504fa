#include "bake/simplify.h"

#include <gtest/gtest.h>

#include "support/rooms.h"

namespace roomlight::bake {
namespace {

double areaOf(const Mesh& mesh) {
  double area = 0;
  for (size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
    const Vec3 a = mesh.positions[mesh.indices[i]];
    area += 0.5 * static_cast<double>(
                      length(cross(mesh.positions[mesh.indices[i + 1]] - a, mesh.positions[mesh.indices[i + 2]] - a)));
  }
  return area;
}

// A bulb 6 cm wide would lose a tenth of its area, and so of its flux.
TEST(Simplify, leavesWhatShines) {
  for (const float luminance : {0.0f, 1000.0f}) {
    Scene scene;
    addSphere(scene, {0, 0, 0}, 0.03f, addMaterial(scene, lambertian(0.5f, luminance)));
    const size_t triangles = scene.meshes[0].triangleCount();
    const double area = areaOf(scene.meshes[0]);
    simplifyMeshes(scene, 0.002f);
    if (luminance > 0) {
      EXPECT_EQ(scene.meshes[0].triangleCount(), triangles);
      EXPECT_EQ(areaOf(scene.meshes[0]), area);
    } else {
      EXPECT_LT(scene.meshes[0].triangleCount(), triangles / 2);
      EXPECT_LT(areaOf(scene.meshes[0]), 0.97 * area);
    }
  }
}

TEST(Simplify, leavesShadesOfLamps) {
  Scene scene;
  const int white = addMaterial(scene, lambertian(0.5f));
  addSphere(scene, {0, 0, 0}, 0.03f, addMaterial(scene, lambertian(0, 1000)));
  addSphere(scene, {0, 0, 0}, 0.1f, white);
  addSphere(scene, {3, 0, 0}, 0.1f, white);
  addSphere(scene, {6, 0, 0}, 0.1f, white);
  scene.lamps = {pointLamp({6, 0, 0}, 10)};
  std::vector<size_t> triangles;
  for (const Mesh& mesh : scene.meshes) triangles.push_back(mesh.triangleCount());
  simplifyMeshes(scene, 0.004f);
  for (const size_t i : {0, 1, 3}) EXPECT_EQ(scene.meshes[i].triangleCount(), triangles[i]) << i;
  EXPECT_LT(scene.meshes[2].triangleCount(), triangles[2]);
}

}  // namespace
}  // namespace roomlight::bake
