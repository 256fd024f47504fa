#include "trace/light_parts.h"

#include <gtest/gtest.h>

#include <numbers>

#include "photometry/spot.h"
#include "support/rooms.h"
#include "support/webs.h"
#include "trace/surface_point.h"
#include "unit/base/chi_square.h"

namespace roomlight {
namespace {

double rad(double degrees) { return degrees * std::numbers::pi / 180; }

Lamp spot(double innerDeg, double outerDeg) {
  Lamp lamp;
  lamp.kind = LampKind::Spot;
  lamp.intensityCd = Vec3(1);
  lamp.innerConeRad = static_cast<float>(rad(innerDeg));
  lamp.outerConeRad = static_cast<float>(rad(outerDeg));
  return lamp;
}

// Lumens of a spot of 1 cd, by numerical integration of what the renderer uses.
double integratedFlux(const Lamp& lamp) {
  constexpr int kSteps = 400'000;
  const double widest = 1.02 * (1 - std::cos(static_cast<double>(lamp.outerConeRad)));  // of 1 - cos
  double sum = 0;
  for (int i = 0; i < kSteps; ++i) {
    const double h = widest * (i + 0.5) / kSteps;
    sum +=
        luminance(lampIntensity(lamp, Vec3{static_cast<float>(std::sqrt(h * (2 - h))), static_cast<float>(h - 1), 0}));
  }
  return 2 * std::numbers::pi * sum * widest / kSteps;
}

TEST(Lights, fluxPerCandelaOfASpotIsTheIntegralOfItsFalloff) {
  const double cones[][2] = {{0, 45}, {12, 30}, {30, 30}, {89, 90}, {2, 2}, {0, 1}, {1, 1}, {0, 0.5}};
  for (const auto& [inner, outer] : cones) {
    const Lamp lamp = spot(inner, outer);
    const double expected = spotFluxPerCandela(std::cos(lamp.innerConeRad), std::cos(lamp.outerConeRad));
    EXPECT_NEAR(integratedFlux(lamp) / expected, 1, 0.005) << inner << " " << outer;
    EXPECT_EQ(luminance(lampIntensity(lamp, lamp.direction)), luminance(lamp.intensityCd)) << inner << " " << outer;
  }
}

// Chosen by importance, too: a spot a few millimetres away shines there as it does from afar.
TEST(Lights, aSpotIsChosenHoweverClose) {
  Scene scene;
  Lamp lamp;
  lamp.kind = LampKind::Spot, lamp.direction = {0, 0, -1}, lamp.innerConeRad = 0.2f, lamp.outerConeRad = 0.8f,
  lamp.intensityCd = Vec3(10);
  scene.lamps.push_back(lamp);
  const Lights lights(scene);
  for (const float z : {0.002f, 0.005f, 0.02f})
    EXPECT_NEAR(luminance(sampleLocal(lights, {}, {0, 0, -z}, {0.5f, 0.5f}, 0.5f).radiance) * z * z, 10, 0.01f) << z;
}

// Rays of a lamp land as densely as lampDensity says: both follow the web.
TEST(Lights, raysLeaveAWebByItsLight) {
  Scene scene;
  scene.lamps.push_back(
      test::webLamp({0, 0, 0}, test::makeWeb([](float c, float g) { return (1 + std::cos(c)) * (2 - g); }, 100, 15)));
  scene.lamps.push_back(test::pointLamp({0, 0, 0}, 0.3f));
  const Lights lights(scene);
  constexpr int kPolar = 16, kAzimuth = 16, kRays = 400'000, kFine = 32;
  std::vector<double> counts(kPolar * kAzimuth), expected(kPolar * kAzimuth);
  double flux = 0;
  for (int i = 0; i < kRays; ++i) {
    Sampler sampler(static_cast<uint64_t>(i), 0, 5);
    const LightRay ray = lights.sampleLampRay(sampler);
    flux += static_cast<double>(luminance(ray.fluxLm)) / kRays;
    const double turn = 0.5 + std::atan2(static_cast<double>(ray.direction.z), static_cast<double>(ray.direction.x)) /
                                  (2 * std::numbers::pi);
    const int p = std::min(kPolar - 1, static_cast<int>((static_cast<double>(ray.direction.y) + 1) / 2 * kPolar)),
              a = std::min(kAzimuth - 1, static_cast<int>(turn * kAzimuth));
    counts[static_cast<size_t>(p * kAzimuth + a)] += 1;
  }
  for (int i = 0; i < kPolar * kFine * kAzimuth * kFine; ++i) {
    const int p = i / (kAzimuth * kFine), a = i % (kAzimuth * kFine);
    const double y = -1 + 2 * (p + 0.5) / (kPolar * kFine),
                 phi = 2 * std::numbers::pi * ((a + 0.5) / (kAzimuth * kFine) - 0.5), r = std::sqrt(1 - y * y);
    const Vec3 d{static_cast<float>(r * std::cos(phi)), static_cast<float>(y), static_cast<float>(r * std::sin(phi))};
    expected[static_cast<size_t>(p / kFine * kAzimuth + a / kFine)] +=
        kRays * static_cast<double>(lights.lampDensity(d, -d)) * 4 * std::numbers::pi /
        (kPolar * kFine * kAzimuth * kFine);
  }
  EXPECT_TRUE(testing::fits(counts, expected));
  const double exact = scene.lamps[0].web->fluxLm + 0.3 * 4 * std::numbers::pi;
  EXPECT_NEAR(flux / exact, 1, 5e-3);
}

// However it is placed, an extended lamp is chosen wherever any of it shines.
TEST(Lights, anExtendedLampIsTheMeanOverItsPlaces) {
  Scene scene;
  const auto web = test::makeWeb([](float, float g) { return g < 0.3f ? 100.0f : 0.0f; }, 90, 90, 1, 0.5f);
  scene.lamps.push_back(test::webLamp({0, 2, 0}, web));
  scene.lamps.push_back(test::pointLamp({5, 2, 0}, 1));
  const Lights lights(scene);
  for (const Vec3 p : {Vec3{0, 0, 0}, Vec3{0.5f, 0, 0.2f}, Vec3{0.9f, 0.5f, 0}, Vec3{1.2f, 1.9f, 0}}) {
    double exact = static_cast<double>(luminance(lights.sampleLamp(1, p, {}).radiance));
    constexpr int kGrid = 400, kSamples = 200'000;
    for (int i = 0; i < kGrid * kGrid; ++i) {
      const Vec2 u{(static_cast<float>(i % kGrid) + 0.5f) / kGrid, (static_cast<float>(i / kGrid) + 0.5f) / kGrid};
      exact += static_cast<double>(luminance(lights.sampleLamp(0, p, u).radiance)) / (kGrid * kGrid);
    }
    double sum = 0, squares = 0;
    for (int i = 0; i < kSamples; ++i) {
      Sampler sampler(static_cast<uint64_t>(i), 0, 3);
      const Vec2 u = sampler.next2();
      const auto v = static_cast<double>(luminance(sampleLocal(lights, {}, p, u, sampler.next1()).radiance));
      sum += v / kSamples, squares += v * v / kSamples;
    }
    EXPECT_NEAR(sum, exact, 4 * std::sqrt((squares - sum * sum) / kSamples) + 2e-3 * exact) << p.x;
  }
}

TEST(Lights, aSunGivesItsIlluminanceWhateverItsSize) {
  for (const double diameterDeg : {0.0, 0.001, 0.01, 0.03, 0.1, 0.533, 5.0, 40.0}) {
    Scene scene;
    scene.suns.push_back({"sun", normalize(Vec3{1, 2, 3}), Vec3(1000), static_cast<float>(rad(diameterDeg) / 2)});
    const Lights lights(scene);
    constexpr int kSide = 64;
    double sum = 0;
    for (int i = 0; i < kSide * kSide; ++i) {
      const LightSample s = lights.sampleSun(
          0, {(static_cast<float>(i % kSide) + 0.5f) / kSide, (static_cast<float>(i / kSide) + 0.5f) / kSide});
      sum += luminance(s.radiance) * dot(s.wi, scene.suns[0].toLight);
    }
    EXPECT_NEAR(sum / (kSide * kSide), 1000, 0.1) << diameterDeg;
  }
}

TEST(Lights, aSunDiscIsSeenInsideItsAngleOnly) {
  for (const double halfDeg : {0.05, 0.2665, 20.0}) {
    Scene scene;
    scene.suns.push_back({"sun", {0, 1, 0}, Vec3(1000), static_cast<float>(rad(halfDeg))});
    const Lights lights(scene);
    float pdf = 0;
    const auto at = [](double angleDeg) {
      return Vec3{static_cast<float>(std::sin(rad(angleDeg))), static_cast<float>(std::cos(rad(angleDeg))), 0};
    };
    const double solidAngle = 4 * std::numbers::pi * std::pow(std::sin(rad(halfDeg) / 2), 2);
    EXPECT_GT(luminance(lights.sunDisc(0, at(0.98 * halfDeg), pdf)), 0) << halfDeg;
    EXPECT_NEAR(pdf * solidAngle, 1, 1e-4) << halfDeg;
    EXPECT_EQ(luminance(lights.sunDisc(0, at(1.02 * halfDeg), pdf)), 0) << halfDeg;
    EXPECT_EQ(pdf, 0) << halfDeg;
  }
}

// Rays of a square of 100 cd/m2 that pass through the square opposite, one metre away: its flux times their form
// factor, which for unit squares is (2 / pi) (ln(2 / sqrt 3) + 2 sqrt 2 atan(1 / sqrt 2) - pi / 2) (Howell, A Catalog
// of Radiation Heat Transfer Configuration Factors, C-11).
TEST(Lights, raysLeaveAnEmissiveMeshByCosine) {
  for (const bool doubleSided : {false, true}) {
    Scene scene;
    Material shining = test::lambertian(0, 100);
    shining.doubleSided = doubleSided;
    test::addRectangle(scene, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}, test::addMaterial(scene, shining), 3);
    const Lights lights(scene);
    constexpr uint32_t kRays = 1 << 20;
    double all = 0, through = 0;
    for (uint32_t i = 0; i < kRays; ++i) {
      Sampler sampler(1, i, 0);
      const LightRay ray = lights.sampleEmitterRay(0, sampler);
      const double lm = static_cast<double>(luminance(ray.fluxLm)) / kRays;
      all += lm;
      const Vec3 there = ray.origin + ray.direction / ray.direction.z;
      if (ray.direction.z > 0 && there.x > 0 && there.x < 1 && there.y > 0 && there.y < 1) through += lm;
    }
    const double side = 100 * kPi,
                 formFactor = 2 / std::numbers::pi *
                              (std::log(2 / std::sqrt(3.0)) + 2 * std::sqrt(2.0) * std::atan(1 / std::sqrt(2.0)) -
                               std::numbers::pi / 2);
    EXPECT_NEAR(all, doubleSided ? 2 * side : side, 1e-3 * side);
    EXPECT_NEAR(through, side * formFactor, 0.01 * side * formFactor);
  }
}

// A square of 100 cd/m2 whose right half has this alpha.
Scene halfSquare(AlphaMode mode, uint8_t alpha) {
  Scene scene;
  Material m = test::lambertian(0.5f, 100);
  m.alphaMode = mode;
  m.baseColorTexture.texture = 0;
  test::addRectangle(scene, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}, test::addMaterial(scene, m));
  scene.meshes[0].uv[0] = {{0, 0}, {1, 0}, {0, 1}, {1, 1}};
  scene.textures.push_back({"half", 64, 1, Wrap::ClampToEdge, Wrap::ClampToEdge, {}});
  for (int x = 0; x < 64; ++x) {
    for (const uint8_t v : {uint8_t{255}, uint8_t{255}, uint8_t{255}, x < 32 ? uint8_t{255} : alpha})
      scene.textures[0].rgba.push_back(v);
  }
  return scene;
}

// Rays and light samples must agree on what shines; holes do not, and a veil as far as it is there.
TEST(Lights, onlyTheOpaquePartOfASurfaceEmits) {
  const std::tuple<AlphaMode, uint8_t, float> cases[] = {{AlphaMode::Mask, 0, 0.0f},
                                                         {AlphaMode::Blend, 0, 0.0f},
                                                         {AlphaMode::Blend, 51, 20.0f},
                                                         {AlphaMode::Opaque, 51, 100.0f}};
  for (const auto& [mode, alpha, expected] : cases) {
    const Scene scene = halfSquare(mode, alpha);
    const Lights lights(scene);
    const Vec3 p{0.5f, 0.5f, 1};
    EXPECT_NEAR(lights.emittedFluxLm(), kPi * (50 + 0.5f * expected), 0.15 * kPi * 100);
    for (int i = 0; i < 256; ++i) {
      const LightSample s =
          lights.sampleEmitters(p, {(static_cast<float>(i % 16) + 0.5f) / 16, (static_cast<float>(i / 16) + 0.5f) / 16},
                                static_cast<float>(i % 2) * 0.5f + 0.25f);
      const float x = p.x - s.wi.x / s.wi.z;
      if (std::abs(x - 0.5f) < 0.02f) continue;
      EXPECT_NEAR(luminance(s.radiance) * s.pdf, x < 0.5f ? 100 : expected, 0.1) << x;
    }
    // What a ray sees at the same places.
    EXPECT_NEAR(luminance(materialAt(scene, scene.meshes[0], {0, 0.75f, 0.1f}).emission), expected, 0.1);
    EXPECT_NEAR(luminance(materialAt(scene, scene.meshes[0], {0, 0.1f, 0.1f}).emission), 100, 0.1);
  }
}

// A square of 100 cd/m2 where its texture is lit: a few texels of many.
Scene spottedSquare(Wrap wrap, int spotTexels, float shift) {
  constexpr int kSide = 512, kFrom = 301;
  Scene scene;
  Material m = test::lambertian(0.5f, 100);
  m.emissionTexture.texture = 0;
  test::addRectangle(scene, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}, test::addMaterial(scene, m));
  for (const Vec2 uv : {Vec2{0, 0}, Vec2{1, 0}, Vec2{0, 1}, Vec2{1, 1}})
    scene.meshes[0].uv[0].push_back({uv.x + shift, uv.y});
  scene.textures.push_back({"spot", kSide, kSide, wrap, wrap, std::vector<uint8_t>(size_t{4} * kSide * kSide)});
  for (int i = 0; i < spotTexels * spotTexels; ++i) {
    const int x = kFrom + i % spotTexels, y = kFrom - 200 + i / spotTexels;
    for (size_t c = 0; c < 4; ++c) scene.textures[0].rgba[4 * static_cast<size_t>(y * kSide + x) + c] = 255;
  }
  return scene;
}

// However small what shines, light samples find it.
TEST(Lights, aSpotOfLightIsNotMissed) {
  for (const Wrap wrap : {Wrap::Repeat, Wrap::MirroredRepeat, Wrap::ClampToEdge}) {
    for (const int texels : {1, 3, 40}) {
      for (const float shift : {0.0f, 2.0f}) {
        if (shift > 0 && wrap == Wrap::ClampToEdge) continue;
        const Scene scene = spottedSquare(wrap, texels, shift);
        const double exact = 100.0 * kPi * texels * texels / (512.0 * 512);
        const double flux = Lights(scene).emittedFluxLm();
        const bool large = texels == 40;
        EXPECT_GT(flux, (large ? 0.9 : 0.09) * exact) << texels << " " << shift;
        if (large) {
          EXPECT_LT(flux, 1.1 * exact) << shift;
        }
      }
    }
    EXPECT_FALSE(Lights(spottedSquare(wrap, 0, 0)).hasEmitters());
  }
}

TEST(SurfacePoint, normalsAreUnitInAnyUnit) {
  for (const float unit : {1e-7f, 1.0f, 1e10f}) {
    Scene scene;
    test::addRectangle(scene, {0, 0, 0}, {unit, 0, 0}, {0, unit, 0}, test::addMaterial(scene, test::lambertian(0.5f)));
    scene.instances[0].worldFromObject = {{1 / unit, 0, 0}, {0, 1 / unit, 0}, {0, 0, 1 / unit}, {}};
    for (const bool smooth : {false, true}) {
      if (smooth) scene.meshes[0].normals.assign(4, {0, 0, 1});
      const SurfacePoint s = surfaceAt(scene, {0, 0, 0.3f, 0.3f, 1, {}}, {0, 0, -1});
      EXPECT_NEAR(s.ng.z, 1, 1e-5f) << unit;
      EXPECT_NEAR(s.ns.z, 1, 1e-5f) << unit;
    }
  }
}

}  // namespace
}  // namespace roomlight
