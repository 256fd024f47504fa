#include "home/cameras.h"

#include <gtest/gtest.h>

#include "home/rooms.h"
#include "support/furnished.h"
#include "trace/camera_rays.h"

namespace roomlight::home {
namespace {

struct Shares {
  double met = 0, tooNear = 0, oneToSix = 0;  // shares of the picture
};
Shares look(const RayScene& rays, const Camera& camera) {
  const CameraRays through(camera, 64, 36);
  Shares s;
  for (int y = 0; y < 36; ++y) {
    for (int x = 0; x < 64; ++x) {
      const Ray ray = through.ray(static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f);
      const Hit hit = rays.intersect(ray);
      if (!hit.valid()) continue;
      s.met += 1 / 2304.0;
      if (hit.t < 0.5f) s.tooNear += 1 / 2304.0;
      if (hit.t >= 1 && hit.t <= 6) s.oneToSix += 1 / 2304.0;
    }
  }
  return s;
}

TEST(Cameras, indoorsStandWhereTheRoomIsSeen) {
  const Scene scene = test::furnishedRoom();
  const RayScene rays(scene);
  const std::vector<Camera> cameras = proposeCameras(rays, findRooms(rays), true);
  ASSERT_EQ(cameras.size(), 3u);
  EXPECT_EQ(cameras[0].name, "Room 1");
  EXPECT_EQ(cameras[1].name, "Outside");
  EXPECT_EQ(cameras[2].name, "Plan");
  EXPECT_NEAR(cameras[0].worldFromCamera.w.y, 1.6, 0.01);
  EXPECT_NEAR(cameras[0].worldFromCamera.z.y, 0, 1e-5);  // level: lines stay upright
  const Shares s = look(rays, cameras[0]);
  EXPECT_EQ(s.tooNear, 0);
  EXPECT_GT(s.oneToSix, 0.8);
}

TEST(Cameras, ofASinglePieceFillThePicture) {
  const Scene scene = test::chair();
  const RayScene rays(scene);
  const std::vector<Camera> cameras = proposeCameras(rays, {}, true);
  ASSERT_EQ(cameras.size(), 1u);
  EXPECT_EQ(cameras[0].name, "Outside");
  const CameraRays through(cameras[0], 1600, 900);
  float low = 900, high = 0;
  const Bounds3 b = scene.bounds();
  for (int i = 0; i < 8; ++i) {
    const auto pixel = through.pixelOf({i & 1 ? b.hi.x : b.lo.x, i & 2 ? b.hi.y : b.lo.y, i & 4 ? b.hi.z : b.lo.z});
    ASSERT_TRUE(pixel);
    low = std::min(low, pixel->y), high = std::max(high, pixel->y);
  }
  EXPECT_GT(high - low, 0.75f * 900);
  EXPECT_NEAR(low, 900 - high, 60);
}

TEST(Cameras, lookIntoASmallBoxFromItsOpenSide) {
  Scene scene;
  const int grey = test::addMaterial(scene, test::lambertian(0.5f));
  test::addRoom(scene, {0, 0, 0}, {2, 2.1f, 2}, std::vector<int>(6, grey));
  scene.instances.pop_back();  // the side towards +z
  const RayScene rays(scene);
  const std::vector<Room> rooms = findRooms(rays);
  ASSERT_EQ(rooms.size(), 1u);
  const std::vector<Camera> cameras = proposeCameras(rays, rooms, true);
  EXPECT_LT(cameras[0].worldFromCamera.z.z, 1.01f);
  EXPECT_GT(cameras[0].worldFromCamera.z.z, 0.9f);
  EXPECT_GT(cameras[0].worldFromCamera.w.z, 1.5f);
}

TEST(Cameras, ofFilesThatSeeNothingAreKnown) {
  const Scene scene = test::furnishedRoom();
  const RayScene rays(scene);
  const std::vector<Room> rooms = findRooms(rays);
  Camera camera;
  camera.worldFromCamera = looking({4, 1.6f, 3.5f}, {-1, 0, -1});
  EXPECT_EQ(faultOf(rays, rooms, camera), "");
  camera.worldFromCamera = looking({4.8f, 1, 1.2f}, {1, 0, 0});
  EXPECT_EQ(faultOf(rays, rooms, camera), "stands in a wall or a thing");
  camera.worldFromCamera = looking({2.5f, 1.6f, 14}, {0, 0, -1});
  EXPECT_EQ(faultOf(rays, rooms, camera), "stands outside");
  camera.worldFromCamera = looking({2.5f, 1.6f, 14}, {0, 0, 1});
  EXPECT_EQ(faultOf(rays, rooms, camera), "sees nothing of the scene");
}

}  // namespace
}  // namespace roomlight::home
