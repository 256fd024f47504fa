#include "bake/simplify.h"

#include <gtest/gtest.h>

#include "support/rooms.h"

namespace roomlight::bake {
namespace {

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

// A ceiling whose normals lean outwards along its edge, as those of a box shaded smoothly do.
TEST(Simplify, aPlaneKeepsUprightNormals) {
  constexpr uint32_t kSide = 20;
  Mesh ceiling;
  for (uint32_t y = 0; y <= kSide; ++y) {
    for (uint32_t x = 0; x <= kSide; ++x) {
      const auto lean = [](uint32_t k) { return k == 0 ? -1.0f : k == kSide ? 1.0f : 0.0f; };
      ceiling.positions.push_back({0.2f * static_cast<float>(x), 0, 0.2f * static_cast<float>(y)});
      ceiling.normals.push_back(normalize(Vec3{lean(x), -1, lean(y)}));
    }
  }
  for (uint32_t y = 0; y < kSide; ++y) {
    for (uint32_t x = 0; x < kSide; ++x) {
      const uint32_t a = y * (kSide + 1) + x, b = a + kSide + 1;
      ceiling.indices.insert(ceiling.indices.end(), {a, a + 1, b, a + 1, b + 1, b});
    }
  }
  Scene scene;
  ceiling.material = addMaterial(scene, lambertian(0.5f));
  scene.meshes = {ceiling};
  scene.instances.resize(1), scene.instances[0].mesh = 0;
  simplifyMeshes(scene, 0.002f);
  const Mesh& mesh = scene.meshes[0];
  EXPECT_LT(mesh.triangleCount(), ceiling.triangleCount() / 4);
  EXPECT_EQ(mesh.normals.size(), mesh.positions.size());
  for (const uint32_t i : mesh.indices) EXPECT_LT(mesh.normals[i].y, -0.999f) << mesh.positions[i].x;
}

// Shaded smoothly.
Scene ball() {
  Scene scene;
  addSphere(scene, {0, 0, 0}, 0.1f, addMaterial(scene, lambertian(0.5f)));
  Mesh& mesh = scene.meshes[0];
  mesh.normals.clear();
  for (const Vec3 p : mesh.positions) mesh.normals.push_back(normalize(p));
  return scene;
}

// What is round stays as smooth as it was, but for single corners beside slivers.
TEST(Simplify, aBallKeepsItsNormals) {
  Scene scene = ball();
  Mesh& mesh = scene.meshes[0];
  const size_t vertices = mesh.positions.size(), triangles = mesh.triangleCount();
  simplifyMeshes(scene, 0.01f);
  EXPECT_LT(mesh.triangleCount(), triangles / 4);
  EXPECT_LE(mesh.positions.size(), vertices + vertices / 100);
}

// Leaves with normals of the crown, beside a ball that loses triangles.
TEST(Simplify, whatLosesNothingKeepsItsNormals) {
  Scene scene = ball();
  Mesh& mesh = scene.meshes[0];
  const Vec3 crown = normalize(Vec3(1, 1, 0));
  const auto first = static_cast<uint32_t>(mesh.positions.size());
  for (const Vec3 p : {Vec3(0.3f, 0, 0), Vec3(0.3f, 0, 0.1f), Vec3(0.4f, 0, 0.1f), Vec3(0.4f, 0, 0)})
    mesh.positions.push_back(p), mesh.normals.push_back(crown);
  for (const uint32_t i : {0, 1, 2, 0, 2, 3}) mesh.indices.push_back(first + i);
  const size_t triangles = mesh.triangleCount();
  EXPECT_GT(simplifyMeshes(scene, 0.01f)[0], 0);
  EXPECT_LT(mesh.triangleCount(), triangles);
  size_t leaves = 0;
  for (const uint32_t i : mesh.indices) {
    if (mesh.positions[i].x < 0.2f) continue;
    ++leaves;
    EXPECT_TRUE(mesh.normals[i] == crown);
  }
  EXPECT_EQ(leaves, 6u);
}

TEST(Simplify, movesThinThingsLess) { EXPECT_GT(trianglesLeft(0.01f), 2 * trianglesLeft(0.5f)); }

}  // namespace
}  // namespace roomlight::bake
