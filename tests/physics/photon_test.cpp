// Technique photon held against closed forms, with the tolerances that its theory allows: an estimate from k photons
// has a relative standard error of about 1 / sqrt(k), so means over many places are judged; boundaries are where discs
// of photons reach over edges.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "base/parallel.h"
#include "baselines/photon.h"
#include "gather/meters.h"
#include "reference/path_tracer.h"
#include "support/record.h"
#include "support/rooms.h"

namespace roomlight {
namespace {

PhotonSettings small() {
  PhotonSettings s;
  s.width = s.height = 24;
  s.samples = 8;
  s.filterPasses = 0;
  s.photons = 100000, s.causticPhotons = 20000, s.importons = 8192;
  return s;
}

Image render(const Scene& scene, Vec3 eye, const PhotonSettings& settings) {
  const RayScene rays(scene);
  const Lights lights(scene, true);
  const Camera camera = test::cameraAt(eye);
  const PhotonLight light =
      lightPhotons(rays, lights, importonsFrom(camera, settings.width, settings.height), settings);
  return gatherPhotons(rays, lights, light, camera, settings).image;
}

Scene furnace(float rho) {
  Scene scene;
  const int wall = test::addMaterial(scene, test::lambertian(rho, 10));
  test::addRoom(scene, {0, 0, 0}, {4, 2.6f, 3}, std::vector<int>(6, wall));
  return scene;
}

struct Furnace {
  float albedo;
  int finalGather;
  PhotonKernel kernel;
  double tolerance;
};
void PrintTo(const Furnace& f, std::ostream* out) {
  *out << "albedo " << f.albedo << ", " << f.finalGather << " gathering rays, kernel " << static_cast<int>(f.kernel);
}

class PhotonFurnace : public testing::TestWithParam<Furnace> {};

TEST_P(PhotonFurnace, RadianceIsEmissionOverOneMinusAlbedo) {
  PhotonSettings s = small();
  s.finalGather = GetParam().finalGather, s.kernel = GetParam().kernel;
  const float rho = GetParam().albedo;
  const double expected = 10 / (1 - static_cast<double>(rho)),
               measured = test::meanLuminance(render(furnace(rho), {1.7f, 1.4f, 2.6f}, s));
  test::record("Furnace, walls of 10 cd/m² each, luminance",
               fmt::format("albedo {}, {}", rho, s.finalGather ? "final gathering" : "map seen directly"), "photon",
               expected, measured);
  EXPECT_NEAR(measured, expected, expected * GetParam().tolerance);
}
// Edges: the part of a disc that is surface is known to some per cent, and light beyond it is not there to be counted.
INSTANTIATE_TEST_SUITE_P(Settings, PhotonFurnace,
                         testing::Values(Furnace{0.5f, 4, PhotonKernel::Epanechnikov, 0.01},
                                         Furnace{0.5f, 0, PhotonKernel::Epanechnikov, 0.01},
                                         Furnace{0.5f, 0, PhotonKernel::Disc, 0.01},
                                         Furnace{0.5f, 0, PhotonKernel::Cone, 0.01},
                                         Furnace{0.8f, 4, PhotonKernel::Epanechnikov, 0.02},
                                         Furnace{0.8f, 0, PhotonKernel::Epanechnikov, 0.02}));

// Discs taken for surface everywhere, as in the textbook, lose light at edges: what the rays around a place are for.
TEST(PhotonEstimate, LosesLightAtEdgesWithoutRaysAround) {
  PhotonSettings s = small();
  s.finalGather = 0, s.edgeRays = 0;
  EXPECT_LT(test::meanLuminance(render(furnace(0.8f), {1.7f, 1.4f, 2.6f}, s)), 50 * 0.98);
}

// Indirect light in a room against the path tracer's, at meters.
TEST(Photon, MetersAgreeWithPathTracing) {
  Scene scene;
  const int wall = test::addMaterial(scene, test::lambertian(0.6f));
  test::addRoom(scene, {0, 0, 0}, {4, 2.6f, 3}, std::vector<int>(6, wall));
  test::addBox(scene, {1, 0, 1}, {2, 0.8f, 1.6f}, wall);
  scene.lamps.push_back(test::pointLamp({3, 1.9f, 1.5f}, 100));
  const RayScene rays(scene);
  const Lights lights(scene);
  const std::vector<SurfaceElement> elements{{{0.5f, 0, 0.5f}, {0, 1, 0}},
                                             {{3, 0, 2.2f}, {0, 1, 0}},
                                             {{0, 1.2f, 1.5f}, {1, 0, 0}},
                                             {{2, 2.6f, 1.5f}, {0, -1, 0}},
                                             {{0.9f, 0, 1.3f}, {0, 1, 0}}};
  MeterSettings meters;
  meters.tolerance = 0.005;
  const std::vector<MeterReading> expected = measureIlluminance(rays, lights, elements, meters);
  // Gathered: 1 % of noise at meters, thrice that. Seen directly, a single place shows the noise of its k photons, so
  // the mean over maps is judged by its standard error, which the maps tell themselves: pooled over all meters, so that
  // it has 35 degrees of freedom, of which 3.5 are passed once in 800 times. To it comes what a disc's curvature may
  // do, r² / 6 of the second derivatives' mean (Epanechnikov): light changes over 1 m and discs have 0.3 m, 2 %.
  for (const int finalGather : {4, 0}) {
    const int maps = finalGather ? 1 : 8;
    std::vector<double> sums(elements.size()), squares(elements.size());
    for (int map = 0; map < maps; ++map) {
      PhotonSettings s = small();
      // Roulette from the first reflection keeps photons of like power: fewer of them tell as much.
      s.finalGather = finalGather, s.rouletteDepth = 0, s.seed = static_cast<uint64_t>(map);
      const PhotonLight light = lightPhotons(rays, lights, importonsFrom(elements), s);
      meters.mostSamples = finalGather ? meters.mostSamples : 64;
      const std::vector<MeterReading> readings =
          measureIlluminance(rays, lights, PhotonShader(rays, lights, light, s), elements, meters);
      for (size_t i = 0; i < elements.size(); ++i) {
        const double relative =
            static_cast<double>(luminance(readings[i].illuminanceLux) / luminance(expected[i].illuminanceLux));
        sums[i] += relative, squares[i] += relative * relative;
      }
    }
    double variance = 0;  // of one map at one place
    for (size_t i = 0; i < elements.size() && maps > 1; ++i)
      variance += (squares[i] - sums[i] * sums[i] / maps) / (maps - 1) / static_cast<double>(elements.size());
    // Of k photons 1 / sqrt(0.75 k) at most, for part of the light is direct; a variance of 35 degrees of freedom
    // is 1.6 times its mean once in 100 times.
    EXPECT_LT(variance, 1.6 / (0.75 * small().nearest));
    const double tolerance = finalGather ? 0.03 : 0.02 + 3.5 * std::sqrt(variance / maps);
    for (size_t i = 0; i < elements.size(); ++i)
      EXPECT_NEAR(sums[i] / maps, 1, tolerance) << "meter " << i << ", " << finalGather << " gathering rays";
  }
}

// A dark room beside a bright one, under one floor and one ceiling, behind a wall without thickness: nothing comes
// through.
TEST(Photon, WallsWithoutThicknessAreTight) {
  Scene scene;
  const int wall = test::addMaterial(scene, test::lambertian(0.7f));
  test::addRoom(scene, {0, 0, 0}, {4, 2.6f, 3}, std::vector<int>(6, wall));
  test::addRectangle(scene, {2, 0, 0}, {0, 2.6f, 0}, {0, 0, 3}, wall);
  scene.lamps.push_back(test::pointLamp({3, 1.9f, 1.5f}, 1000));
  for (const int finalGather : {4, 0}) {
    PhotonSettings s = small();
    s.finalGather = finalGather;
    const double dark = test::meanLuminance(render(scene, {1.0f, 1.3f, 2.9f}, s)),
                 bright = test::meanLuminance(render(scene, {3.0f, 1.3f, 2.9f}, s));
    EXPECT_GT(bright, 10);
    EXPECT_LT(dark, 2e-4 * bright) << finalGather << " gathering rays";
  }
}

// A mirror throws the light of a lamp on the ceiling, which is where the caustic map alone knows of it: as from the
// lamp's image behind the mirror.
TEST(Photon, CausticOfAMirrorIsThatOfTheImage) {
  Scene scene;
  const int wall = test::addMaterial(scene, test::lambertian(0.001f));
  test::addRoom(scene, {0, 0, 0}, {4, 3, 4}, std::vector<int>(6, wall));
  Material mirror;
  mirror.metallic = 1, mirror.roughness = 0;
  test::addRectangle(scene, {1.5f, 0.01f, 2.5f}, {1, 0, 0}, {0, 0, -1}, test::addMaterial(scene, mirror));
  scene.lamps.push_back(test::pointLamp({2, 1, 2}, 100));
  const RayScene rays(scene);
  const Lights lights(scene);
  const std::vector<SurfaceElement> elements{{{2, 3, 2}, {0, -1, 0}}};
  PhotonSettings s = small();
  const PhotonLight light = lightPhotons(rays, lights, importonsFrom(elements), s);
  MeterSettings meters;
  meters.mostSamples = meters.fewestSamples;
  const double found = static_cast<double>(luminance(
      measureIlluminance(rays, lights, PhotonShader(rays, lights, light, s), elements, meters)[0].illuminanceLux));
  const double direct = 100.0 / 4, image = 100.0 / (3.98 * 3.98);
  EXPECT_NEAR(found, direct + image, 0.1 * image + 0.02 * direct);
}

TEST(Photon, IsTheSameForAnyNumberOfThreads) {
  Scene scene = furnace(0.5f);
  scene.lamps.push_back(test::pointLamp({3, 1.9f, 1.5f}, 100));
  scene.sky.luminanceCdM2 = Vec3(100);
  PhotonSettings s = small();
  s.photons = 20000;
  Image one, two;
  withThreads(1, [&] { one = render(scene, {1.7f, 1.4f, 2.6f}, s); });
  withThreads(2, [&] { two = render(scene, {1.7f, 1.4f, 2.6f}, s); });
  ASSERT_EQ(one.pixels.size(), two.pixels.size());
  for (size_t i = 0; i < one.pixels.size(); ++i) ASSERT_EQ(one.pixels[i], two.pixels[i]);
}

}  // namespace
}  // namespace roomlight
