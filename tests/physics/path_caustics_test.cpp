// What polished surfaces throw on others, in pictures by `path`: closed forms, and nothing found twice.
#include <gtest/gtest.h>

#include "base/parallel.h"
#include "reference/path_tracer.h"
#include "support/polished_strip.h"
#include "support/record.h"
#include "trace/light_layers.h"

namespace roomlight {
namespace {

using test::Strip;

PathSettings settingsOf(int width, int height, int samples) {
  PathSettings s;
  s.width = width, s.height = height, s.samples = samples;
  return s;
}

Image pictureOf(const Scene& scene, const Camera& camera, const PathSettings& settings) {
  return pathTrace(RayScene(scene), Lights(scene), camera, settings).image;
}

test::ThrownLight thrownLight(const test::Thrown& t, const Camera& camera, const PathSettings& settings) {
  Strip with(true, t.pane), without(false, t.pane);
  t.light(with.scene), t.light(without.scene);
  return {t, camera, pictureOf(with.scene, camera, settings), pictureOf(without.scene, camera, settings)};
}

class PolishedStripByPaths : public testing::TestWithParam<test::Thrown> {};

TEST_P(PolishedStripByPaths, throwsLightAsFromTheImage) {
  const test::Thrown& t = GetParam();
  const test::ThrownLight found = thrownLight(t, Strip::camera(), settingsOf(Strip::kPixels, Strip::kPixels, 128));
  test::record("Floor under a strip of polished metal, part of the direct light that it adds", t.name, "path",
               found.expected, found.mean);
  EXPECT_NEAR(found.mean, found.expected, 0.01 * found.expected + 0.004);
  EXPECT_LE(found.spread, 0.25);  // photons in single pixels, and the noise of a bulb
  EXPECT_LE(found.beside, 0.02);
}
INSTANTIATE_TEST_SUITE_P(Lights, PolishedStripByPaths, testing::ValuesIn(test::thrown()));

test::Thrown pointLamp() { return test::thrown()[3]; }

TEST(PathCaustics, everyProjectionSeesThem) {
  Camera orthographic = Strip::camera(), panorama = Strip::camera();
  orthographic.projection = Projection::Orthographic, orthographic.yMagM = Strip::kHalfM;
  panorama.projection = Projection::Panorama;
  panorama.worldFromCamera = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {Strip::kMiddleX, 0.9f, 0}};
  for (const auto& [camera, width] : {std::pair(orthographic, 96), std::pair(panorama, 256)}) {
    const test::ThrownLight found = thrownLight(pointLamp(), camera, settingsOf(width, width == 96 ? 96 : 128, 64));
    EXPECT_NEAR(found.mean, found.expected, 0.015 * found.expected) << width;
    EXPECT_LE(found.beside, 0.01) << width;
  }
}

TEST(PathCaustics, areInFalseColoursAndInTheLayerOfTheirLamp) {
  PathSettings settings = settingsOf(Strip::kPixels, Strip::kPixels, 32);
  settings.white = true;
  const test::ThrownLight white = thrownLight(pointLamp(), Strip::camera(), settings);
  EXPECT_NEAR(white.mean, white.expected, 0.015 * white.expected);
  // On what is black, too.
  std::vector<Image> onBlack;
  for (const bool mirror : {true, false}) {
    Strip strip(mirror);
    pointLamp().light(strip.scene);
    strip.scene.materials.front().baseColor = Vec3(0);
    onBlack.push_back(pictureOf(strip.scene, Strip::camera(), settings));
  }
  const test::ThrownLight black(pointLamp(), Strip::camera(), onBlack[0], onBlack[1]);
  EXPECT_NEAR(black.mean, black.expected, 0.015 * black.expected);

  std::vector<Image> lampsLight;
  for (const bool mirror : {true, false}) {
    Strip strip(mirror);
    pointLamp().light(strip.scene);
    Sun sun;
    sun.toLight = test::kSunward, sun.illuminanceLux = Vec3(50);
    strip.scene.suns = {sun};
    const Lights lights(strip.scene);
    PathSettings apart = settingsOf(Strip::kPixels, Strip::kPixels, 32);
    apart.layers = std::make_shared<LightLayers>(layersOf(strip.scene, lights).value());
    lampsLight.push_back(pathTrace(RayScene(strip.scene), lights, Strip::camera(), apart).layers.front());
  }
  const test::ThrownLight lamps(pointLamp(), Strip::camera(), lampsLight[0], lampsLight[1]);
  EXPECT_NEAR(lamps.mean, lamps.expected, 0.015 * lamps.expected);
}

TEST(PathCaustics, areTheSameWithAnyNumberOfThreads) {
  Strip strip(true, true);
  pointLamp().light(strip.scene);
  Image one, two;
  withThreads(1, [&] { one = pictureOf(strip.scene, Strip::camera(), settingsOf(64, 64, 2)); });
  withThreads(2, [&] { two = pictureOf(strip.scene, Strip::camera(), settingsOf(64, 64, 2)); });
  for (size_t i = 0; i < one.pixels.size(); ++i) ASSERT_EQ(one.pixels[i], two.pixels[i]) << i;
}

Material metalOf(float roughness) {
  Material m;
  m.metallic = 1, m.roughness = roughness, m.baseColor = Vec3(0.9f);
  return m;
}

Camera cameraAt(Vec3 eye, Vec3 target, float yFovRad) {
  Camera camera;
  const Vec3 back = normalize(eye - target), right = normalize(cross({0, 1, 0}, back));
  camera.worldFromCamera = {right, cross(back, right), back, eye};
  camera.yFovRad = yFovRad;
  return camera;
}

// A varnished floor by a ball of metal: paths keep what the varnish reflects of the ball's light, photons bring the
// rest, together as much as paths find alone where they can.
TEST(PathCaustics, shareTheLightWithGlossyPaths) {
  Scene scene;
  Material varnish = test::lambertian(0.4f);
  varnish.specular = 1, varnish.roughness = 0.3f;
  test::addRoom(scene, {0, 0, 0}, {3, 2.4f, 3}, std::vector<int>(6, test::addMaterial(scene, varnish)));
  test::addSphere(scene, {1.5f, 0.6f, 1.5f}, 0.4f, test::addMaterial(scene, metalOf(0.19f)));
  test::addSphere(scene, {0.7f, 1.2f, 1.9f}, 0.1f, test::addMaterial(scene, test::lambertian(0, 3'000)));
  const Camera camera = cameraAt({2.6f, 1.4f, 2.6f}, {1.0f, 0, 1.7f}, 0.7f);
  PathSettings settings = settingsOf(32, 32, 768);
  const double together = test::meanLuminance(pictureOf(scene, camera, settings));
  settings.caustics = false;
  const double alone = test::meanLuminance(pictureOf(scene, camera, settings));
  EXPECT_NEAR(together, alone, 0.01 * alone);
}

// Panes that light shines through and is reflected by, and metal, in walls that shine: all as bright as without.
TEST(PathCaustics, keepTheFurnace) {
  Scene scene;
  const int wall = test::addMaterial(scene, test::lambertian(0.5f, 10));
  Material mirror = metalOf(0.05f), glass;
  mirror.baseColor = Vec3(1);
  glass.transmission = 1, glass.metallic = 0, glass.roughness = 0.1f, glass.baseColor = Vec3(1);
  test::addRoom(scene, {0, 0, 0}, {4, 2.6f, 3}, std::vector<int>(6, wall));
  test::addBox(scene, {1.2f, 0.6f, 1.0f}, {2.0f, 0.65f, 1.9f}, test::addMaterial(scene, mirror));
  test::addRectangle(scene, {2.4f, 0.2f, 0.5f}, {0, 0, 1.5f}, {0, 1.2f, 0}, test::addMaterial(scene, glass));
  const double found = test::meanLuminance(
      pictureOf(scene, cameraAt({3.3f, 1.4f, 2.6f}, {1.6f, 0.4f, 1.3f}, 1.0f), settingsOf(32, 32, 256)));
  test::record("Furnace, walls of 10 cd/m² each, luminance", "polished metal and a pane, albedo 0.5", "path", 20,
               found);
  EXPECT_NEAR(found, 20, 0.1);
}

}  // namespace
}  // namespace roomlight
