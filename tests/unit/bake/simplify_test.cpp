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

// Bumps of 1 mm on a board, which lies on something.
size_t trianglesLeft(float thicknessM) {
  Mesh board;
  constexpr uint32_t kSide = 20;
  for (uint32_t y = 0; y <= kSide; ++y) {
    for (uint32_t x = 0; x <= kSide; ++x)
      board.positions.push_back(
          {0.05f * static_cast<float>(x), (x + y) % 2 ? -0.001f : 0, 0.05f * static_cast<float>(y)});
  }
  board.positions.push_back({0, -thicknessM, 0});
  for (uint32_t y = 0; y < kSide; ++y) {
    for (uint32_t x = 0; x < kSide; ++x) {
      const uint32_t a = y * (kSide + 1) + x, b = a + kSide + 1;
      board.indices.insert(board.indices.end(), {a, b, a + 1, a + 1, b, b + 1});
    }
  }
  board.indices.insert(board.indices.end(), {0, 1, static_cast<uint32_t>(board.positions.size() - 1)});
  Scene scene;
  board.material = addMaterial(scene, lambertian(0.5f));
  scene.meshes = {board};
  scene.instances.resize(1), scene.instances[0].mesh = 0;
  simplifyMeshes(scene, 0.004f);
  return scene.meshes[0].triangleCount();
}

TEST(Simplify, movesThinThingsLess) { EXPECT_GT(trianglesLeft(0.01f), 2 * trianglesLeft(0.5f)); }

}  // namespace
}  // namespace roomlight::bake
