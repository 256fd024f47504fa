#include "home/cameras.h"

#include <gtest/gtest.h>

#include "support/furnished.h"

namespace roomlight::home {
namespace {

// A row of furnished rooms, each 6 m from the next.
Scene rowOfRooms(int count) {
  Scene row;
  const Scene room = test::furnishedRoom();
  for (int i = 0; i < count; ++i) {
    for (const Instance& instance : room.instances) {
      Instance moved = instance;
      moved.mesh += static_cast<int>(row.meshes.size());
      moved.worldFromObject.w.x += 6 * static_cast<float>(i);
      row.instances.push_back(moved);
    }
    row.meshes.insert(row.meshes.end(), room.meshes.begin(), room.meshes.end());
    row.lamps.push_back(test::pointLamp({6 * static_cast<float>(i) + 2.5f, 2.2f, 2}, 60));
  }
  row.materials = room.materials;
  return row;
}

Camera inTheFirst() {
  Camera camera;
  camera.worldFromCamera = looking({4.4f, 1.6f, 3.5f}, {-1, 0, -0.9f});
  return camera;
}

TEST(Reach, leavesOutRoomsThatNoLightComesFrom) {
  const Scene row = rowOfRooms(30);
  const RayScene rays(row);
  const std::optional<Scene> near = withinReach(rays, {{inTheFirst()}});
  ASSERT_TRUE(near);
  EXPECT_LT(near->instances.size(), row.instances.size() / 5);
  EXPECT_LT(near->lamps.size(), 5u);
  // What is seen from there is the same.
  const RayScene left(*near);
  for (int i = 0; i < 400; ++i) {
    const float a = 0.1f * static_cast<float>(i), e = 0.02f * static_cast<float>(i % 60) - 0.6f;
    const Ray ray{{4.4f, 1.6f, 3.5f}, {std::cos(a) * std::cos(e), std::sin(e), std::sin(a) * std::cos(e)}, 0, 12};
    EXPECT_EQ(rays.intersect(ray).t, left.intersect(ray).t) << i;
  }
}

// A lamp in mid-air is on no ray's way.
TEST(Reach, keepsLampsInMidAir) {
  Scene row = rowOfRooms(30);
  row.lamps[0].position = {2.5f, 1.3f, 3};
  const RayScene rays(row);
  const std::optional<Scene> near = withinReach(rays, {{inTheFirst()}});
  ASSERT_TRUE(near);
  EXPECT_TRUE(std::any_of(near->lamps.begin(), near->lamps.end(), [](const Lamp& l) { return l.position.z == 3; }));
}

TEST(Reach, leavesHomesWhole) {
  const Scene home = rowOfRooms(3);
  const RayScene rays(home);
  EXPECT_FALSE(withinReach(rays, {{inTheFirst()}}));
}

// Buildings whose walls are one mesh are cut too.
TEST(Reach, cutsMeshes) {
  Scene row = rowOfRooms(30);
  Mesh all;
  all.material = row.meshes[0].material;
  for (const Instance& instance : row.instances) {
    const Mesh& mesh = row.meshes[static_cast<size_t>(instance.mesh)];
    for (const uint32_t i : mesh.indices) all.indices.push_back(i + static_cast<uint32_t>(all.positions.size()));
    for (const Vec3 p : mesh.positions) all.positions.push_back(instance.worldFromObject.point(p));
  }
  const size_t triangles = all.triangleCount();
  row.meshes = {all};
  row.instances = {{"building", 0, 0, {}}};
  const RayScene rays(row);
  const std::optional<Scene> near = withinReach(rays, {{inTheFirst()}});
  ASSERT_TRUE(near);
  EXPECT_LT(near->triangleCount(), triangles / 5);
  EXPECT_LT(near->meshes[0].positions.size(), all.positions.size() / 5);
}

}  // namespace
}  // namespace roomlight::home
