// Lights chosen by what a brick's side sees: against sums over all of them.
#include "radiance/seen_lights.h"

#include <gtest/gtest.h>

#include <cmath>

#include "support/light_densities.h"
#include "support/rooms.h"
#include "voxel/voxelise.h"

namespace roomlight {
namespace {

constexpr uint32_t kSamples = 40'000;

// Two rooms with a wall between; under each ceiling hang `perRoom` lamps and as many shining balls.
struct TwoRooms {
  Scene scene;
  Voxels voxels;
  explicit TwoRooms(int perRoom) {
    const int grey = test::addMaterial(scene, test::lambertian(0.5f)),
              shining = test::addMaterial(scene, test::lambertian(0, 2000));
    for (const float x : {0.0f, 3.2f}) {
      test::addRoom(scene, {x, 0, 0}, {3, 2.5f, 4}, std::vector<int>(6, grey));
      for (int i = 0; i < perRoom; ++i) {
        const float z = 4 * (static_cast<float>(i) + 0.5f) / static_cast<float>(perRoom);
        scene.lamps.push_back(test::pointLamp({x + 1, 2.1f, z}, 100));
        test::addSphere(scene, {x + 2, 2.1f, z}, 0.05f, shining, 8);
      }
    }
    test::addBox(scene, {1.2f, 0.9f, 1.5f}, {1.9f, 1.0f, 2.5f}, grey);  // shades a part of the floor
    VoxelSettings settings;
    settings.voxelSizeM = 0.1f;
    voxels = voxelise(scene, settings).voxels;
  }
};

struct Known {
  RayScene rays;
  Lights lights;
  SlotPaths paths;
  uint64_t count = 0;
  SeenLights seen;
  explicit Known(const TwoRooms& rooms)
      : rays(rooms.scene),
        lights(rooms.scene),
        paths(rays, rooms.voxels, 1, {}),
        seen(rays, lights, rooms.voxels, paths, 1, count) {}
};

double lux(const LightSample& light, Vec3 n) {
  return light.valid() ? static_cast<double>(luminance(light.radiance) * std::max(0.0f, dot(light.wi, n))) : 0;
}

const Vec3 kPlace{1.5f, 0.001f, 1.9f}, kUp{0, 1, 0};

TEST(SeenLights, samplesAverageToAllLights) {
  for (const int perRoom : {3, 40}) {
    const TwoRooms rooms(perRoom);
    const Known known(rooms);
    EXPECT_GT(known.count, 0u);
    const int32_t side = brickSideAt(rooms.voxels, kPlace, kUp);
    ASSERT_GE(side, 0);
    double lamps = 0, sampledLamps = 0, emitters = 0, sampledEmitters = 0;
    for (size_t i = 0; i < known.lights.lampCount(); ++i) lamps += lux(known.lights.sampleLamp(i, kPlace, {}), kUp);
    for (uint32_t k = 0; k < kSamples; ++k) {
      Sampler sampler(3, k, 0);
      sampledLamps += lux(known.seen.sampleLamps(known.lights, kPlace, side, sampler), kUp) / kSamples;
      const Vec2 u = sampler.next2();
      sampledEmitters += lux(known.seen.sampleEmitters(known.lights, kPlace, side, u, sampler.next1()), kUp) / kSamples;
      for (size_t i = 0; k < kSamples / 16 && i < known.lights.emitterCount(); ++i)
        emitters += lux(known.lights.sampleEmitter(i, kPlace, u, sampler.fast1()), kUp) / (kSamples / 16);
    }
    EXPECT_NEAR(sampledLamps, lamps, 0.03 * lamps) << perRoom;
    EXPECT_NEAR(sampledEmitters, emitters, 0.03 * emitters) << perRoom;
  }
}

// Spots and a sheet that light a small part of a brick, which rays from elsewhere in it say nothing of.
TEST(SeenLights, whatFewPlacesSeeIsNotLost) {
  TwoRooms rooms(0);
  for (const float x : {0.5f, 1.1f, 1.7f, 2.3f}) {
    Lamp spot = test::pointLamp({x, 2.45f, 2.0f}, 100);
    spot.kind = LampKind::Spot, spot.innerConeRad = 0.2f, spot.outerConeRad = 0.3f;
    rooms.scene.lamps.push_back(spot);
  }
  const Known known(rooms);
  for (float x = 0.05f; x < 3; x += 0.1f) {
    const Vec3 p{x, 0.001f, 2.0f};
    const int32_t side = brickSideAt(rooms.voxels, p, kUp);
    double all = 0, sampled = 0;
    for (size_t i = 0; i < known.lights.lampCount(); ++i) all += lux(known.lights.sampleLamp(i, p, {}), kUp);
    for (uint32_t k = 0; k < kSamples / 8; ++k) {
      Sampler sampler(3, k, 0);
      sampled += lux(known.seen.sampleLamps(known.lights, p, side, sampler), kUp) / (kSamples / 8);
    }
    EXPECT_NEAR(sampled, all, 0.05 * all) << x;
  }
}

// Many lamps of which a list holds few: what it leaves out has its share of the samples.
TEST(SeenLights, manyLampsHaveNoMoreNoiseThanUnseen) {
  TwoRooms rooms(0);
  for (int i = 0; i < 20; ++i) {
    for (int k = 0; k < 20; ++k)
      rooms.scene.lamps.push_back(
          test::pointLamp({0.1f + 0.14f * static_cast<float>(i), 2.4f, 0.1f + 0.19f * static_cast<float>(k)}, 100));
  }
  const Known known(rooms);
  const Vec3 p{0.6f, 0.001f, 0.9f};
  const int32_t side = brickSideAt(rooms.voxels, p, kUp);
  double seen = 0, seen2 = 0, blind = 0, blind2 = 0;
  for (uint32_t k = 0; k < kSamples; ++k) {
    Sampler a(3, k, 0), b(3, k, 0);
    const double s = lux(known.seen.sampleLamps(known.lights, p, side, a), kUp),
                 u = lux(known.lights.sampleLamps(p, b), kUp);
    seen += s, seen2 += s * s, blind += u, blind2 += u * u;
  }
  EXPECT_NEAR(seen, blind, 0.02 * blind);
  EXPECT_LT(seen2 / kSamples - std::pow(seen / kSamples, 2), 2 * (blind2 / kSamples - std::pow(blind / kSamples, 2)));
}

TEST(SeenLights, densityIsThatOfTheChoice) {
  for (const int perRoom : {3, 40}) {
    const TwoRooms rooms(perRoom);
    const Known known(rooms);
    const int32_t side = brickSideAt(rooms.voxels, kPlace, kUp);
    int compared = 0;
    for (uint32_t k = 0; k < 1000; ++k) {
      Sampler sampler(5, k, 0);
      const Vec2 u = sampler.next2();
      const LightSample s = known.seen.sampleEmitters(known.lights, kPlace, side, u, sampler.next1());
      compared += test::expectDensityOfItsPoint(
                      known.rays, kPlace, s,
                      [&](const SurfacePoint& q) { return known.seen.pdfEmitters(known.lights, kPlace, side, q); })
                      ? 1
                      : 0;
    }
    EXPECT_GT(compared, perRoom < 10 ? 300 : 30) << perRoom;  // many stand before one another
  }
}

TEST(SeenLights, whatAWallHidesIsSeldomChosen) {
  for (const int perRoom : {3, 40}) {
    const TwoRooms rooms(perRoom);
    const Known known(rooms);
    // Beside the wall, where lights of the other room are as near.
    const Vec3 p{2.9f, 0.001f, 2};
    const int32_t side = brickSideAt(rooms.voxels, p, kUp);
    int other = 0, otherBlindly = 0;
    for (uint32_t k = 0; k < 1000; ++k) {
      Sampler sampler(5, k, 0), same(5, k, 0);
      other += known.seen.sampleLamps(known.lights, p, side, sampler).lamp >= perRoom ? 1 : 0;
      otherBlindly += known.lights.sampleLamps(p, same).lamp >= perRoom ? 1 : 0;
    }
    EXPECT_GT(otherBlindly, 300) << perRoom;
    EXPECT_LT(other, otherBlindly / 3) << perRoom;
  }
}

// Of each lamp, as samples are divided by it.
TEST(SeenLights, chancesAreThoseOfTheChoiceAndAddUpToAll) {
  for (const int perRoom : {3, 40}) {
    const TwoRooms rooms(perRoom);
    const Known known(rooms);
    const int32_t side = brickSideAt(rooms.voxels, kPlace, kUp);
    std::vector<double> chance(known.lights.lampCount()), chosen(chance.size());
    for (uint32_t k = 0; k < kSamples; ++k) {
      Sampler sampler(3, k, 0);
      const LightSample s = known.seen.sampleLamps(known.lights, kPlace, side, sampler);
      const auto i = static_cast<size_t>(s.lamp);
      chosen[i] += 1.0 / kSamples;
      chance[i] =
          static_cast<double>(luminance(known.lights.sampleLamp(i, kPlace, {}).radiance) / luminance(s.radiance));
    }
    double sum = 0;
    for (size_t i = 0; i < chance.size(); ++i) {
      EXPECT_NEAR(chosen[i], chance[i], 0.01) << perRoom << ' ' << i;
      sum += chance[i];
    }
    EXPECT_NEAR(sum, 1, 0.005) << perRoom;
  }
}

TEST(SeenLights, knowsNothingOffTheSurfaces) {
  const TwoRooms rooms(3);
  const Known known(rooms);
  for (uint32_t k = 0; k < 100; ++k) {
    Sampler a(5, k, 0), b(5, k, 0);
    const LightSample known1 = known.seen.sampleLamps(known.lights, kPlace, -1, a),
                      blind = known.lights.sampleLamps(kPlace, b);
    EXPECT_EQ(known1.lamp, blind.lamp);
    EXPECT_EQ(known1.radiance, blind.radiance);
  }
  EXPECT_EQ(SeenLights().bytes(), 0u);
}

}  // namespace
}  // namespace roomlight
