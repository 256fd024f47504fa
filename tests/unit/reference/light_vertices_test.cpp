#include "reference/light_vertices.h"

#include <gtest/gtest.h>

#include "base/parallel.h"
#include "unit/reference/shaded_lamp.h"

namespace roomlight {
namespace {

using test::meanLuminance, test::render, test::room, test::shadedLamp, test::standardError;

TEST(LightVertices, FirstVerticesHoldAllTheLampsLight) {
  Scene scene = room(test::lambertian(0));
  scene.lamps.push_back(test::pointLamp({1, 2, 1}, 50));
  scene.lamps.push_back(test::pointLamp({3, 1, 2}, 10));
  Lamp spot = test::pointLamp({2, 2.5f, 2}, 200);
  spot.kind = LampKind::Spot;
  spot.direction = {0, -1, 0};
  spot.innerConeRad = spot.outerConeRad = 0.5f;
  scene.lamps.push_back(spot);
  const RayScene rays(scene);
  const Lights lights(scene);
  LightVertices vertices(rays, lights);
  vertices.trace(100000, 0, 1);
  double lumens = 0;
  for (const LightVertex& v : vertices.all()) lumens += luminance(v.flux);
  const double expected = 4 * kPi * 60 + 2 * kPi * (1 - std::cos(0.5f)) * 200;
  EXPECT_NEAR(lumens, expected, 0.01 * expected);
}

TEST(LightVertices, LieAsDenselyAsPredicted) {
  Scene scene = room(test::lambertian(0));
  scene.lamps.push_back(test::pointLamp({1, 0.5f, 1}, 50));
  scene.lamps.push_back(test::pointLamp({3, 2, 2}, 20));
  const RayScene rays(scene);
  const Lights lights(scene);
  LightVertices vertices(rays, lights);
  const int paths = 400000;
  vertices.trace(paths, 0, 3);
  // The floor in half metres.
  double counts[8][8] = {}, chi2 = 0;
  for (const LightVertex& v : vertices.all()) {
    if (v.p.y < 1e-3f && v.ng.y > 0.9f)
      counts[std::min(7, static_cast<int>(v.p.z * 2))][std::min(7, static_cast<int>(v.p.x * 2))] += 1;
  }
  for (int j = 0; j < 8; ++j) {
    for (int i = 0; i < 8; ++i) {
      double expected = 0;
      for (int k = 0; k < 400; ++k) {
        const float x = 0.5f * (static_cast<float>(i) + (static_cast<float>(k % 20) + 0.5f) / 20),
                    z = 0.5f * (static_cast<float>(j) + (static_cast<float>(k / 20) + 0.5f) / 20);
        expected += lights.lampDensity({x, 0, z}, {0, 1, 0}) * 0.25 / 400 * paths;
      }
      chi2 += (counts[j][i] - expected) * (counts[j][i] - expected) / expected;
    }
  }
  EXPECT_LT(chi2, 104);  // 64 degrees of freedom, chance of more 0.001
}

TEST(PathTracer, ClosedShadeLetsNoLightOut) {
  Scene scene = room(test::lambertian(0.6f));
  test::addRoom(scene, {1.6f, 1.8f, 1.2f}, {1.9f, 2.1f, 1.5f},
                std::vector<int>(6, test::addMaterial(scene, test::lambertian(0.7f))));
  scene.lamps.push_back(test::pointLamp({1.87f, 1.95f, 1.35f}, 100));
  EXPECT_LT(meanLuminance(render(scene, 64, true).image), 1e-3);
}

class Shade : public testing::TestWithParam<std::tuple<float, float>> {};

TEST_P(Shade, MeanIsThatOfPathsWithoutConnections) {
  const auto [roughness, metallic] = GetParam();
  Material shade = test::lambertian(0.7f);
  shade.roughness = roughness;
  shade.metallic = metallic;
  const Scene scene = shadedLamp(shade);
  // Several renders, because the error of one depends on its few brightest pixels.
  constexpr int kRenders = 4;
  double difference = 0, variance = 0, plainError = 0, connectedError = 0;
  for (uint64_t seed = 0; seed < kRenders; ++seed) {
    const PathResult plain = render(scene, 1024, false, seed), connected = render(scene, 256, true, seed);
    const double p = standardError(plain), c = standardError(connected);
    plainError += p, connectedError += c;
    difference += (meanLuminance(connected.image) - meanLuminance(plain.image)) / kRenders;
    variance += (p * p + c * c) / (kRenders * kRenders);
  }
  EXPECT_LT(connectedError, plainError);
  EXPECT_NEAR(difference, 0, 3.5 * std::sqrt(variance));
}
INSTANTIATE_TEST_SUITE_P(Materials, Shade,
                         testing::Values(std::tuple{1.0f, 0.0f}, std::tuple{0.35f, 1.0f}, std::tuple{0.25f, 1.0f}));

TEST(PathTracer, ConnectionsKeepTheMeanWithinOnePercent) {
  const Scene scene = shadedLamp(test::lambertian(0.5f), 0.5f, 1);
  const double m = meanLuminance(render(scene, 4096, false).image);
  EXPECT_NEAR(meanLuminance(render(scene, 1024, true).image), m, 0.01 * m);
}

// A diffuse surface under a perfect polish scatters like any other, and is connected like any other.
TEST(PathTracer, ConnectionsKeepTheMeanOfAPolishedRoom) {
  Scene scene = shadedLamp(test::lambertian(0.5f), 0.5f, 1);
  scene.materials[0].specular = 1;
  scene.materials[0].roughness = 0;
  const PathResult plain = render(scene, 2048, false), connected = render(scene, 512, true);
  const double sigma = std::hypot(standardError(plain), standardError(connected)), m = meanLuminance(plain.image);
  EXPECT_LT(sigma, 0.01 * m);
  EXPECT_NEAR(meanLuminance(connected.image), m, 3.5 * sigma);
}

TEST(PathTracer, ConnectionsLowerTheNoiseOfAShadedLamp) {
  const Scene scene = shadedLamp(test::lambertian(0.7f));
  EXPECT_LT(render(scene, 64, true).noise, 0.6 * render(scene, 64, false).noise);
}

TEST(PathTracer, PictureDoesNotDependOnThreads) {
  const Scene scene = shadedLamp(test::lambertian(0.7f));
  Image one, two;
  withThreads(1, [&] { one = render(scene, 4, true).image; });
  withThreads(2, [&] { two = render(scene, 4, true).image; });
  for (size_t i = 0; i < one.pixels.size(); ++i) ASSERT_TRUE(one.pixels[i] == two.pixels[i]) << "pixel " << i;
}

}  // namespace
}  // namespace roomlight
