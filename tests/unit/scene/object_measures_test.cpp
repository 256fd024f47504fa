#include "scene/object_measures.h"

#include <gtest/gtest.h>

namespace roomlight {
namespace {

// A box from the origin; fronts look outwards.
Mesh box(Vec3 size) {
  Mesh mesh;
  for (int i = 0; i < 8; ++i)
    mesh.positions.push_back(Vec3(i & 1 ? size.x : 0, i & 2 ? size.y : 0, i & 4 ? size.z : 0));
  mesh.indices = {0, 2, 1, 1, 2, 3, 4, 5, 6, 5, 7, 6, 0, 1, 4, 1, 5, 4,
                  2, 6, 3, 3, 6, 7, 0, 4, 2, 2, 4, 6, 1, 3, 5, 3, 7, 5};
  return mesh;
}

TEST(ObjectMeasures, boxesHaveTheirAreasAndVolumes) {
  Scene scene;
  scene.meshes = {box({2, 3, 4})};
  Affine mirrored{{-1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {100, 0, 0}}, larger{{2, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, 50, 0}};
  scene.instances = {{"a", 0, 0, {}}, {"b", 0, 1, mirrored}, {"c", 0, 2, larger}};
  const std::vector<ObjectMeasures> m = measureObjects(scene);
  ASSERT_EQ(m.size(), 3u);
  for (size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(m[i].triangles, 12u);
    EXPECT_NEAR(m[i].volumeM3, 24, 1e-9);
    EXPECT_NEAR(m[i].areaUpM2, 8, 1e-9);
    EXPECT_NEAR(m[i].areaDownM2, 8, 1e-9);
    EXPECT_NEAR(m[i].areaUprightM2, 36, 1e-9);
    EXPECT_NEAR(m[i].netAreaM2, 52, 1e-9);
  }
  EXPECT_NEAR(m[2].volumeM3, 48, 1e-9);
  EXPECT_EQ(m[1].bounds.lo.x, 98);
  EXPECT_EQ(m[2].name, "c");
}

// Two boxes side by side as one object: the faces between them are hidden.
TEST(ObjectMeasures, facesBackToBackCancel) {
  Scene scene;
  scene.meshes = {box({2, 3, 4})};
  scene.instances = {{"pair", 0, 7, {}}, {"pair", 0, 7, {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {2, 0, 0}}}};
  const std::vector<ObjectMeasures> m = measureObjects(scene);
  ASSERT_EQ(m.size(), 1u);
  EXPECT_NEAR(m[0].areaM2(), 104, 1e-9);
  EXPECT_NEAR(m[0].netAreaM2, 80, 1e-9);
  EXPECT_NEAR(m[0].volumeM3, 48, 1e-9);
}

}  // namespace
}  // namespace roomlight
