// What pictures show of a home gets all of its rays, what they do not a part.
#include "radiance/brick_importance.h"

#include <gtest/gtest.h>

#include "radiance/light_cache.h"
#include "support/rooms.h"
#include "voxel/voxelise.h"

namespace roomlight {
namespace {

// Two rooms side by side, 4 m apart, joined by nothing; a lamp in each.
class BrickImportance : public ::testing::Test {
 protected:
  BrickImportance() {
    const int grey = addMaterial(scene_, lambertian(0.5f));
    for (const float x : {0.0f, 8.0f}) {
      addRoom(scene_, {x, 0, 0}, {x + 4, 2.5f, 4}, std::vector<int>(6, grey));
      scene_.lamps.push_back(pointLamp({x + 2, 2, 2}, 100));
    }
    VoxelSettings settings;
    settings.voxelSizeM = 0.1f;
    voxels_ = voxelise(scene_, settings).voxels;
  }
  bool isSeen(size_t brick) const { return boundsOfBrick(voxels_, brick).centre().x < 6; }

  Scene scene_;
  const Camera camera_ = test::cameraAt({2, 1.2f, 3.5f});
  Voxels voxels_;
};

TEST_F(BrickImportance, allRaysWhereTheCameraIsAndAQuarterBesides) {
  const RayScene rays(scene_);
  const roomlight::BrickImportance importance(rays, voxels_, {&camera_, 1}, 0, {});
  size_t whole = 0, seen = 0;
  for (size_t b = 0; b < voxels_.bricks.size(); ++b) {
    if (isSeen(b)) {
      ++seen, whole += importance.raysOf(b, 8) == 8 ? 1 : 0;
    } else {
      EXPECT_EQ(importance.raysOf(b, 8), 2u);
      EXPECT_EQ(importance.raysOf(b, 1), 1u) << "never none";
    }
  }
  EXPECT_GT(seen, 50u);
  EXPECT_GT(whole, seen * 95 / 100);
}

TEST_F(BrickImportance, withoutCamerasAllAreAlike) {
  const RayScene rays(scene_);
  const roomlight::BrickImportance importance(rays, voxels_, {}, 0, {});
  for (size_t b = 0; b < voxels_.bricks.size(); ++b) EXPECT_EQ(importance.raysOf(b, 7), 7u);
}

// The light is the same, with fewer rays: where they are few, up to the noise of a seed.
TEST_F(BrickImportance, takesNoLight) {
  const RayScene rays(scene_);
  const Lights lights(scene_);
  constexpr int kSeeds = 8;
  const auto fluxes = [&](RadianceSettings settings, double(&lm)[2]) {
    uint64_t count = 0;
    for (settings.seed = 0; settings.seed < kSeeds; ++settings.seed) {
      const RadianceField field = illuminate(rays, lights, voxels_, settings);
      count += field.rays;
      for (size_t b = 0; b < voxels_.bricks.size(); ++b) {
        const auto [first, last] = slotsOfBrick(voxels_, b);
        for (size_t s = first; s < last; ++s)
          lm[isSeen(b)] += static_cast<double>(voxels_.slots[s].areaM2 * luminance(field.irradianceLux[s]));
      }
    }
    return count;
  };
  RadianceSettings settings;
  settings.still = true, settings.pyramid = false;
  double all[2] = {}, less[2] = {};
  const uint64_t before = fluxes(settings, all);
  settings.views = {camera_};
  EXPECT_LT(fluxes(settings, less), before * 8 / 10);
  EXPECT_NEAR(less[true] / all[true], 1, 0.001);
  EXPECT_NEAR(less[false] / all[false], 1, 0.005);
}

}  // namespace
}  // namespace roomlight
