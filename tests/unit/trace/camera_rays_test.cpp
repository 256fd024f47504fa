#include "trace/camera_rays.h"

#include <gtest/gtest.h>

#include "support/rooms.h"

namespace roomlight {
namespace {

Camera cameraOf(Projection projection) {
  Camera camera;
  camera.projection = projection;
  camera.worldFromCamera.w = {1, 2, 3};
  return camera;
}

void expectNear(Vec3 a, Vec3 b, float tolerance = 1e-6f) {
  EXPECT_LT(length(a - b), tolerance) << a.x << " " << a.y << " " << a.z;
}

TEST(CameraRays, panoramaLooksAllAround) {
  const CameraRays rays(cameraOf(Projection::Panorama), 400, 200);
  expectNear(rays.ray(200, 100).direction, {0, 0, -1});
  expectNear(rays.ray(300, 100).direction, {1, 0, 0});
  expectNear(rays.ray(100, 100).direction, {-1, 0, 0});
  expectNear(rays.ray(0, 100).direction, {0, 0, 1});
  expectNear(rays.ray(400, 100).direction, rays.ray(0, 100).direction);
  expectNear(rays.ray(123, 0).direction, {0, 1, 0});
  expectNear(rays.ray(321, 200).direction, {0, -1, 0});
  expectNear(rays.ray(250, 50).direction, {0.5f, std::sqrt(0.5f), -0.5f});  // 45 degrees right, 45 up
  expectNear(rays.ray(17, 71).origin, {1, 2, 3});
}

TEST(CameraRays, solidAnglesAddUp) {
  for (const Projection projection : {Projection::Panorama, Projection::StereoPanorama}) {
    const CameraRays rays(cameraOf(projection), 64, 32);
    double sum = 0;
    for (int y = 0; y < 32; ++y) {
      for (int x = 0; x < 64; ++x) sum += rays.solidAngleSr(x, y);
    }
    EXPECT_NEAR(sum, 4 * std::acos(-1.0) * (projection == Projection::StereoPanorama ? 2 : 1), 1e-9);
  }
  // A square view of 90 degrees is one face of a cube.
  Camera camera = cameraOf(Projection::Perspective);
  camera.yFovRad = kPi / 2;
  const CameraRays rays(camera, 256, 256);
  double sum = 0;
  for (int y = 0; y < 256; ++y) {
    for (int x = 0; x < 256; ++x) sum += rays.solidAngleSr(x, y);
  }
  EXPECT_NEAR(sum, 4 * std::acos(-1.0) / 6, 1e-5);
}

// The solid angle of a pixel is that of the rays through it: by how fast they turn.
TEST(CameraRays, solidAngleIsThatOfTheRays) {
  for (const Projection projection : {Projection::Panorama, Projection::Perspective}) {
    const CameraRays rays(cameraOf(projection), 100, 50);
    for (const auto& [x, y] : {std::pair{50, 25}, {3, 7}, {80, 44}}) {
      const auto at = [&](float u, float v) {
        return rays.ray(static_cast<float>(x) + u, static_cast<float>(y) + v).direction;
      };
      const float area = length(cross(at(1, 0.5f) - at(0, 0.5f), at(0.5f, 1) - at(0.5f, 0)));
      EXPECT_NEAR(static_cast<double>(area) / rays.solidAngleSr(x, y), 1, 0.01);
    }
  }
}

TEST(CameraRays, stereoEyesStandAsideOfWhereTheyLook) {
  const CameraRays rays(cameraOf(Projection::StereoPanorama), 200, 200);
  for (const float x : {0.0f, 33.0f, 100.0f, 150.0f}) {
    for (const float y : {20.0f, 50.0f, 90.0f}) {
      const Ray left = rays.ray(x, y), right = rays.ray(x, y + 100);
      expectNear(left.direction, right.direction);
      const Vec3 between = right.origin - left.origin;
      EXPECT_NEAR(length(between), 0.064f, 1e-6f);
      EXPECT_NEAR(dot(between, left.direction), 0, 1e-6f);
      EXPECT_EQ(between.y, 0);
      expectNear((left.origin + right.origin) * 0.5f, {1, 2, 3});
    }
  }
  // Looking along -z the right eye is at +x.
  expectNear(rays.ray(100, 150).origin, {1.032f, 2, 3});
  expectNear(rays.ray(150, 150).origin, {1, 2, 3.032f});
}

TEST(CameraRays, orthographicPixelsAreAsLargeAsSaid) {
  Camera camera = cameraOf(Projection::Orthographic);
  camera.yMagM = 2.5f;
  const CameraRays rays(camera, 200, 100);
  EXPECT_FLOAT_EQ(rays.metresPerPixel(), 0.05f);
  expectNear(rays.ray(11, 7).origin - rays.ray(10, 7).origin, {0.05f, 0, 0});
  expectNear(rays.ray(10, 8).origin - rays.ray(10, 7).origin, {0, -0.05f, 0});
  expectNear(rays.ray(100, 50).origin, {1, 2, 3});
}

TEST(CameraRays, pixelOfAPlaceIsWhereItsRayStarted) {
  for (const Projection projection : {Projection::Perspective, Projection::Orthographic, Projection::Panorama}) {
    const CameraRays rays(cameraOf(projection), 400, 200);
    for (const Vec2 at : {Vec2{200, 100}, Vec2{31, 45}, Vec2{399, 12}, Vec2{120, 188}}) {
      const Ray ray = rays.ray(at.x, at.y);
      const std::optional<Vec2> found = rays.pixelOf(ray.origin + ray.direction * 2.5f);
      ASSERT_TRUE(found);
      EXPECT_NEAR(found->x, at.x, 0.01f);
      EXPECT_NEAR(found->y, at.y, 0.01f);
    }
  }
  const CameraRays rays(cameraOf(Projection::Perspective), 400, 200);
  EXPECT_FALSE(rays.pixelOf(rays.ray(200, 100).origin - rays.ray(200, 100).direction)) << "behind the eye";
  EXPECT_FALSE(rays.pixelOf(rays.ray(500, 100).origin + rays.ray(500, 100).direction)) << "beside the picture";
}

TEST(CameraRays, raysKeepBelowTheCut) {
  Camera camera = cameraOf(Projection::Panorama);
  camera.cutHeightM = 1;  // the eye is above
  const CameraRays above(camera, 400, 200);
  const Ray down = above.ray(200, 150);
  expectNear(down.origin, {1, 1, 2});
  expectNear(down.direction, {0, -std::sqrt(0.5f), -std::sqrt(0.5f)});
  camera.cutHeightM = 2.5f;  // the eye is below
  const Ray up = CameraRays(camera, 400, 200).ray(200, 50);
  expectNear(up.origin, {1, 2, 3});
  EXPECT_NEAR(up.tMax, 0.5f * std::sqrt(2.0f), 1e-5f);
  EXPECT_EQ(CameraRays(camera, 400, 200).ray(200, 150).tMax, kInfinity);
}

// A tiled wall with a picture frame let into it, a single plane, air between two walls.
TEST(CameraRays, tellsWhatIsInsideOfBodies) {
  Scene scene;
  const int white = test::addMaterial(scene, test::lambertian(0.5f));
  test::addBox(scene, {0, 0, 0}, {5, 2.5f, 0.2f}, white);
  test::addBox(scene, {2, 1, 0.1f}, {2.4f, 1.4f, 0.23f}, white);
  test::addBox(scene, {0, 0, 0.2f}, {5, 2.5f, 0.204f}, white);  // tiles
  test::addBox(scene, {0, 0, 0.9f}, {5, 2.5f, 1.1f}, white);
  test::addRectangle(scene, {0, 0, -1}, {5, 0, 0}, {0, 2.5f, 0}, white);
  const RayScene rays(scene);
  for (const float x : {0.01f, 1.5f, 2.2f, 4.9f}) {
    for (const float z : {0.01f, 0.09f, 0.19f}) EXPECT_TRUE(insideBody(rays, {x, 1.2f, z})) << x << " " << z;
    for (const float z : {-1.5f, -1.01f, -0.5f, -0.01f, 0.3f, 0.85f, 1.3f})
      EXPECT_FALSE(insideBody(rays, {x, 1.2f, z})) << x << " " << z;
    EXPECT_FALSE(insideBody(rays, {x, 2.6f, 0.1f}));
  }
}

// Boxes that abut share the places of their ends: four walls around a room, and the corners between them.
TEST(CameraRays, cornersOfAbuttingWallsAreInside) {
  Scene scene;
  const int white = test::addMaterial(scene, test::lambertian(0.5f));
  test::addBox(scene, {-0.3f, 0, -0.3f}, {4.3f, 2.5f, 0}, white);
  test::addBox(scene, {-0.3f, 0, 3}, {4.3f, 2.5f, 3.3f}, white);
  test::addBox(scene, {-0.3f, 0, 0}, {0, 2.5f, 3}, white);
  test::addBox(scene, {4, 0, 0}, {4.3f, 2.5f, 3}, white);
  const RayScene rays(scene);
  for (const float x : {-0.15f, 0.1f, 2.0f, 3.9f, 4.15f}) {
    for (const float z : {-0.15f, 0.1f, 1.5f, 2.9f, 3.15f}) {
      const bool air = x > 0 && x < 4 && z > 0 && z < 3;
      EXPECT_EQ(insideBody(rays, {x, 1.2f, z}), !air) << x << " " << z;
    }
  }
  EXPECT_FALSE(insideBody(rays, {-0.5f, 1.2f, -0.15f}));
}

// The air of a room whose faces are turned the wrong way is no body.
TEST(CameraRays, roomsInsideOutAreNotFilled) {
  Scene scene;
  const int white = test::addMaterial(scene, test::lambertian(0.5f));
  test::addBox(scene, {0, 0, 0}, {3, 2.5f, 3}, white);
  EXPECT_FALSE(insideBody(RayScene(scene), {1.5f, 1.2f, 1.5f}));
}

// A pixel's width where it sees something, also from above a cut, across a stereo pair's halves and without
// perspective.
TEST(CameraRays, pixelWidths) {
  Camera camera;
  camera.worldFromCamera.w = {0, 2, 0};
  camera.yFovRad = 1;
  const CameraRays perspective(camera, 64, 64);
  EXPECT_NEAR(perspective.pixelWidthM(32, 32, {0, 2, -3}), 3 * 2 * std::tan(0.5f) / 64, 1e-3f);
  camera.cutHeightM = 1.5f;
  EXPECT_NEAR(CameraRays(camera, 64, 64).pixelWidthM(32, 32, {0, 2, -3}), 3 * 2 * std::tan(0.5f) / 64, 1e-3f);
  camera.projection = Projection::StereoPanorama;
  const CameraRays stereo(camera, 512, 512);
  for (const int y : {127, 128, 383})
    EXPECT_NEAR(stereo.pixelWidthM(10, y, {0, 2, -1.5f}), 1.5f * 2 * kPi / 512, 2e-3f) << y;
  camera.projection = Projection::Orthographic;
  const CameraRays flat(camera, 64, 64);
  EXPECT_EQ(flat.pixelWidthM(3, 4, {0, 0, -7}), flat.metresPerPixel());
}

}  // namespace
}  // namespace roomlight
