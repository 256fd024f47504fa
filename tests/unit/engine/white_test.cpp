// White pictures (PictureWish::white) are illuminance over pi, whatever the surface is made of.
#include <gtest/gtest.h>

#include <cmath>

#include "engine/lit_scene.h"
#include "gather/quick_frames.h"
#include "support/rooms.h"
#include "support/techniques.h"

namespace roomlight {
namespace {

constexpr int kStrips = 4, kStripPixels = 16, kWidth = kStrips * kStripPixels, kHeight = 16;

// A grey room, its floor in strips beside one another: matt, black, shining wood, metal.
Scene strips() {
  Scene scene;
  const int grey = test::addMaterial(scene, test::lambertian(0.6f));
  test::addRoom(scene, {0, 0, 0}, {4, 2.6f, 4}, std::vector<int>(6, grey));
  for (int i = 0; i < kStrips; ++i) {
    Material m = test::lambertian(0.5f);
    if (i == 1) m.baseColor = Vec3(0.001f);
    if (i >= 2) m.specular = 1, m.roughness = i == 2 ? 0.1f : 0.2f;
    if (i == 2) m.baseColor = {0.3f, 0.15f, 0.05f};
    if (i == 3) m.metallic = 1, m.baseColor = Vec3(0.9f);
    const float z = 1 + 0.5f * static_cast<float>(i);
    test::addRectangle(scene, {0.5f, 0.01f, z + 0.5f}, {3, 0, 0}, {0, 0, -0.5f}, test::addMaterial(scene, m));
  }
  scene.lamps = {test::pointLamp({2.1f, 2.2f, 1.9f}, 80)};
  return scene;
}

// Down on the strips, each across a quarter of the picture: +x is away from the eye's feet.
Camera fromAbove() {
  Camera camera;
  camera.worldFromCamera = {{0, 0, 1}, {1, 0, 0}, {0, 1, 0}, {2, 1.8f, 2}};
  camera.yFovRad = 2 * std::atan(0.25f / 1.8f);
  return camera;
}

// Mean lx of a strip, of pixels away from its edges.
double luxOf(const Image& picture, int strip) {
  double sum = 0;
  int count = 0;
  for (int y = 2; y < kHeight - 2; ++y) {
    for (int x = strip * kStripPixels + 3; x < (strip + 1) * kStripPixels - 3; ++x)
      sum += static_cast<double>(kPi * luminance(picture.pixels[static_cast<size_t>(y * kWidth + x)])), ++count;
  }
  return sum / count;
}

class WhiteStrips : public ::testing::Test {
 protected:
  Scene scene_ = strips();
  RenderStats stats_;
  RenderProgress silent_;
  Stages stages_{silent_, stats_};

  std::unique_ptr<LitScene> lit(const std::string& technique) {
    RenderSettings s;
    s.technique = technique;
    s.samples = technique == "path" ? 64 : 8;
    s.voxel.voxelSizeM = 0.15f;
    s.radiance.links = 64;
    return std::move(lightScene(scene_, s, stages_).value());
  }
  // By the meter, on what luxOf() sees.
  static double metered(const LitScene& lit, int strip) {
    std::vector<SurfaceElement> places;
    for (int i = 0; i < 9; ++i)
      places.push_back({{1.88f + 0.12f * static_cast<float>(i / 3), 0.011f,
                         1.15f + 0.1f * static_cast<float>(i % 3) + 0.5f * static_cast<float>(strip)},
                        {0, 1, 0}});
    double sum = 0;
    for (const MeterReading& r : lit.illuminance(places, {})) sum += static_cast<double>(luminance(r.illuminanceLux));
    return sum / static_cast<double>(places.size());
  }
};

class WhiteBy : public WhiteStrips, public ::testing::WithParamInterface<std::string> {};

TEST_P(WhiteBy, picturesAreIlluminance) {
  const auto lit = this->lit(GetParam());
  PictureWish wish;
  wish.width = kWidth, wish.height = kHeight;
  const Image seen = lit->pictureOf(fromAbove(), wish);
  wish.white = true;
  const Image white = lit->pictureOf(fromAbove(), wish);
  for (int i = 0; i < kStrips; ++i) EXPECT_NEAR(luxOf(white, i) / metered(*lit, i), 1, 0.06) << "strip " << i;
  EXPECT_LT(luxOf(seen, 1), 0.1 * luxOf(white, 1));  // the picture itself shows it black
}

INSTANTIATE_TEST_SUITE_P(Techniques, WhiteBy, ::testing::ValuesIn(test::validatedTechniques()),
                         [](const auto& test) { return test.param; });

TEST_F(WhiteStrips, quickFramesAreIlluminance) {
  const auto lit = this->lit("hybrid");
  const std::shared_ptr<const SlotSnapshot> light = lit->snapshot();
  const std::unordered_map<uint32_t, Affine> moved;
  QuickFrames frames;
  const Image white = frames.make({lit->rays(), lit->lights(), *light, moved, true}, fromAbove(), kWidth, kHeight, 1e5);
  for (int i = 0; i < kStrips; ++i) EXPECT_NEAR(luxOf(white, i) / metered(*lit, i), 1, 0.12) << "strip " << i;
}

}  // namespace
}  // namespace roomlight
