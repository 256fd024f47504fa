// Rays follow a scene in which things move.
#include "trace/ray_scene.h"

#include <gtest/gtest.h>

#include <cmath>
#include <utility>

#include "base/sampler.h"
#include "base/sampling.h"
#include "support/rooms.h"
#include "trace/surfaces.h"

namespace roomlight {
namespace {

// A room with two boxes.
Scene home() {
  Scene scene;
  const int white = test::addMaterial(scene, test::lambertian(0.7f));
  test::addRoom(scene, {0, 0, 0}, {4, 2.6f, 5}, std::vector<int>(6, white));
  test::addBox(scene, {0.5f, 0, 1}, {1.2f, 0.7f, 2.5f}, white);
  test::addBox(scene, {2.5f, 0, 1}, {3.5f, 0.7f, 2.5f}, white);
  return scene;
}

void expectSameHits(const RayScene& rays, const Scene& scene) {
  const RayScene anew(scene);
  std::vector<Ray> sent;
  for (uint32_t i = 0; i < 4000; ++i)
    sent.push_back({{2, 1.3f, 3.5f}, sampleSphere(Sampler(0, i, 0).next2()), 0, kInfinity});
  std::vector<Hit> hits(sent.size()), expected(sent.size());
  rays.intersect(sent, hits), anew.intersect(sent, expected);
  for (size_t i = 0; i < sent.size(); ++i) {
    ASSERT_EQ(hits[i].instance, expected[i].instance) << i;
    ASSERT_EQ(hits[i].triangle, expected[i].triangle) << i;
    ASSERT_EQ(hits[i].t, expected[i].t) << i;
    ASSERT_EQ(hits[i].ng, expected[i].ng) << i;
    ASSERT_EQ(rays.surfaces().at(hits[i], sent[i].direction).p, anew.surfaces().at(expected[i], sent[i].direction).p)
        << i;
  }
  EXPECT_EQ(rays.bounds().lo, anew.bounds().lo);
  EXPECT_EQ(rays.bounds().hi, anew.bounds().hi);
}

TEST(RaySceneUpdate, hitsAreThoseOfASceneMadeAnew) {
  Scene scene = home();
  RayScene rays(scene);
  rays.surfaces();
  std::vector<uint32_t> box;
  for (uint32_t i = 12; i < 18; ++i) box.push_back(i);
  for (const Vec3 by : {Vec3{0.3f, 0, 0.8f}, Vec3{-0.5f, 0.4f, 0}, Vec3{0, 9, 0}}) {
    for (const uint32_t i : box) scene.instances[i].worldFromObject.w += by;
    rays.update(box);
    expectSameHits(rays, scene);
  }
  // Another one joins it.
  scene.instances[6].worldFromObject.w.y += 1;
  rays.update(std::vector<uint32_t>{6});
  expectSameHits(rays, scene);
}

// Far from where its hierarchy was made.
TEST(RaySceneUpdate, aThingOfManyTrianglesTurns) {
  Scene scene = home();
  const auto ball = static_cast<uint32_t>(scene.instances.size());
  test::addSphere(scene, {0, 0, 0}, 0.6f, 0, 40);
  for (Vec3& p : scene.meshes.back().positions) p.y *= 0.2f;
  scene.instances[ball].worldFromObject.w = {2, 1.3f, 2};
  RayScene rays(scene);
  rays.surfaces();
  for (int i = 1; i <= 6; ++i) {
    const float angle = 0.6f * static_cast<float>(i), c = std::cos(angle), s = std::sin(angle);
    scene.instances[ball].worldFromObject = {{c, s, 0}, {-s, c, 0}, {0, 0, 1}, {2, 1.3f, 2}};
    rays.update(std::vector<uint32_t>{ball});
    expectSameHits(rays, scene);
  }
}

TEST(RaySceneUpdate, aMeshWithoutTrianglesHides) {
  Scene scene = home();
  scene.meshes.emplace_back();
  RayScene rays(scene);
  std::vector<uint32_t> box;
  for (uint32_t i = 12; i < 18; ++i) box.push_back(i);
  const Ray down{{3, 2, 2}, {0, -1, 0}, 0, kInfinity};
  EXPECT_FLOAT_EQ(rays.intersect(down).t, 1.3f);
  std::vector<int> meshes;
  for (const uint32_t i : box)
    meshes.push_back(std::exchange(scene.instances[i].mesh, static_cast<int>(scene.meshes.size()) - 1));
  rays.update(box);
  EXPECT_FLOAT_EQ(rays.intersect(down).t, 2);
  for (size_t k = 0; k < box.size(); ++k) scene.instances[box[k]].mesh = meshes[k];
  rays.update(box);
  expectSameHits(rays, scene);
}

// Nor does what has moved darken light where it was.
TEST(RaySceneUpdate, aPaneThatMovedLetsAllLightPassWhereItWas) {
  Scene scene = home();
  Material glass = test::lambertian(0.5f);
  glass.alphaMode = AlphaMode::Blend, glass.alpha = 0.5f;
  const auto pane = static_cast<uint32_t>(scene.instances.size());
  test::addRectangle(scene, {1, 1, 1}, {0, 0, 1}, {1, 0, 0}, test::addMaterial(scene, glass));
  RayScene rays(scene);
  const Ray before{{1.3f, 0.5f, 1.6f}, {0, 1, 0}, 0, 1}, after{{1.3f, 0.7f, 1.6f}, {0, 1, 0}, 0, 0.2f};
  EXPECT_FLOAT_EQ(rays.transmittance(before).x, 0.5f);
  scene.instances[pane].worldFromObject.w.y -= 0.2f;
  rays.update(std::vector<uint32_t>{pane});
  std::vector<Vec3> left(2);
  rays.transmittance(std::vector<Ray>{before, after}, left);
  for (const Vec3& l : left) EXPECT_FLOAT_EQ(l.x, 0.5f);
  EXPECT_FLOAT_EQ(rays.transmittance({{1.3f, 0.9f, 1.6f}, {0, 1, 0}, 0, 0.2f}).x, 1);
}

// A texture is read where it lets more through in some places; an opaque one leaves that to the material.
TEST(RayScene, blendedSurfacesLetThroughWhatTextureAndMaterialSay) {
  Scene scene;
  Texture opaque, half;
  opaque.width = half.width = 2, opaque.height = half.height = 1;
  opaque.rgba = {9, 99, 199, 255, 9, 99, 199, 255}, half.rgba = {9, 99, 199, 255, 9, 99, 199, 0};
  scene.textures = {opaque, half};
  const auto addCloth = [&](float z, int texture) {
    Material cloth = test::lambertian(0.5f);
    cloth.alphaMode = AlphaMode::Blend, cloth.alpha = 0.25f, cloth.baseColorTexture.texture = texture;
    test::addRectangle(scene, {0, 0, z}, {1, 0, 0}, {0, 1, 0}, test::addMaterial(scene, cloth));
    Mesh& mesh = scene.meshes.back();
    for (const Vec3& p : mesh.positions) mesh.uv[0].push_back({p.x, p.y});
  };
  addCloth(0, 0);
  addCloth(1, 1);
  const RayScene rays(scene);
  for (const float x : {0.25f, 0.75f}) {
    EXPECT_FLOAT_EQ(rays.transmittance({{x, 0.5f, -0.5f}, {0, 0, 1}, 0, 1}).x, 0.75f) << x;
    EXPECT_FLOAT_EQ(rays.transmittance({{x, 0.5f, 0.5f}, {0, 0, 1}, 0, 1}).x, x < 0.5f ? 0.75f : 1.0f) << x;
  }
}

}  // namespace
}  // namespace roomlight
