// Openness of what a camera sees: a floor with a box on it, and a wall alone.
#include "gather/pixel_shader.h"

#include <gtest/gtest.h>

#include "support/rooms.h"
#include "trace/surface_point.h"

namespace roomlight {
namespace {

constexpr int kSide = 64;

// What each pixel's middle sees.
FilterInput seen(const RayScene& rays, const CameraRays& camera) {
  FilterInput out(kSide, kSide);
  for (int y = 0; y < kSide; ++y) {
    for (int x = 0; x < kSide; ++x) {
      const Ray ray = camera.ray(static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f);
      const Hit hit = rays.intersect(ray);
      if (!hit.valid()) continue;
      FilterPixel& p = out.at(x, y);
      const SurfacePoint s = surfaceAt(rays.scene(), hit, ray.direction);
      p.normal = s.ns * 4.0f, p.position = s.p * 4.0f, p.surface = 4;  // of four camera rays
    }
  }
  return out;
}

TEST(Openness, isLessBesideThingsAndWholeOnAPlainWall) {
  Scene scene;
  const int grey = test::addMaterial(scene, test::lambertian(0.5f));
  test::addRectangle(scene, {-10, -10, -4}, {20, 0, 0}, {0, 20, 0}, grey);
  test::addBox(scene, {-0.5f, -0.5f, -4}, {0.5f, 0.5f, -3.7f}, grey);
  const RayScene rays(scene);
  const CameraRays camera(test::cameraAt({0, 0, 0}), kSide, kSide);
  FilterInput pixels = seen(rays, camera);
  EXPECT_EQ(findOpenness(rays, camera, 1, pixels), 8u * kSide * kSide);
  // The box takes the middle 12 pixels or so of each row.
  double beside = 0, plain = 0, top = 0;
  for (int y = kSide / 2 - 4; y < kSide / 2 + 4; ++y)
    beside += static_cast<double>(pixels.at(kSide / 2 - 7, y).open + pixels.at(kSide / 2 + 6, y).open) / 16;
  for (int y = 0; y < kSide; ++y) plain += static_cast<double>(pixels.at(1, y).open) / kSide;
  for (int i = -3; i < 3; ++i) top += static_cast<double>(pixels.at(kSide / 2 + i, kSide / 2).open) / 6;
  EXPECT_GT(plain, 0.97);
  EXPECT_NEAR(top, 1, 1e-6);
  EXPECT_LT(beside, 0.85);
  EXPECT_GT(beside, 0.4);
}

TEST(Openness, isLeftAsItIsWhereNothingIsSeen) {
  Scene scene;
  test::addRectangle(scene, {100, 100, 100}, {1, 0, 0}, {0, 1, 0}, test::addMaterial(scene, test::lambertian(0.5f)));
  const RayScene rays(scene);
  FilterInput pixels(4, 4);
  EXPECT_EQ(findOpenness(rays, CameraRays(test::cameraAt({0, 0, 0}), 4, 4), 1, pixels), 0u);
  EXPECT_EQ(pixels.at(2, 2).open, 1);
}

}  // namespace
}  // namespace roomlight
