// What is bright by reflection, sampled by place: against sums over all places, and light found by it against light
 // found by chance.
#include "radiance/bright_patches.h"

#include <gtest/gtest.h>

#include <cmath>

#include "radiance/light_cache.h"
#include "support/rooms.h"
#include "voxel/voxelise.h"

namespace roomlight {
namespace {

// A room that is open towards +z, where the sun comes in and falls on floor and wall; a table stands in it.
struct SunnyRoom {
  Scene scene;
  Voxels voxels;
  SunnyRoom() {
    const int white = test::addMaterial(scene, test::lambertian(0.7f)),
              wood = test::addMaterial(scene, test::lambertian(0.4f));
    test::addRoom(scene, {0, 0, 0}, {4, 2.6f, 5}, std::vector<int>(6, white));
    scene.meshes.pop_back(), scene.instances.pop_back();
    test::addBox(scene, {2.5f, 0, 1}, {3.5f, 0.7f, 2.5f}, wood);
    Sun sun;
    sun.toLight = normalize(Vec3{0.4f, 1, 0.9f}), sun.illuminanceLux = Vec3(50'000), sun.halfAngleRad = 0.0046f;
    scene.suns = {sun};
    VoxelSettings settings;
    settings.voxelSizeM = 0.1f;
    voxels = voxelise(scene, settings).voxels;
  }
};

RadianceField lit(const SunnyRoom& room, bool still, int links, uint64_t seed) {
  RadianceSettings settings;
  settings.pyramid = false, settings.still = still, settings.links = links, settings.seed = seed,
  settings.residual = 1e-4f;
  const RayScene rays(room.scene);
  return illuminate(rays, Lights(room.scene), room.voxels, settings);
}

double flux(const SunnyRoom& room, const RadianceField& field) {
  double sum = 0;
  for (size_t i = 0; i < field.irradianceLux.size(); ++i)
    sum += static_cast<double>((luminance(field.irradianceLux[i]) - field.sunLux[i]) * room.voxels.slots[i].areaM2);
  return sum;
}

TEST(BrightPatches, samplesAverageToTheSumOverAllPoints) {
  const SunnyRoom room;
  const RayScene rays(room.scene);
  const RadianceField field = lit(room, true, 8, 1);
  ASSERT_FALSE(field.sunPoints.empty());
  const BrightPatches patches(rays, room.voxels, field.sunPoints, {}, 0, 1);
  const Vec3 p{0.001f, 1.2f, 2}, n{1, 0, 0};
  double all = 0;
  for (const GlowPoint& g : field.sunPoints) {
    const Vec3 d = g.p - p;
    const float cosSurface = dot(d, n), cosLight = -dot(d, g.n);
    if (cosSurface > 0 && cosLight > 0)
      all += static_cast<double>(luminance(g.fluxLm) * cosSurface * cosLight /
                                 (kPi * lengthSquared(d) * lengthSquared(d)));
  }
  ASSERT_GT(all, 0);
  // Chosen by what a side sees, and by flux alone in the air.
  for (const int32_t side : {brickSideAt(room.voxels, p, n), -1}) {
    double sum = 0;
    constexpr uint32_t kCount = 40'000;
    for (uint32_t i = 0; i < kCount; ++i) {
      Sampler sampler(7, i, 3);
      const GlowSample g = patches.sample(p, n, side, sampler);
      if (g.light.valid()) sum += static_cast<double>(luminance(g.light.radiance) * dot(g.light.wi, n));
    }
    EXPECT_NEAR(sum / kCount / all, 1, 0.02) << side;
  }
}

TEST(BrightPatches, pointsAndRaysShareAllOfTheLight) {
  const SunnyRoom room;
  const RayScene rays(room.scene);
  const RadianceField field = lit(room, true, 8, 1);
  const BrightPatches patches(rays, room.voxels, field.sunPoints, {}, 0.2f, 1);
  const Vec3 p{0.001f, 1.2f, 2}, n{1, 0, 0};
  const int32_t side = brickSideAt(room.voxels, p, n);
  for (size_t i = 0; i < field.sunPoints.size(); i += 7) {
    const GlowPoint& g = patches.point(i);
    const Vec3 d = p - g.p;
    const float distance = length(d), cosLight = dot(d, g.n) / distance;
    if (cosLight <= 0.01f) continue;
    const float byPoints = BrightPatches::pointShare(patches.densityAt(i, p, side), 0.2f),
                byRays = patches.rayShare(g.slot, g.radianceCdM2, distance, cosLight, side, 0.2f);
    if (distance < 0.2f) {
      EXPECT_EQ(byPoints, 0);
    } else {
      EXPECT_NEAR(byPoints + byRays, 1, 1e-3f);
    }
  }
}

TEST(BrightPatches, sharesStayNumbersHoweverSmallAPatchIs) {
  const SunnyRoom room;
  const RayScene rays(room.scene);
  const Vec3 p{0.001f, 1.2f, 2}, n{1, 0, 0};
  for (const float flux : {1e-3f, 1e-20f, 1e-37f}) {
    RadianceField field = lit(room, true, 8, 1);
    for (GlowPoint& g : field.sunPoints) g.fluxLm = Vec3(flux);
    const BrightPatches patches(rays, room.voxels, field.sunPoints, {}, 0, 1);
    const int32_t side = brickSideAt(room.voxels, p, n);
    for (const float rayPdf : {0.0f, 0.2f, 1e30f}) {
      EXPECT_TRUE(std::isfinite(BrightPatches::pointShare(patches.densityAt(0, p, side), rayPdf)))
          << flux << ' ' << rayPdf;
      EXPECT_TRUE(
          std::isfinite(patches.rayShare(patches.point(0).slot, patches.point(0).radianceCdM2, 2, 0.01f, side, rayPdf)))
          << flux << ' ' << rayPdf;
    }
  }
}

// The last of four parts with the highest number below 1 rounds to 1, where nothing is known of the place as where
// something is.
TEST(BrightPatches, aNumberThatRoundsToOneChoosesThePatchBefore) {
  const SunnyRoom room;
  const RayScene rays(room.scene);
  const RadianceField field = lit(room, true, 8, 1);
  const BrightPatches patches(rays, room.voxels, field.sunPoints, {}, 0, 1);
  const Sampler highest(7, 14695416, 3);
  Sampler numbers = highest;
  numbers.next1();
  for (int i = 0; i < 5; ++i) numbers.fast1();
  ASSERT_EQ(3 + numbers.fast1(), 4);
  const Vec3 p{0.001f, 1.2f, 2}, n{1, 0, 0};
  for (const int32_t side : {brickSideAt(room.voxels, p, n), -1}) {
    Sampler sampler = highest;
    const BrightPatches::Candidates drawn = patches.draw(side, sampler);
    ASSERT_EQ(drawn.count, BrightPatches::Candidates::kMost);
    for (const uint32_t point : drawn.point) EXPECT_LT(point, field.sunPoints.size());
  }
}

TEST(BrightPatches, raysLeaveLightToPointsBesideThem) {
  const SunnyRoom room;
  const RayScene rays(room.scene);
  RadianceField field = lit(room, true, 8, 1);
  // Every second point of lamps' glow alone: slots without a point of their own are stood for by those beside them.
  std::vector<GlowPoint> points;
  for (size_t i = 0; i < field.sunPoints.size(); ++i) {
    if (field.sunPoints[i].slot / 2 % 2 == 0) points.push_back(field.sunPoints[i]), points.back().lamp = 0;
  }
  std::vector<float> glowShare(room.voxels.slots.size());
  for (const GlowPoint& g : field.sunPoints) glowShare[static_cast<size_t>(g.slot)] = 1;
  const BrightPatches patches(rays, room.voxels, points, glowShare, 0, 1);
  const int32_t side = brickSideAt(room.voxels, {0.001f, 1.2f, 2}, {1, 0, 0});
  ASSERT_TRUE(patches.reaches(side));
  size_t without = 0;
  for (const GlowPoint& g : field.sunPoints) {
    if (g.slot / 2 % 2 == 0) continue;
    ++without;
    EXPECT_LT(patches.rayShare(g.slot, g.radianceCdM2, 2, 0.5f, side, 0.01f), 0.9f);
    EXPECT_FALSE(patches.holdsSun(g.slot));
  }
  EXPECT_GT(without, 0u);
}

// With more than one sun rays find all of what they light, and so they do on polished metal.
TEST(BrightPatches, areOfOneSunAndNotOnMetal) {
  SunnyRoom room;
  room.scene.suns.push_back(room.scene.suns[0]);
  EXPECT_TRUE(lit(room, true, 8, 1).sunPoints.empty());
  room.scene.suns.pop_back();
  for (Material& m : room.scene.materials) m.metallic = 1, m.roughness = 0.1f;
  EXPECT_TRUE(lit(room, true, 8, 1).sunPoints.empty());
}

TEST(BrightPatches, lightByPlaceIsThatFoundByChance) {
  const SunnyRoom room;
  double byPlace = 0, byChance = 0;
  for (const uint64_t seed : {1u, 2u, 3u, 4u})
    byPlace += flux(room, lit(room, true, 16, seed)) / 4, byChance += flux(room, lit(room, false, 128, seed)) / 4;
  EXPECT_NEAR(byPlace / byChance, 1, 0.02);
}

}  // namespace
}  // namespace roomlight
