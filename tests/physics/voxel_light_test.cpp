// Light in voxels where voxels are coarser than what happens in them: beside lamps, at veils and at folded cloth.
#include <gtest/gtest.h>

#include "base/sampler.h"
#include "base/sampling.h"
#include "radiance/pyramid.h"
#include "support/rooms.h"
#include "voxel/voxelise.h"

namespace roomlight {
namespace {

struct Lit {
  Voxelisation voxelisation;
  RadianceField field;
};

Lit light(const Scene& scene, float voxelSizeM) {
  const RayScene rays(scene);
  const Lights lights(scene);
  VoxelSettings voxel;
  voxel.voxelSizeM = voxelSizeM;
  Lit lit{voxelise(scene, voxel), {}};
  lit.field = illuminate(rays, lights, lit.voxelisation.voxels, {});
  return lit;
}

// Flux that all surfaces absorb, lm.
double absorbed(const Lit& lit) {
  double sum = 0;
  for (size_t i = 0; i < lit.field.irradianceLux.size(); ++i) {
    const FaceSlot& slot = lit.voxelisation.voxels.slots[i];
    sum += static_cast<double>(luminance(lit.field.irradianceLux[i] * (Vec3(1) - slot.albedo))) *
           static_cast<double>(slot.areaM2);
  }
  return sum;
}

class LampBeforeAWall : public testing::TestWithParam<float> {};

// What a lamp gives in a closed room ends in its walls, however close to one of them the lamp hangs.
TEST_P(LampBeforeAWall, allItsFluxIsAbsorbed) {
  Scene scene;
  const int wall = test::addMaterial(scene, test::lambertian(0.5f));
  test::addRoom(scene, {0, 0, 0}, {2.03f, 2.03f, 2.03f}, std::vector<int>(6, wall));
  scene.lamps.push_back(test::pointLamp({GetParam(), 1.07f, 0.93f}, 100));
  EXPECT_NEAR(absorbed(light(scene, 0.1f)), 400 * kPi, 0.02 * 400 * kPi);
}
INSTANTIATE_TEST_SUITE_P(Distances, LampBeforeAWall, testing::Values(0.005f, 0.03f, 0.15f, 1.0f));

// The same for a garland, whose lamps share the particles.
TEST(LampsBeforeAWall, allTheirFluxIsAbsorbed) {
  Scene scene;
  const int wall = test::addMaterial(scene, test::lambertian(0.5f));
  test::addRoom(scene, {0, 0, 0}, {2.03f, 2.03f, 2.03f}, std::vector<int>(6, wall));
  for (int i = 0; i < 114; ++i)
    scene.lamps.push_back(
        test::pointLamp({0.04f, 0.3f + 0.0125f * static_cast<float>(i), 0.5f + 0.1f * static_cast<float>(i % 10)}, 1));
  EXPECT_NEAR(absorbed(light(scene, 0.1f)), 114 * 4 * kPi, 0.02 * 114 * 4 * kPi);
}

// A cone without width, far from its surface: steps from voxel to voxel must not be lost in rounding.
TEST(NarrowCone, arrivesFromAfar) {
  Scene scene;
  const int white = test::addMaterial(scene, test::lambertian(0.5f));
  test::addRectangle(scene, {0, 0, 0}, {0, 4, 0}, {0, 0, 4}, white);
  test::addRectangle(scene, {12000, 0, 0}, {0, 0, 4}, {0, 4, 0}, white);
  const Lit lit = light(scene, 0.1f);
  EXPECT_LT(marchCone(lit.field, {{11999.9f, 2.03f, 2.03f}, {-1, 0, 0}}, {-1, 0, 0}, {0, 0}, 0).left, 0.01f);
}

// A lamp in a closed lantern as thin as voxels: the room gets nothing, though cones of coarse voxels cut its edges.
// They leave its light to points, none of which is seen from outside.
TEST(LampInACavity, roomGetsWhatComesOut) {
  double seen = 0, sent = 0;
  for (const float size : {0.05f, 0.08f, 0.11f}) {
    Scene scene;
    const int wall = test::addMaterial(scene, test::lambertian(0.5f)),
              black = test::addMaterial(scene, test::lambertian(0));
    test::addRoom(scene, {0, 0, 0}, {2, 2, 2}, std::vector<int>(6, black));
    Scene lantern;
    test::addBox(lantern, Vec3(-0.5f * size), Vec3(0.5f * size), wall);
    const float c = std::cos(0.4f), k = std::sin(0.4f);
    for (Instance& i : lantern.instances) {
      i.worldFromObject = Affine{{c, k, 0}, {-k, c, 0}, {0, 0, 1}, {1.013f, 1.021f, 1.007f}} * i.worldFromObject;
      i.mesh += static_cast<int>(scene.meshes.size());
    }
    scene.instances.insert(scene.instances.end(), lantern.instances.begin(), lantern.instances.end());
    scene.meshes.insert(scene.meshes.end(), lantern.meshes.begin(), lantern.meshes.end());
    scene.lamps.push_back(test::pointLamp({1.013f, 1.021f, 1.007f}, 100));
    const Lit lit = light(scene, 0.06f);
    const RayScene rays(scene);
    ASSERT_FALSE(lit.field.glow.empty());
    for (uint32_t i = 0; i < 8000; ++i) {
      Sampler sampler(i, 0, 1);
      const Vec2 u = sampler.next2();
      const Vec3 from{2 * u.x, 2 * u.y, 0.002f},
          to = Vec3{1.013f, 1.021f, 1.007f} +
               (Vec3{sampler.next1(), sampler.next1(), sampler.next1()} - Vec3(0.5f)) * (1.5f * size);
      const Vec3 d = normalize(to - from);
      seen += static_cast<double>(
                  luminance(marchCone(lit.field, {from, {0, 0, 1}}, d, {0.02f, 0, d.z / kPi}, 0).radiance)) /
              24000;
      const LightSample g = lit.field.glow.sample(from, {0, 0, 1}, 1, 0.02f, sampler).light;
      if (g.valid())
        sent +=
            static_cast<double>(luminance(g.radiance * rays.transmittance({from, g.wi, 0, g.distance * (1 - 1e-4f)}))) *
            static_cast<double>(g.wi.z) / 24000;
    }
  }
  // Inside it has some 100 000 cd/m².
  EXPECT_LT(seen, 1);
  EXPECT_LT(sent, 0.1);
}

// A lamp over a small white plate sends all its light there. Points and cones together give the room what the plate
// reflects: its flux through the ceiling, by the form factor of a Lambertian disc seen as a point.
TEST(LampOverAPlate, ceilingGetsItsReflectionOnce) {
  Scene scene;
  const int white = test::addMaterial(scene, test::lambertian(0.8f)),
            black = test::addMaterial(scene, test::lambertian(0));
  test::addRoom(scene, {0, 0, 0}, {3, 3, 3}, std::vector<int>(6, black));
  test::addRectangle(scene, {1.47f, 1.47f, 0.5f}, {0.06f, 0, 0}, {0, 0.06f, 0}, white);
  Lamp lamp = test::pointLamp({1.5f, 1.5f, 0.55f}, 100);
  lamp.kind = LampKind::Spot, lamp.direction = {0, 0, -1}, lamp.innerConeRad = lamp.outerConeRad = 0.4f;
  scene.lamps.push_back(lamp);
  const Lit lit = light(scene, 0.08f);
  const RayScene rays(scene);
  const double flux = 2 * kPi * (1 - std::cos(0.4)) * 100 * 0.8, exact = flux / kPi / (2.5 * 2.5);
  double points = 0, cones = 0;
  constexpr int kSamples = 40000;
  for (uint32_t i = 0; i < kSamples; ++i) {
    Sampler sampler(i, 0, 3);
    const Vec3 from{1.5f, 1.5f, 2.999f}, n{0, 0, -1};
    const Vec3 d = Frame(n).toWorld(sampleCosineHemisphere(sampler.next2()));
    cones += static_cast<double>(luminance(marchCone(lit.field, {from, n}, d, {0.005f, 0, -d.z / kPi}, 0).radiance)) *
             kPi / kSamples;
    const GlowSample g = lit.field.glow.sample(from, n, 1, 0.005f, sampler);
    ASSERT_TRUE(g.light.valid());
    const float cosSurface = -g.light.wi.z,
                share = lit.field.glow.pointShare(g.point, from, {cosSurface / kPi, 0.005f});
    points += static_cast<double>(luminance(g.light.radiance *
                                            rays.transmittance({from, g.light.wi, 0, g.light.distance * (1 - 1e-4f)})) *
                                  cosSurface * share) /
              kSamples;
  }
  EXPECT_NEAR(points + cones, exact, 0.02 * exact);
}

// A white room without its ceiling under an even sky: every surface, however deep, gets as much as the roof would.
TEST(WhiteRoom, bouncesGoOnThoughNothingAbsorbs) {
  Scene scene;
  const int white = test::addMaterial(scene, test::lambertian(1));
  test::addRoom(scene, {0, 0, 0}, {2, 2, 2}, std::vector<int>(6, white));
  scene.meshes.pop_back(), scene.instances.pop_back();
  scene.sky.luminanceCdM2 = Vec3(1000);
  const Lit lit = light(scene, 0.1f);
  const Voxels& voxels = lit.voxelisation.voxels;
  double sum = 0, area = 0;
  for (size_t i = 0; i < voxels.slots.size(); ++i) {
    const FaceSlot& s = voxels.slots[i];
    const Vec3 inwards = Vec3(1) - s.position;
    if (dot(s.normal, inwards) < 0.5f) continue;
    sum += static_cast<double>(luminance(lit.field.irradianceLux[i]) * s.areaM2), area += static_cast<double>(s.areaM2);
  }
  EXPECT_NEAR(sum / area, 1000 * kPi, 20 * kPi);
}

// A shade that transmits half of the light takes none: all flux ends in the walls.
TEST(LampInGlass, allItsFluxIsAbsorbed) {
  Scene scene;
  Material glass = test::lambertian(1);
  glass.transmission = 0.5f;
  const int wall = test::addMaterial(scene, test::lambertian(0.5f)), shade = test::addMaterial(scene, glass);
  test::addRoom(scene, {0, 0, 0}, {2.03f, 2.03f, 2.03f}, std::vector<int>(6, wall));
  test::addBox(scene, Vec3(0.9f), Vec3(1.1f), shade);
  scene.lamps.push_back(test::pointLamp(Vec3(1), 100));
  const Lit lit = light(scene, 0.1f);
  double sum = 0;
  for (size_t i = 0; i < lit.field.irradianceLux.size(); ++i) {
    const FaceSlot& slot = lit.voxelisation.voxels.slots[i];
    if (slot.instance < 6) sum += static_cast<double>(luminance(lit.field.irradianceLux[i]) * 0.5f * slot.areaM2);
  }
  EXPECT_NEAR(sum, 400 * kPi, 0.04 * 400 * kPi);
}

// A spot whose light falls on a disc smaller than a voxel.
class NarrowSpot : public testing::TestWithParam<float> {};
TEST_P(NarrowSpot, allItsFluxIsAbsorbed) {
  Scene scene;
  const int wall = test::addMaterial(scene, test::lambertian(0.5f));
  test::addRoom(scene, {0, 0, 0}, {2.03f, 2.03f, 2.03f}, std::vector<int>(6, wall));
  Lamp lamp = test::pointLamp({1.02f, 0.97f, 1.9f}, 1000);
  lamp.kind = LampKind::Spot, lamp.direction = {0, 0, -1}, lamp.innerConeRad = lamp.outerConeRad = GetParam();
  scene.lamps.push_back(lamp);
  const double flux = 2 * kPi * (1 - std::cos(static_cast<double>(GetParam()))) * 1000;
  EXPECT_NEAR(absorbed(light(scene, 0.1f)), flux, 0.03 * flux);
}
INSTANTIATE_TEST_SUITE_P(Angles, NarrowSpot, testing::Values(0.01f, 0.04f, 0.1f, 0.3f));

// Points lie on surfaces, and shadow rays to them must not end in these: in a corner they come in at a grazing angle.
TEST(Glow, pointsAreSeenFromBesideThem) {
  Scene scene;
  const int white = test::addMaterial(scene, test::lambertian(0.8f));
  test::addRoom(scene, {5, 5, 5}, {5.12f, 5.12f, 5.12f}, std::vector<int>(6, white));
  scene.lamps.push_back(test::pointLamp(Vec3(5.06f), 100));
  const Lit lit = light(scene, 0.05f);
  const RayScene rays(scene);
  double seen = 0, all = 0;
  for (uint32_t i = 0; i < 20000; ++i) {
    Sampler sampler(i, 0, 5);
    const Vec3 from = offsetOrigin({5.002f, 5.06f, 5}, {0, 0, 1});
    const LightSample g = lit.field.glow.sample(from, {0, 0, 1}, 1, 0.005f, sampler).light;
    if (!g.valid()) continue;
    const double l = static_cast<double>(luminance(g.radiance) * g.wi.z);
    all += l, seen += l * static_cast<double>(luminance(rays.transmittance({from, g.wi, 0, g.distance * (1 - 1e-4f)})));
  }
  EXPECT_GT(seen, 0.99 * all);
}

// Half of the light passes a veil of opacity one half, whatever voxels its way crosses.
TEST(Veil, passesItsShareOnce) {
  Scene scene;
  Material veil = test::lambertian(0.5f);
  veil.alpha = 0.5f;
  veil.alphaMode = AlphaMode::Blend;
  test::addRectangle(scene, {0, 0, 0.03f}, {3, 0, 0.4f}, {0, 3, 0.3f}, test::addMaterial(scene, veil));
  const Lit lit = light(scene, 0.07f);
  double left = 0;
  for (uint32_t i = 0; i < 2000; ++i) {
    Sampler sampler(i, 0, 1);
    const Vec2 u = sampler.next2();
    const Vec3 d = sampleCosineHemisphere(sampler.next2());
    const Vec3 target{1 + u.x, 1 + u.y, 0.03f + (1 + u.x) * 0.4f / 3 + (1 + u.y) * 0.1f};
    left += static_cast<double>(marchCone(lit.field, {target - d, {0, 0, 1}}, d, {0.01f, 0}, 0).left) / 2000;
  }
  EXPECT_NEAR(left, 0.5, 0.03);
}

// Cloth folded more finely than voxels, lit from behind only: its front, which no light reaches, must not see its back.
TEST(FoldedCloth, frontDoesNotSeeItsOwnBack) {
  Scene scene;
  const int cloth = test::addMaterial(scene, test::lambertian(0.8f));
  constexpr float kFold = 0.05f, kDepth = 0.02f;
  for (int i = 0; i < 40; ++i) {
    const float x = kFold * static_cast<float>(i), z = i % 2 ? kDepth : 0;
    test::addRectangle(scene, {x, 0, z}, {kFold, 0, i % 2 ? -kDepth : kDepth}, {0, 2, 0}, cloth);
  }
  const int black = test::addMaterial(scene, test::lambertian(0));
  test::addRoom(scene, {0, 0, -2}, {2, 2, 2}, std::vector<int>(6, black));
  scene.lamps.push_back(test::pointLamp({1, 1, -1}, 100));
  const Lit lit = light(scene, 0.07f);
  double seen = 0;
  for (uint32_t i = 0; i < 4000; ++i) {
    Sampler sampler(i, 0, 1);
    const Vec2 u = sampler.next2();
    const float x = 0.5f + u.x, phase = x / kFold - std::floor(x / kFold);
    const bool down = static_cast<int>(x / kFold) % 2 != 0;
    const Vec3 p{x, 0.5f + u.y, kDepth * (down ? 1 - phase : phase)};
    const Vec3 n = normalize(Vec3{down ? kDepth : -kDepth, 0, kFold});
    const Vec3 d = Frame(n).toWorld(sampleCosineHemisphere(sampler.next2()));
    seen +=
        static_cast<double>(luminance(marchCone(lit.field, {p + n * 0.0035f, n}, d, {0.02f, 0}, 0).radiance)) / 4000;
  }
  // The back has 25 cd/m².
  EXPECT_LT(seen, 0.5);
}

}  // namespace
}  // namespace roomlight
