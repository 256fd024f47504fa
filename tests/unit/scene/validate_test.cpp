// What validate() lets through and what it names.
#include "scene/validate.h"

#include <gtest/gtest.h>

#include "support/rooms.h"

namespace roomlight {
namespace {

Scene oneRectangle() {
  Scene scene;
  test::addRectangle(scene, {-1, 0, -1}, {0, 0, 2}, {2, 0, 0}, test::addMaterial(scene, test::lambertian(0.5f)));
  scene.instances[0].name = "table";
  return scene;
}

void expectTooLarge(const Scene& scene) {
  const Status status = validate(scene);
  ASSERT_FALSE(status.ok());
  EXPECT_NE(status.error().find("instance 0 'table': its bounds in the world are not finite"), std::string::npos)
      << status.error();
}

TEST(Validate, plainSceneIsFine) {
  const Status status = validate(oneRectangle());
  EXPECT_TRUE(status.ok()) << status.error();
}

TEST(Validate, verticesThatATransformCarriesToInfinityAreNamed) {
  Scene scene = oneRectangle();
  for (Vec3& p : scene.meshes[0].positions) p *= 1e20f;
  scene.instances[0].worldFromObject.x = {1e20f, 0, 0};
  expectTooLarge(scene);
}

// Infinity less infinity is no number, which bounds pass over in silence.
TEST(Validate, sumsThatAreNoNumberAreNamed) {
  Scene scene = oneRectangle();
  for (Vec3& p : scene.meshes[0].positions) p *= 1e20f;
  scene.instances[0].worldFromObject.x = {1e20f, 0, 0};
  scene.instances[0].worldFromObject.z = {-1e20f, 0, 1};
  expectTooLarge(scene);
}

TEST(Validate, translationCanBeWhatIsTooMuch) {
  Scene scene = oneRectangle();
  for (Vec3& p : scene.meshes[0].positions) p *= 3e38f;
  EXPECT_TRUE(validate(scene).ok());
  scene.instances[0].worldFromObject.w = {3e38f, 0, 0};
  expectTooLarge(scene);
}

TEST(Validate, verticesThatNoTriangleUsesDoNotCount) {
  Scene scene = oneRectangle();
  scene.meshes[0].positions.push_back({3e38f, 0, 0});
  scene.instances[0].worldFromObject.x = {10, 0, 0};
  EXPECT_TRUE(validate(scene).ok());
}

}  // namespace
}  // namespace roomlight
