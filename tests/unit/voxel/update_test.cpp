// An update gives what voxelising from scratch gives, bit for bit, whatever moved.
#include <gtest/gtest.h>

#include "base/parallel.h"
#include "voxel_checks.h"

namespace roomlight {
namespace {

constexpr float kVoxelSizeM = 0.09f;

// A room whose twelve boxes move about, also out of it.
Scene furnishedRoom() {
  Scene scene;
  const int wall = test::addMaterial(scene, test::lambertian(0.7f)),
            wood = test::addMaterial(scene, test::lambertian(0.3f)),
            lamp = test::addMaterial(scene, test::lambertian(0.1f, 500));
  test::addRoom(scene, {0, 0, 0}, {4, 2.5f, 5}, std::vector<int>(6, wall));
  for (int i = 0; i < 12; ++i) {
    const float x = 0.3f * static_cast<float>(i);
    test::addBox(scene, {x, 0, x}, {x + 0.35f, 0.4f + 0.1f * x, x + 0.5f}, i % 4 ? wood : lamp);
  }
  return scene;
}

std::string differenceFromScratch(const Voxelisation& v, const Scene& scene, std::span<const uint8_t> hidden = {}) {
  return test::difference(v, voxelise(scene, test::withSize(v.voxels.voxelSizeM), hidden));
}

class Movers {
 public:
  explicit Movers(uint32_t seed) : random_(seed) {}
  float uniform(float lo, float hi) { return std::uniform_real_distribution<float>(lo, hi)(random_); }
  size_t below(size_t n) { return std::uniform_int_distribution<size_t>(0, n - 1)(random_); }
  Affine pose(float reachM) {
    return test::turned(uniform(0, 6), {uniform(-1, 1), 1, uniform(-1, 1)},
                        {uniform(-reachM, reachM), uniform(-reachM, reachM), uniform(-reachM, reachM)});
  }

 private:
  std::mt19937 random_;
};

TEST(VoxelUpdate, EqualsFromScratchOverRandomMovesHidesAndShows) {
  Scene scene = furnishedRoom();
  std::vector<uint8_t> hidden(scene.instances.size(), 0);
  Voxelisation v = voxelise(scene, test::withSize(kVoxelSizeM));
  Movers movers(11);
  for (int step = 0; step < 60; ++step) {
    std::vector<uint32_t> changed;
    for (size_t n = 1 + movers.below(4); n > 0; --n) {
      const size_t i = movers.below(scene.instances.size());
      changed.push_back(static_cast<uint32_t>(i));
      if (movers.below(3) == 0) {
        hidden[i] ^= 1;
      } else {
        scene.instances[i].worldFromObject = movers.pose(step % 5 == 0 ? 9.0f : 1.0f);
      }
    }
    update(v, scene, changed, hidden);
    ASSERT_EQ(differenceFromScratch(v, scene, hidden), "") << "step " << step;
  }
}

TEST(VoxelUpdate, OfAnInstanceThatLeavesTheBoundsMovesTheGrid) {
  Scene scene = furnishedRoom();
  Voxelisation v = voxelise(scene, test::withSize(kVoxelSizeM));
  const Voxelisation before = v;
  const uint32_t last = static_cast<uint32_t>(scene.instances.size()) - 1;
  scene.instances[last].worldFromObject.w = {-7, -3, -11};
  update(v, scene, std::span(&last, 1));
  EXPECT_LT(v.voxels.origin.x, before.voxels.origin.x);
  EXPECT_EQ(differenceFromScratch(v, scene), "");
  scene.instances[last].worldFromObject.w = {};
  update(v, scene, std::span(&last, 1));
  EXPECT_EQ(test::difference(v, before), "");
}

TEST(VoxelUpdate, TakesNewInstancesAtTheEnd) {
  Scene scene = furnishedRoom();
  Voxelisation v = voxelise(scene, test::withSize(kVoxelSizeM));
  const auto first = static_cast<uint32_t>(scene.instances.size());
  test::addRectangle(scene, {1, 1, 1}, {1, 0.2f, 0}, {0, 0.3f, 1}, 0);
  update(v, scene, std::span(&first, 1));
  EXPECT_EQ(differenceFromScratch(v, scene), "");
}

TEST(VoxelUpdate, OfNothingChangesNothing) {
  const Scene scene = furnishedRoom();
  Voxelisation v = voxelise(scene, test::withSize(kVoxelSizeM));
  const Voxelisation before = v;
  update(v, scene, {});
  EXPECT_EQ(test::difference(v, before), "");
}

TEST(VoxelUpdate, HidesAllAndShowsAll) {
  const Scene scene = furnishedRoom();
  const Voxelisation before = voxelise(scene, test::withSize(kVoxelSizeM));
  Voxelisation v = before;
  std::vector<uint32_t> all;
  for (uint32_t i = 0; i < scene.instances.size(); ++i) all.push_back(i);
  update(v, scene, all, std::vector<uint8_t>(all.size(), 1));
  EXPECT_TRUE(v.voxels.bricks.empty());
  EXPECT_TRUE(v.references.empty());
  update(v, scene, all);
  EXPECT_EQ(test::difference(v, before), "");
}

TEST(VoxelUpdate, CoarsensWhenAnInstanceFliesAwayAbsurdlyFar) {
  Scene scene = furnishedRoom();
  Voxelisation v = voxelise(scene, test::withSize(0.01f));
  const uint32_t last = static_cast<uint32_t>(scene.instances.size()) - 1;
  scene.instances[last].worldFromObject.w = {1e6f, 2e6f, -1e6f};
  update(v, scene, std::span(&last, 1));
  EXPECT_GT(v.voxels.voxelSizeM, 0.01f);
  EXPECT_EQ(differenceFromScratch(v, scene), "");
}

TEST(Voxelise, GivesTheSameBitsWithOneThreadAndTwo) {
  Scene scene = test::triangleSoup(3000, 5, 2);
  test::addRoom(scene, {-3, -3, -3}, {3, 3, 3}, std::vector<int>(6, 0));
  Voxelisation one, two;
  withThreads(1, [&] { one = voxelise(scene, test::withSize(0.05f)); });
  withThreads(2, [&] { two = voxelise(scene, test::withSize(0.05f)); });
  EXPECT_EQ(test::difference(one, two), "");
  const uint32_t first = 0;
  scene.instances[0].worldFromObject = test::turned(0.3f, {0, 1, 0}, {0.1f, 0.2f, 0});
  withThreads(1, [&] { update(one, scene, std::span(&first, 1)); });
  withThreads(2, [&] { update(two, scene, std::span(&first, 1)); });
  EXPECT_EQ(test::difference(one, two), "");
}

}  // namespace
}  // namespace roomlight
