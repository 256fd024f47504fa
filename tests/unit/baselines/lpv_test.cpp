#include "baselines/lpv.h"

#include <gtest/gtest.h>

#include "base/parallel.h"
#include "base/sampler.h"
#include "base/sampling.h"
#include "support/rooms.h"

namespace roomlight {
namespace {

LpvLattice cube(int n, float cellM = 1) { return {{0, 0, 0}, cellM, {n, n, n}}; }

TEST(LpvWalls, shareOutTheSphere) {
  double sum = 0;
  Vec3 mean;
  for (const LpvWall& w : lpvWalls()) {
    sum += w.solidAngleSr;
    mean += w.direction * w.solidAngleSr;
    EXPECT_NE(w.wall, w.side ^ 1) << "light does not go back";
    // Of a square of edge 1 at distance 1.5, and one from 0.5 to 1.5 at distance 0.5 along its own middle: 4 atan(ab /
    // (h sqrt(a² + b² + h²))) for a quarter.
    EXPECT_NEAR(w.solidAngleSr, w.wall == w.side ? 0.40067f : 0.42343f, 2e-4);
    EXPECT_NEAR(w.weight[0], w.solidAngleSr * 0.282095f, 1e-6);
  }
  EXPECT_NEAR(sum, 4 * kPi, 1e-4);
  EXPECT_NEAR(length(mean), 0, 1e-4);
}

TEST(LpvGrid, aLobeHasItsFluxAndPointsAlongItsNormal) {
  LpvGrid grid(cube(4));
  const size_t cell = grid.lattice().index({2, 2, 2});
  const Vec3 n = normalize(Vec3{1, 2, -2});
  grid.addLobe(cell, n, {3, 2, 1});
  const Vec3 flux = grid.fluxLm();
  EXPECT_NEAR(flux.x, 3, 1e-5);
  EXPECT_NEAR(flux.z, 1, 1e-5);
  const LpvIntensity i = grid.get(cell);
  // Four harmonics of a clamped cosine: (1 + 2 cos) / 4, here of 3 / pi cd.
  EXPECT_NEAR(kSh0 * i[0][0] + kSh1 * (i[0][1] * n.x + i[0][2] * n.y + i[0][3] * n.z), 0.75 * 3 / kPi, 1e-5);
}

// Light in free space goes on and on: none is lost, none is made. The paper's clamping of negative lobes alone makes up
// to an eighth a step.
TEST(LpvGrid, propagationInFreeSpaceKeepsTheFlux) {
  LpvGrid grid(cube(24));
  grid.addLobe(grid.lattice().index({12, 12, 12}), {0, 1, 0}, {100, 10, 1});
  grid.addLobe(grid.lattice().index({13, 11, 12}), normalize(Vec3{1, -1, 0.3f}), {50, 20, 0});
  const LpvGeometry free(grid.lattice());
  for (const int steps : {1, 4, 9}) {
    const Vec3 flux = propagate(grid, free, steps, false).fluxLm();
    EXPECT_NEAR(flux.x / (150.0 * (steps + 1)), 1, 1e-4) << steps;
    EXPECT_NEAR(flux.z / (1.0 * (steps + 1)), 1, 1e-4) << steps;
  }
}

TEST(LpvGrid, neverHoldsLessThanNothing) {
  LpvGrid grid(cube(12));
  grid.addLobe(grid.lattice().index({6, 1, 6}), {0, 1, 0}, Vec3(100));
  const LpvGrid out = propagate(grid, LpvGeometry(grid.lattice()), 12, false);
  for (int i = 0; i < 12 * 12 * 12; ++i)
    ASSERT_GE(out.get(out.lattice().index({i % 12 + 1, i / 12 % 12 + 1, i / 144 + 1}))[0][0], 0);
}

// A wall of surfels in the plane x = 4, seen from the left.
std::vector<Surfel> wall(int n, float albedo, bool bothSides) {
  std::vector<Surfel> out;
  for (int i = 0; i < 4 * n * n; ++i) {
    const Vec3 p{4, 0.25f + 0.5f * static_cast<float>(i % (2 * n)), 0.25f + 0.5f * static_cast<float>(i / (2 * n))};
    out.push_back({p, {-1, 0, 0}, Vec3(albedo), 0.25f});
    if (bothSides) out.push_back({p, {1, 0, 0}, Vec3(albedo), 0.25f});
  }
  return out;
}

// Three quarters are what four harmonics know of a full blocker, met straight; its other side takes nothing off that.
TEST(LpvGeometry, aWallStopsThreeQuartersOfWhatMeetsItStraight) {
  for (const bool both : {false, true}) {
    const LpvGeometry g(cube(8), wall(8, 0.5f, both));
    EXPECT_NEAR(g.passes({4, 4.5f, 4.5f}, {1, 0, 0}), 0.25, 1e-3);
    EXPECT_NEAR(g.passes({4, 4.5f, 4.5f}, {0, 1, 0}), 0.75, 1e-3);
    EXPECT_NEAR(g.passes({4, 4.5f, 4.5f}, {-1, 0, 0}), both ? 0.25 : 1, 1e-3);
    EXPECT_NEAR(g.passes({2, 4.5f, 4.5f}, {1, 0, 0}), 1, 1e-3);
  }
}

// What a white wall stops comes back: nothing is lost until light leaves the grid. What a black one stops is gone.
TEST(LpvGeometry, aWhiteWallSendsBackWhatItStops) {
  LpvGrid grid(cube(16));
  grid.addLobe(grid.lattice().index({4, 8, 8}), {1, 0, 0}, Vec3(100));
  const auto last = [&](float albedo, bool reflect) {
    const LpvGeometry g(grid.lattice(), wall(16, albedo, true));
    return static_cast<double>(propagate(grid, g, 3, reflect).fluxLm().x - propagate(grid, g, 2, reflect).fluxLm().x);
  };
  EXPECT_NEAR(last(1, true), 100, 1e-2);
  EXPECT_LT(last(0, true), 70);
  EXPECT_NEAR(last(0, true), last(1, false), 1e-3);
  EXPECT_GT(last(0.5f, true), last(0, true) + 10);
}

// Only a fifth of what enters a cell leaves it by the far wall, and what reaches a side wall goes on about that wall's
// normal: light wanders more than it flies. These are the shares of the true irradiance that docs/methods/lpv.md
// states, once all light has left the grid.
TEST(LpvGrid, farFromASmallSourceIrradianceFallsShortAsTheBeamWidens) {
  LpvGrid grid(cube(33));
  grid.addLobe(grid.lattice().index({17, 5, 17}), {0, 1, 0}, Vec3(100));
  LpvLight light;
  light.levels.emplace_back(propagate(grid, LpvGeometry(grid.lattice()), 200, false), LpvGeometry(grid.lattice()));
  LpvSettings settings;
  settings.lookUpCells = 0;
  const auto found = [&](float d) {
    return static_cast<double>(lpvIrradiance(light, {16.5f, 4.5f + d, 16.5f}, {0, -1, 0}, {0, -1, 0}, settings).x *
                               kPi) /
           (100 / static_cast<double>(kPi * d * d));
  };
  EXPECT_NEAR(found(4), 0.71, 0.01);
  EXPECT_NEAR(found(8), 0.73, 0.01);
  EXPECT_NEAR(found(12), 0.56, 0.01);
  EXPECT_NEAR(found(16), 0.34, 0.01);
}

// All that a lamp in a closed room gives meets walls, whose share comes back.
TEST(LpvMaps, virtualLightsHoldWhatWallsReflect) {
  Scene scene;
  test::addRoom(scene, {0, 0, 0}, {4, 4, 4}, std::vector<int>(6, test::addMaterial(scene, test::lambertian(0.3f))));
  scene.lamps.push_back(test::pointLamp({1, 2, 3}, 1000 / (4 * kPi)));
  scene.lamps.push_back(test::pointLamp({3, 1, 3}, 500 / (4 * kPi)));
  const RayScene rays(scene);
  const Lights lights(scene, true);
  LpvSettings settings;
  settings.mapSize = 64;
  double sum = 0;
  size_t maps = 0;
  traceShadowMaps(rays, lights, rays.bounds(), settings, [&](std::span<const VirtualLight> found) {
    ++maps;
    for (const VirtualLight& v : found) sum += static_cast<double>(v.fluxLm.x);
  });
  EXPECT_EQ(maps, 2u);
  EXPECT_NEAR(sum, 450, 0.5);
}

// A sun of 1000 lx from above on a floor of 4 x 4 m, half of which is outside the home.
TEST(LpvMaps, sunsLightWhatTheHomeHolds) {
  Scene scene;
  test::addRectangle(scene, {0, 0, 0}, {0, 0, 4}, {4, 0, 0}, test::addMaterial(scene, test::lambertian(0.5f)));
  Sun sun;
  sun.toLight = {0, 1, 0};
  sun.illuminanceLux = Vec3(1000);
  scene.suns.push_back(sun);
  const RayScene rays(scene);
  const Lights lights(scene, true);
  LpvSettings settings;
  settings.mapSize = 64;
  double sum = 0;
  traceShadowMaps(rays, lights, {{0, 0, 0}, {2, 1, 4}}, settings, [&](std::span<const VirtualLight> found) {
    for (const VirtualLight& v : found) sum += static_cast<double>(v.fluxLm.x);
  });
  EXPECT_NEAR(sum, 0.5 * 1000 * 8, 40);
}

}  // namespace
}  // namespace roomlight
