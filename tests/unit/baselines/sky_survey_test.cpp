#include "baselines/scene_survey.h"

#include <gtest/gtest.h>

#include "radiance/sky_guide.h"
#include "support/rooms.h"

namespace roomlight {
namespace {

// A room of 3 m with a window of 1 m in the wall that looks along -z.
Scene roomWithWindow() {
  Scene scene;
  const int wall = test::addMaterial(scene, test::lambertian(0.5f));
  const Vec3 x{3, 0, 0}, y{0, 3, 0}, z{0, 0, 3};
  test::addRectangle(scene, {}, y, z, wall);
  test::addRectangle(scene, x, z, y, wall);
  test::addRectangle(scene, {}, z, x, wall);
  test::addRectangle(scene, y, x, z, wall);
  test::addRectangle(scene, z, y, x, wall);
  test::addRectangle(scene, {0, 0, 0}, {1, 0, 0}, {0, 3, 0}, wall);
  test::addRectangle(scene, {2, 0, 0}, {1, 0, 0}, {0, 3, 0}, wall);
  test::addRectangle(scene, {1, 0, 0}, {1, 0, 0}, {0, 1, 0}, wall);
  test::addRectangle(scene, {1, 2, 0}, {1, 0, 0}, {0, 1, 0}, wall);
  scene.sky.luminanceCdM2 = Vec3(100);
  return scene;
}

TEST(SkySurvey, directionsThroughAWindowAreChosenMoreOften) {
  const Scene scene = roomWithWindow();
  const RayScene rays(scene);
  const Lights lights(scene);
  VoxelSettings settings;
  settings.voxelSizeM = 0.15f;
  const SkySurvey survey = surveySky({rays, lights}, settings, {8, 1});
  const Vec3 p{1.5f, 0, 1.5f}, n{0, 1, 0};
  const int32_t guide = guideAt(survey.guide, survey.voxels, p, n);
  ASSERT_GE(guide, 0);
  const Vec3 window = normalize(Vec3{1.5f, 1.5f, 0} - p), wall = normalize(Vec3{3, 1.5f, 1.5f} - p);
  EXPECT_GT(pdfSkyGuided(survey.guide, guide, lights, window), 4 * pdfSkyGuided(survey.guide, guide, lights, wall));
}

TEST(SkySurvey, withoutSkyThereIsNothingToSee) {
  Scene scene = roomWithWindow();
  scene.sky = {};
  const RayScene rays(scene);
  const Lights lights(scene);
  const SkySurvey survey = surveySky({rays, lights}, {}, {8, 1});
  EXPECT_TRUE(survey.guide.cdf.empty());
  EXPECT_EQ(guideAt(survey.guide, survey.voxels, {1.5f, 0, 1.5f}, {0, 1, 0}), -1);
}

}  // namespace
}  // namespace roomlight
