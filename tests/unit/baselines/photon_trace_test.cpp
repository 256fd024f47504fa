#include "baselines/photon_trace.h"

#include <gtest/gtest.h>

#include "base/parallel.h"
#include "support/rooms.h"

namespace roomlight {
namespace {

constexpr float kNearlyBlack = 0.001f;  // photons on black are of no use, and are not kept

Scene room(float albedo) {
  Scene scene;
  const int wall = test::addMaterial(scene, test::lambertian(albedo));
  test::addRoom(scene, {0, 0, 0}, {4, 3, 5}, std::vector<int>(6, wall));
  return scene;
}

// Looks into every direction from the middle of the room.
ImportonStart lookAround(Vec3 from) {
  return [from](uint32_t, Sampler& sampler) {
    const Vec2 u = sampler.next2();
    const float z = 1 - 2 * u.x, r = std::sqrt(std::max(0.0f, 1 - z * z)), phi = 2 * kPi * u.y;
    return Ray{from, {r * std::cos(phi), r * std::sin(phi), z}, 0, kInfinity};
  };
}

struct Traced {
  explicit Traced(const Scene& scene, const PhotonSettings& settings, Vec3 from = {2, 1.5f, 2.5f},
                  bool indirectOnly = false)
      : rays(scene),
        lights(scene),
        importance(rays, lights, lookAround(from), settings.importons, settings.seed),
        survey(surveySky({rays, lights}, {}, {4, 0})),
        tracer(rays, lights, importance, survey, settings),
        global(tracer.global(indirectOnly, {})),
        caustic(tracer.caustics({})) {}
  RayScene rays;
  Lights lights;
  PhotonImportance importance;
  SkySurvey survey;
  PhotonTracer tracer;
  TracedPhotons global, caustic;
};

double flux(const std::vector<Photon>& photons) {
  double sum = 0;
  for (const Photon& photon : photons) sum += static_cast<double>(luminance(photon.fluxLm));
  return sum;
}

PhotonSettings few() {
  PhotonSettings settings;
  settings.photons = 60000, settings.causticPhotons = 20000, settings.importons = 4096;
  return settings;
}

// In a closed room of albedo rho all photons kept together hold the flux over 1 - rho: every bounce keeps rho of it.
class ClosedRoom : public testing::TestWithParam<float> {};

TEST_P(ClosedRoom, PhotonsHoldTheFluxOfTheLampAndOfItsBounces) {
  Scene scene = room(GetParam());
  scene.lamps.push_back(test::pointLamp({1, 2, 2}, 100));
  const double lm = 400 * static_cast<double>(kPi), rho = static_cast<double>(GetParam());
  const Traced traced(scene, few());
  EXPECT_NEAR(flux(traced.global.photons), lm / (1 - rho), 0.01 * lm / (1 - rho));
  EXPECT_NEAR(static_cast<double>(traced.global.photons.size()), 60000, 3000);
  const Traced indirect(scene, few(), {2, 1.5f, 2.5f}, true);
  EXPECT_NEAR(flux(indirect.global.photons), lm * rho / (1 - rho), 0.01 * lm / (1 - rho));
  EXPECT_TRUE(traced.caustic.photons.empty());
}
INSTANTIATE_TEST_SUITE_P(Albedos, ClosedRoom, testing::Values(0.1f, 0.5f, 0.8f));

TEST(PhotonTracer, SendsEmissiveMeshesAndLampsByTheirFlux) {
  Scene scene = room(kNearlyBlack);
  scene.lamps.push_back(test::pointLamp({1, 2, 2}, 10));
  scene.lamps.push_back(test::pointLamp({3, 1, 2}, 50));
  test::addRectangle(scene, {1, 2.9f, 1}, {1, 0, 0}, {0, 0, 1},
                     test::addMaterial(scene, test::lambertian(kNearlyBlack, 100)));
  const double lm = 60 * 4 * static_cast<double>(kPi) + 100 * static_cast<double>(kPi);
  const Traced traced(scene, few());
  EXPECT_NEAR(flux(traced.global.photons), lm, 0.005 * lm);
}

// A room with a window of 1 m²: what enters is known, and photons must find the way in.
class Window : public testing::Test {
 protected:
  Window() {
    const int wall = test::addMaterial(scene, test::lambertian(kNearlyBlack));
    test::addRectangle(scene, {0, 0, 5}, {4, 0, 0}, {0, 0, -5}, wall);   // floor
    test::addRectangle(scene, {0, 3, 0}, {4, 0, 0}, {0, 0, 5}, wall);    // ceiling
    test::addRectangle(scene, {0, 0, 0}, {4, 0, 0}, {0, 3, 0}, wall);
    test::addRectangle(scene, {0, 0, 5}, {0, 0, -5}, {0, 3, 0}, wall);
    test::addRectangle(scene, {4, 0, 0}, {0, 0, 5}, {0, 3, 0}, wall);
    // The front, z = 5, around the window from (1, 1) to (2, 2).
    test::addRectangle(scene, {0, 0, 5}, {0, 3, 0}, {1, 0, 0}, wall);
    test::addRectangle(scene, {2, 0, 5}, {0, 3, 0}, {2, 0, 0}, wall);
    test::addRectangle(scene, {1, 0, 5}, {0, 1, 0}, {1, 0, 0}, wall);
    test::addRectangle(scene, {1, 2, 5}, {0, 1, 0}, {1, 0, 0}, wall);
    // A plain far below makes the scene large.
    test::addRectangle(scene, {-40, -10, 40}, {80, 0, 0}, {0, 0, -80}, wall);
  }
  // Of photons that ended inside.
  double inside(const Traced& traced) {
    double sum = 0;
    for (const Photon& photon : traced.global.photons) {
      const Vec3 p = photon.p, n = photon.n;
      const bool in = p.x > -0.01f && p.x < 4.01f && p.y > -0.01f && p.y < 3.01f && p.z > -0.01f && p.z < 5.01f;
      const bool inwards = dot(Vec3(2, 1.5f, 2.5f) - p, n) > 0;
      if (in && inwards) sum += static_cast<double>(luminance(photon.fluxLm)), ++count;
    }
    return sum;
  }
  Scene scene;
  int count = 0;
};

TEST_F(Window, SunEntersByIlluminanceTimesArea) {
  scene.suns.push_back({"sun", normalize(Vec3(0.2f, 0.4f, 1)), Vec3(10000), 0.00465f});
  const double lm = 10000 * static_cast<double>(scene.suns[0].toLight.z);
  const Traced traced(scene, few());
  EXPECT_NEAR(inside(traced), lm, 0.02 * lm);
  // Aimed: of what is sent out, a good part enters, though the window is a millionth of the disc across the scene.
  EXPECT_GT(count, 20000);
  EXPECT_LT(traced.global.emitted, 20u * 60000u);
}

TEST_F(Window, SkyEntersByPiLTimesArea) {
  scene.sky.luminanceCdM2 = Vec3(1000);
  const double lm = 1000 * static_cast<double>(kPi);
  const Traced traced(scene, few());
  // Half of what the window sees is below the horizon: sky there too, but the plain hides it.
  EXPECT_GT(inside(traced), 0.5 * lm);
  EXPECT_LT(inside(traced), 1.0 * lm);
  EXPECT_LT(traced.global.emitted, 20u * 60000u);
}

TEST(PhotonTracer, IsTheSameForAnyNumberOfThreads) {
  Scene scene = room(0.5f);
  scene.lamps.push_back(test::pointLamp({1, 2, 2}, 100));
  std::vector<Photon> one, two;
  withThreads(1, [&] { one = Traced(scene, few()).global.photons; });
  withThreads(2, [&] { two = Traced(scene, few()).global.photons; });
  ASSERT_EQ(one.size(), two.size());
  for (size_t i = 0; i < one.size(); ++i) {
    ASSERT_EQ(one[i].p, two[i].p);
    ASSERT_EQ(one[i].fluxLm, two[i].fluxLm);
  }
}

// A mirror on the floor throws lamp light on the ceiling: a caustic. By the image of the lamp behind the mirror, of
// albedo 1.
TEST(PhotonTracer, KeepsCausticsApart) {
  Scene scene = room(kNearlyBlack);
  scene.lamps.push_back(test::pointLamp({2, 1, 2.5f}, 100));
  Material mirror;
  mirror.metallic = 1, mirror.roughness = 0;
  test::addRectangle(scene, {1.5f, 0.01f, 3}, {1, 0, 0}, {0, 0, -1}, test::addMaterial(scene, mirror));
  const Traced traced(scene, few());
  // The square of 1 m seen from 0.99 m above its middle: 4 atan(ab / (d sqrt(a² + b² + d²))) with a = b = 0.5.
  const double d = 0.99, solidAngle = 4 * std::atan(0.25 / (d * std::sqrt(0.5 + d * d))), lm = 100 * solidAngle;
  EXPECT_NEAR(flux(traced.caustic.photons), lm, 0.02 * lm);
  for (const Photon& photon : traced.caustic.photons) ASSERT_GT(photon.p.y, 0.02f);
}

}  // namespace
}  // namespace roomlight
