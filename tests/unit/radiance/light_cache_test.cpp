// A light cache brought up to date equals one made anew.
#include "radiance/light_cache.h"

#include <gtest/gtest.h>

#include <memory>

#include "base/parallel.h"
#include "support/rooms.h"
#include "voxel/voxelise.h"

namespace roomlight {
namespace {

// A room with a window in a wall, a table, a box of its own that moves, and two lamps.
struct Home {
  Scene scene;
  Voxelisation voxelisation;
  std::vector<uint32_t> box;  // instances

  explicit Home(bool sky = false) {
    const int white = test::addMaterial(scene, test::lambertian(0.7f)),
              wood = test::addMaterial(scene, test::lambertian(0.4f));
    test::addRoom(scene, {0, 0, 0}, {4, 2.6f, 5}, std::vector<int>(6, white));
    if (sky) scene.meshes.pop_back(), scene.instances.pop_back(), scene.sky.luminanceCdM2 = Vec3(500);
    test::addBox(scene, {2.5f, 0, 1}, {3.5f, 0.7f, 2.5f}, wood);
    const auto first = static_cast<uint32_t>(scene.instances.size());
    test::addBox(scene, {0.52f, 0.01f, 0.53f}, {1.03f, 0.57f, 1.04f}, wood);
    for (uint32_t i = first; i < scene.instances.size(); ++i) box.push_back(i);
    scene.lamps = {test::pointLamp({1.3f, 1.9f, 1.2f}, 80), test::pointLamp({3.1f, 2.45f, 4.1f}, 50)};
    VoxelSettings settings;
    settings.voxelSizeM = 0.1f;
    voxelisation = voxelise(scene, settings);
  }
  const Voxels& voxels() const { return voxelisation.voxels; }

  // Where the box is and was.
  std::vector<Bounds3> moveBox(Vec3 by) {
    std::vector<Bounds3> places;
    const auto note = [&] {
      Bounds3 place;
      for (const uint32_t i : box) place.add(voxelisation.instanceBounds[i]);
      places.push_back(place);
    };
    note();
    for (const uint32_t i : box) scene.instances[i].worldFromObject.w += by;
    roomlight::update(voxelisation, scene, box);
    note();
    return places;
  }
};

RadianceSettings exact() {
  RadianceSettings settings;
  settings.residual = 1e-5f;
  settings.pyramid = false;
  return settings;
}

LightCache lit(const Home& home, const RadianceSettings& settings = exact()) {
  return LightCache(RayScene(home.scene), Lights(home.scene), home.voxels(), settings);
}

void expectSame(const LightCache& a, const LightCache& b, float tolerance) {
  ASSERT_EQ(a.field().irradianceLux.size(), b.field().irradianceLux.size());
  for (size_t s = 0; s < a.field().irradianceLux.size(); ++s) {
    const float x = luminance(a.field().irradianceLux[s]), y = luminance(b.field().irradianceLux[s]);
    ASSERT_NEAR(x, y, tolerance * (y + 0.1f)) << s;
  }
}

TEST(Relight, scalesLampsThatStayWhereTheyAre) {
  Home home;
  const RayScene rays(home.scene);
  LightCache cache(rays, Lights(home.scene), home.voxels(), exact());
  home.scene.lamps[0].intensityCd = {10, 40, 90};
  cache.relight(rays, Lights(home.scene), home.voxels());
  EXPECT_EQ(cache.field().rays, 0u);
  expectSame(cache, LightCache(rays, Lights(home.scene), home.voxels(), exact()), 2e-3f);
}

TEST(Relight, remembersLampsSwitchedOff) {
  Home home;
  const RayScene rays(home.scene);
  const LightCache before = lit(home);
  LightCache cache(rays, Lights(home.scene), home.voxels(), exact());
  const Lamp lamp = home.scene.lamps[1];
  home.scene.lamps.pop_back();
  cache.relight(rays, Lights(home.scene), home.voxels());
  EXPECT_EQ(cache.field().rays, 0u);
  expectSame(cache, LightCache(rays, Lights(home.scene), home.voxels(), exact()), 2e-3f);
  home.scene.lamps.insert(home.scene.lamps.begin(), lamp);
  cache.relight(rays, Lights(home.scene), home.voxels());
  EXPECT_EQ(cache.field().rays, 0u);
  expectSame(cache, before, 2e-3f);
}

TEST(Relight, tracesOnlyTheLampThatMoved) {
  Home home;
  const RayScene rays(home.scene);
  LightCache cache(rays, Lights(home.scene), home.voxels(), exact());
  const uint64_t all = cache.field().rays;
  home.scene.lamps[1].position = {2.2f, 1.1f, 3.3f};
  cache.relight(rays, Lights(home.scene), home.voxels());
  EXPECT_GT(cache.field().rays, 0u);
  EXPECT_LT(cache.field().rays, all / 2);
  expectSame(cache, LightCache(rays, Lights(home.scene), home.voxels(), exact()), 2e-3f);
}

TEST(Relight, ofNothingAtAllIsDark) {
  Home home;
  const RayScene rays(home.scene);
  LightCache cache(rays, Lights(home.scene), home.voxels(), exact());
  home.scene.lamps.clear();
  cache.relight(rays, Lights(home.scene), home.voxels());
  for (const Vec3& e : cache.field().irradianceLux) ASSERT_LT(luminance(e), 0.1f);
}

// Particles of a lamp close to surfaces would come upon the box; this one has none.
Home withLampInTheAir() {
  Home home;
  home.scene.lamps = {test::pointLamp({2, 1.6f, 2.9f}, 80)};
  return home;
}

// Light straight from lamps does not start from what there was: bit for bit.
TEST(Update, directLightIsThatOfASceneLitAnew) {
  Home home = withLampInTheAir();
  RadianceSettings settings = exact();
  settings.maxBounces = 0;
  LightCache cache = lit(home, settings);
  const uint64_t all = cache.field().rays;
  const std::vector<Bounds3> places = home.moveBox({0.43f, 0, 0.71f});
  const RayScene rays(home.scene);
  cache.update(rays, Lights(home.scene), home.voxels(), places);
  EXPECT_LT(cache.field().rays, all * 3 / 4);
  const LightCache fresh = lit(home, settings);
  ASSERT_EQ(cache.field().irradianceLux.size(), fresh.field().irradianceLux.size());
  for (size_t s = 0; s < fresh.field().irradianceLux.size(); ++s) {
    for (int k = 0; k < 3; ++k) ASSERT_EQ(cache.field().irradianceLux[s][k], fresh.field().irradianceLux[s][k]) << s;
  }
}

TEST(Update, equalsASceneLitAnew) {
  Home home;
  LightCache cache = lit(home);
  for (const Vec3 by : {Vec3{0.43f, 0, 0.71f}, Vec3{0.2f, 0.3f, 2.1f}, Vec3{-6, 0, 0}, Vec3{5.2f, 0, 0.1f}}) {
    const std::vector<Bounds3> places = home.moveBox(by);
    const RayScene rays(home.scene);
    cache.update(rays, Lights(home.scene), home.voxels(), places);
    expectSame(cache, lit(home), 2e-3f);
  }
}

// Evening, a night without sun and sky, and noon again.

// A panel under the ceiling and a small glowing cube by the table, each with its own material.
struct GlowingHome : Home {
  int panel, cube;
  std::vector<uint32_t> panelAlone;  // instances
  GlowingHome() {
    scene.lamps.clear();
    panel = test::addMaterial(scene, test::lambertian(0, 300)),
    cube = test::addMaterial(scene, test::lambertian(0, 4000));
    test::addRectangle(scene, {1.2f, 2.5f, 2}, {0, 0, 1}, {-0.8f, 0, 0}, panel);
    panelAlone = {static_cast<uint32_t>(scene.instances.size() - 1)};
    test::addBox(scene, {3.02f, 1.2f, 3.61f}, {3.08f, 1.26f, 3.67f}, cube);
    VoxelSettings settings;
    settings.voxelSizeM = 0.1f;
    voxelisation = voxelise(scene, settings);
  }
  Vec3& emission(int material) { return scene.materials[static_cast<size_t>(material)].emission; }
};

RadianceSettings apart() {
  RadianceSettings settings = exact();
  settings.emittersApart = true;
  return settings;
}

TEST(Relight, dimsAndColoursEmissiveMeshesWithoutARay) {
  GlowingHome home;
  const RayScene rays(home.scene);
  LightCache cache(rays, Lights(home.scene), home.voxels(), apart());
  home.emission(home.panel) = {10, 40, 90};
  cache.relight(rays, Lights(home.scene), home.voxels());
  EXPECT_EQ(cache.field().rays, 0u);
  expectSame(cache, lit(home, apart()), 2e-3f);
  home.emission(home.panel) = {0, 40, 90};
  cache.relight(rays, Lights(home.scene), home.voxels());
  EXPECT_EQ(cache.field().rays, 0u);
  expectSame(cache, lit(home, apart()), 2e-3f);
}

TEST(Relight, remembersEmissiveMeshesSwitchedOff) {
  GlowingHome home;
  const RayScene rays(home.scene);
  const LightCache before = lit(home, apart());
  LightCache cache(rays, Lights(home.scene), home.voxels(), apart());
  home.emission(home.cube) = {};
  cache.relight(rays, Lights(home.scene), home.voxels());
  EXPECT_EQ(cache.field().rays, 0u);
  expectSame(cache, lit(home, apart()), 2e-3f);
  home.emission(home.cube) = Vec3(4000);
  cache.relight(rays, Lights(home.scene), home.voxels());
  EXPECT_EQ(cache.field().rays, 0u);
  expectSame(cache, before, 2e-3f);
}

// A colour that was not there when its light was traced cannot be scaled.
TEST(Relight, tracesAnEmissiveMeshThatTakesOnANewColour) {
  GlowingHome home;
  home.emission(home.panel) = {300, 300, 0};
  const RayScene rays(home.scene);
  LightCache cache(rays, Lights(home.scene), home.voxels(), apart());
  home.emission(home.panel) = {300, 300, 100};
  cache.relight(rays, Lights(home.scene), home.voxels());
  EXPECT_GT(cache.field().rays, 0u);
  expectSame(cache, lit(home, apart()), 2e-3f);
}

TEST(Relight, followsEmissiveMeshesThatAreLitTogether) {
  GlowingHome home;
  const RayScene rays(home.scene);
  LightCache cache(rays, Lights(home.scene), home.voxels(), exact());
  home.emission(home.panel) = Vec3(50);
  cache.relight(rays, Lights(home.scene), home.voxels());
  EXPECT_GT(cache.field().rays, 0u);
  expectSame(cache, lit(home), 3e-3f);  // half floats: 6e-4 a bounce at albedo 0.7 are 2e-3 of either
}

// Rays alone or together find the same light.
TEST(LightCache, emissiveMeshesApartGiveTheSameFlux) {
  const GlowingHome home;
  double flux[2] = {};
  for (const bool isApart : {false, true}) {
    const LightCache cache = lit(home, isApart ? apart() : exact());
    for (size_t s = 0; s < home.voxels().slots.size(); ++s)
      flux[isApart] += static_cast<double>(luminance(cache.field().irradianceLux[s]) * home.voxels().slots[s].areaM2);
  }
  EXPECT_NEAR(flux[1] / flux[0], 1, 0.005);
}

// A box moves; a lamp is dimmed at the same time, and then dimmed again without a ray.
TEST(Update, withEmissiveMeshesEqualsASceneLitAnew) {
  GlowingHome home;
  LightCache cache = lit(home, apart());
  float dimmed = 1;
  for (const Vec3 by : {Vec3{0.43f, 0, 0.71f}, Vec3{0.2f, 0.3f, 2.1f}}) {
    const std::vector<Bounds3> places = home.moveBox(by);
    home.emission(home.panel) *= 0.5f;
    const RayScene rays(home.scene);
    cache.update(rays, Lights(home.scene), home.voxels(), places);
    expectSame(cache, lit(home, apart()), 3e-3f);
    home.emission(home.cube) = Vec3(4000 * (dimmed *= 0.7f));
    cache.relight(rays, Lights(home.scene), home.voxels());
    EXPECT_EQ(cache.field().rays, 0u);
    expectSame(cache, lit(home, apart()), 3e-3f);
  }
}

// Whatever boxes have to do with is traced either way.
TEST(Update, leavesTheLightOfOtherEmissiveMeshesAsItIs) {
  uint64_t renewed[2] = {};  // of all rays, those for direct light of emissive meshes: per 1000
  for (const bool isApart : {false, true}) {
    GlowingHome home;
    RadianceSettings settings = isApart ? apart() : exact();
    LightCache cache = lit(home, settings);
    const uint64_t all = cache.field().rays;
    home.box = home.panelAlone;
    const std::vector<Bounds3> places = home.moveBox({0.61f, -0.31f, 0.43f});
    const RayScene rays(home.scene);
    cache.update(rays, Lights(home.scene), home.voxels(), places);
    renewed[isApart] = 1000 * cache.field().rays / all;
    expectSame(cache, lit(home, settings), 3e-3f);
  }
  EXPECT_LT(renewed[true], renewed[false]);
}

// Followed in steps, what has moved first sends a part of its particles; in the end all of them.
TEST(Update, particlesOfWhatMovedComeToAll) {
  GlowingHome home;
  RadianceSettings settings = apart();
  settings.bouncesAtOnce = 3;
  LightCache cache = lit(home, settings);
  home.box.assign(1, home.panelAlone[0] + 1);  // a side of the cube
  const std::vector<Bounds3> places = home.moveBox({0, 0.13f, 0});
  const RayScene rays(home.scene);
  cache.update(rays, Lights(home.scene), home.voxels(), places);
  EXPECT_FALSE(cache.settled());
  const uint64_t first = cache.field().rays;
  uint64_t more = 0;
  for (int k = 0; k < 20 && !cache.settled(); ++k) {
    cache.goOn(rays, Lights(home.scene), home.voxels());
    more += cache.field().rays;
  }
  EXPECT_TRUE(cache.settled());
  EXPECT_GT(first, 0u);
  EXPECT_GE(more, 4096u);
  expectSame(cache, lit(home, settings), 3e-3f);
  // One that was switched off before it sent all does not keep light from settling.
  home.emission(home.cube) = {};
  cache.relight(rays, Lights(home.scene), home.voxels());
  for (int k = 0; k < 20 && !cache.settled(); ++k) cache.goOn(rays, Lights(home.scene), home.voxels());
  EXPECT_TRUE(cache.settled());
}

// Dimmed before it sent all: the rest is of how it shines now.
TEST(Update, particlesOfWhatMovedAndWasDimmedAreThoseOfASceneLitAnew) {
  GlowingHome home;
  RadianceSettings settings = apart();
  settings.bouncesAtOnce = 3;
  LightCache cache = lit(home, settings);
  home.box.assign(1, home.panelAlone[0] + 1);
  const std::vector<Bounds3> places = home.moveBox({0, 0.13f, 0});
  const RayScene rays(home.scene);
  cache.update(rays, Lights(home.scene), home.voxels(), places);
  const auto settle = [&](const char* when) {
    for (int k = 0; k < 20 && !cache.settled(); ++k) cache.goOn(rays, Lights(home.scene), home.voxels());
    EXPECT_TRUE(cache.settled()) << when;
    expectSame(cache, lit(home, settings), 3e-3f);
  };
  home.emission(home.cube) = Vec3(400);
  cache.relight(rays, Lights(home.scene), home.voxels());
  settle("dimmed");
  home.emission(home.cube) = Vec3(800);
  cache.relight(rays, Lights(home.scene), home.voxels());
  settle("brighter again");
}

TEST(Update, lampsThatWereLeftDarkAreNotTracedToTheEnd) {
  Home home;
  RadianceSettings settings = exact();
  settings.bouncesAtOnce = 3;
  LightCache cache = lit(home, settings);
  const RayScene rays(home.scene);
  for (const float x : {1.1f, 1.7f, 2.3f}) {
    home.scene.lamps[0].position = {x, 2.55f, 3.6f};
    cache.relight(rays, Lights(home.scene), home.voxels());
  }
  home.scene.lamps.erase(home.scene.lamps.begin());
  cache.relight(rays, Lights(home.scene), home.voxels());
  for (int k = 0; k < 20 && !cache.settled(); ++k) {
    cache.goOn(rays, Lights(home.scene), home.voxels());
    EXPECT_EQ(cache.field().rays, 0u);
  }
  EXPECT_TRUE(cache.settled());
}

TEST(FollowDaylight, equalsASceneLitAnew) {
  Home home(true);
  const auto light = [&](const Sun& sun, float skyCdM2) {
    home.scene.suns.clear();
    if (!isBlack(sun.illuminanceLux)) home.scene.suns.push_back(sun);
    home.scene.sky.luminanceCdM2 = Vec3(skyCdM2);
  };
  const Sun noon{"noon", normalize(Vec3(0.2f, 0.9f, 1.5f)), Vec3(60000), 0.0047f},
      evening{"evening", normalize(Vec3(-0.6f, 0.3f, 1)), Vec3(9000, 7000, 4000), 0.0047f};
  light(noon, 3000);
  LightCache cache = lit(home);
  const LightCache first = lit(home);
  for (const auto& [sun, sky] : {std::pair(evening, 800.0f), {Sun(), 0.0f}, {noon, 3000.0f}}) {
    light(sun, sky);
    const RayScene rays(home.scene);
    cache.followDaylight(rays, Lights(home.scene), home.voxels());
    const LightCache fresh = lit(home);
    EXPECT_EQ(cache.field().guide.cdf, fresh.field().guide.cdf);
    EXPECT_EQ(cache.field().sunLux, fresh.field().sunLux);
    EXPECT_LT(cache.field().rays, first.field().rays * 7 / 10);
    expectSame(cache, fresh, 3e-3f);
  }
  expectSame(cache, first, 3e-3f);
}

// The guide to the sky keeps what other links taught it: the same but for noise.
TEST(Update, underASkyEqualsASceneLitAnewButForNoise) {
  Home home(true);
  LightCache cache = lit(home);
  const std::vector<Bounds3> places = home.moveBox({0.43f, 0, 0.71f});
  const RayScene rays(home.scene);
  cache.update(rays, Lights(home.scene), home.voxels(), places);
  const LightCache fresh = lit(home);
  double a = 0, b = 0;
  for (size_t s = 0; s < fresh.field().irradianceLux.size(); ++s) {
    const double area = static_cast<double>(home.voxels().slots[s].areaM2);
    a += area * static_cast<double>(luminance(cache.field().irradianceLux[s])),
        b += area * static_cast<double>(luminance(fresh.field().irradianceLux[s]));
  }
  EXPECT_NEAR(a, b, 0.01 * b);
}

// Bounces spread over updates come to the same end.
TEST(Update, bouncesFewAtOnceGoOnUntilTheyAreSettled) {
  Home home;
  RadianceSettings few = exact();
  few.bouncesAtOnce = 3;
  LightCache cache = lit(home, few);
  EXPECT_TRUE(cache.settled());
  const std::vector<Bounds3> places = home.moveBox({0.43f, 0, 0.71f});
  const RayScene rays(home.scene);
  cache.update(rays, Lights(home.scene), home.voxels(), places);
  EXPECT_FALSE(cache.settled());
  EXPECT_EQ(cache.field().bounces, 3);
  int updates = 0;
  for (; !cache.settled() && updates < 30; ++updates) cache.goOn(rays, Lights(home.scene), home.voxels());
  EXPECT_GT(updates, 1);
  expectSame(cache, lit(home), 3e-3f);
}

// Lit together lamps are chosen among, and their particles are few and kept together: the same light as each for
// itself.
TEST(LightCache, manyLampsTogetherGiveTheSameLight) {
  Home home;
  home.scene.lamps.clear();
  for (int i = 0; i < 80; ++i) {
    home.scene.lamps.push_back(
        test::pointLamp({0.2f + 0.4f * static_cast<float>(i % 10), 2.3f, 0.3f + 0.6f * static_cast<float>(i / 10)}, 5));
    home.scene.lamps.back().intensityCd *= Vec3(1, 0.9f, i % 2 ? 0.2f : 0.9f);
  }
  double flux[2] = {}, glow[2] = {};
  std::vector<std::vector<Vec3>> lux;
  for (const bool together : {false, true}) {
    RadianceSettings settings = exact();
    settings.still = together;
    for (const int threads : {1, 3}) {
      withThreads(threads, [&] {
        const LightCache cache = lit(home, settings);
        EXPECT_EQ(cache.lampsApart(Lights(home.scene)), !together);
        lux.push_back(cache.field().irradianceLux);
        if (threads > 1) return;
        for (size_t s = 0; s < lux.back().size(); ++s)
          flux[together] += static_cast<double>(luminance(lux.back()[s]) * home.voxels().slots[s].areaM2);
        for (const GlowPoint& g : cache.field().glow.points()) {
          glow[together] += static_cast<double>(luminance(g.fluxLm));
          EXPECT_GE(g.lamp, 0);
        }
      });
    }
  }
  EXPECT_NEAR(flux[1] / flux[0], 1, 0.01);
  EXPECT_NEAR(glow[1] / glow[0], 1, 0.02);
  EXPECT_TRUE(lux[2] == lux[3]);
}

TEST(HasSurfaces, onlyBesideThem) {
  const Home home;
  const auto has = [&](Vec3 at) {
    return hasSurfaces(home.voxels(), LightSurroundings(test::pointLamp(at, 1), home.voxels().voxelSizeM));
  };
  EXPECT_TRUE(has({0.3f, 1.5f, 3}));
  EXPECT_TRUE(has({2, 2.3f, 4}));
  EXPECT_FALSE(has({2, 1.3f, 4}));
  EXPECT_FALSE(has({20, 1.3f, 4}));
}

TEST(LightCache, sameBitsWithAnyNumberOfThreads) {
  std::vector<std::vector<Vec3>> results;
  for (const int threads : {1, 2}) {
    withThreads(threads, [&] {
      Home home(true);
      LightCache cache = lit(home, {});
      const std::vector<Bounds3> places = home.moveBox({0.43f, 0, 0.71f});
      home.scene.lamps[1].position = {2.2f, 1.1f, 3.3f};
      const RayScene rays(home.scene);
      cache.update(rays, Lights(home.scene), home.voxels(), places);
      home.scene.lamps[0].intensityCd *= 0.5f;
      cache.relight(rays, Lights(home.scene), home.voxels());
      results.push_back(cache.field().irradianceLux);
    });
  }
  ASSERT_EQ(results[0].size(), results[1].size());
  for (size_t s = 0; s < results[0].size(); ++s) ASSERT_TRUE(results[0][s] == results[1][s]) << s;
}

}  // namespace
}  // namespace roomlight
