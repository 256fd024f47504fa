// Light in layers: what lamps, suns and sky give apart adds up to the whole picture, and each part is the light of that lamp alone.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "engine/render.h"
#include "scene/primitives.h"

namespace roomlight {
namespace {

constexpr int kWidth = 48, kHeight = 32;

Lamp lampAt(const std::string& name, Vec3 position, Vec3 intensityCd) {
  Lamp lamp;
  lamp.name = name;
  lamp.position = position;
  lamp.intensityCd = intensityCd;
  return lamp;
}

Camera camera() {
  const Vec3 eye{3.6f, 1.5f, 2.7f}, z = normalize(eye - Vec3{0.6f, 0.9f, 0.4f}), x = normalize(cross(Vec3{0, 1, 0}, z));
  Camera out;
  out.worldFromCamera = {x, cross(z, x), z, eye};
  out.yFovRad = 1.2f;
  return out;
}

// A room of 4 x 2.6 x 3 m with a window in the wall x = 0, a glossy box, a pane and a glowing globe; three lamps in it, one in a cellar without doors.
Scene home() {
  Scene scene;
  const int white = addMaterial(scene, lambertian(0.7f)), floor = addMaterial(scene, lambertian(0.4f));
  Material gloss = lambertian(0.3f);
  gloss.specular = 1, gloss.roughness = 0.25f;
  Material pane = lambertian(0.9f);
  pane.transmission = 1, pane.roughness = 0, pane.specular = 1;
  const Vec3 o{0.013f, 0.007f, 0.021f};
  addRectangle(scene, o, {0, 0, 3}, {4, 0, 0}, floor, 4);
  addRectangle(scene, o + Vec3{0, 2.6f, 0}, {4, 0, 0}, {0, 0, 3}, white, 4);
  addRectangle(scene, o, {4, 0, 0}, {0, 2.6f, 0}, white, 4);
  addRectangle(scene, o + Vec3{0, 0, 3}, {0, 2.6f, 0}, {4, 0, 0}, white, 4);
  addRectangle(scene, o + Vec3{4, 0, 0}, {0, 0, 3}, {0, 2.6f, 0}, white, 4);
  addRectangle(scene, o, {0, 0.9f, 0}, {0, 0, 3}, white, 4);
  addRectangle(scene, o + Vec3{0, 2.1f, 0}, {0, 0.5f, 0}, {0, 0, 3}, white, 4);
  addRectangle(scene, o + Vec3{0, 0.9f, 0}, {0, 1.2f, 0}, {0, 0, 0.8f}, white, 4);
  addRectangle(scene, o + Vec3{0, 0.9f, 2.2f}, {0, 1.2f, 0}, {0, 0, 0.8f}, white, 4);
  addBox(scene, {1.2f, 0.01f, 0.5f}, {1.9f, 0.7f, 1.1f}, addMaterial(scene, gloss));
  addRectangle(scene, {2.2f, 0.02f, 0.5f}, {0.6f, 0, 0.4f}, {0, 1.1f, 0}, addMaterial(scene, pane));
  const size_t globe = scene.instances.size();
  addSphere(scene, {0.7f, 0.5f, 2.3f}, 0.12f, addMaterial(scene, lambertian(0, 900)), 12);
  scene.instances[globe].name = "Globe";
  const std::vector<int> cellar(6, white);
  addRoom(scene, {8, 0, 0}, {11, 2.5f, 3}, cellar);
  scene.lamps = {lampAt("Ceiling", {2, 2.2f, 1.5f}, {110, 100, 80}), lampAt("Red. \"spot\"", {0.6f, 1.9f, 0.5f}, {30, 6, 3}), lampAt("Dim", {3.4f, 0.6f, 0.6f}, {1.5f, 2, 3}),
                 lampAt("Cellar", {9.5f, 2, 1.5f}, {200, 200, 200})};
  scene.suns = {{"", normalize(Vec3{-1, 0.7f, 0.25f}), {20000, 19000, 17000}, 0.00465f}};
  scene.sky.luminanceCdM2 = {1500, 2000, 2600};
  return scene;
}

RenderSettings settingsOf(const std::string& technique, int samples = 0) {
  RenderSettings s;
  s.technique = technique;
  s.width = kWidth, s.height = kHeight;
  s.samples = samples;
  s.voxel.voxelSizeM = 0.08f;
  return s;
}

Rendered rendered(const Scene& scene, RenderSettings settings, bool layers) {
  settings.layers = layers;
  Result<Rendered> r = render(scene, camera(), settings);
  EXPECT_TRUE(r) << r.error();
  return std::move(r).value();
}

double mean(const Image& image) {
  double sum = 0;
  for (const Vec3 p : image.pixels) sum += static_cast<double>(luminance(p));
  return sum / static_cast<double>(image.pixels.size());
}

// Root mean square of the differences of blocks of 8 x 8 pixels, relative to the mean.
double blockError(const Image& a, const Image& b) {
  double squares = 0;
  int blocks = 0;
  for (int y = 0; y + 8 <= a.height; y += 8) {
    for (int x = 0; x + 8 <= a.width; x += 8, ++blocks) {
      double d = 0;
      for (int i = 0; i < 64; ++i) d += static_cast<double>(luminance(a.at(x + i % 8, y + i / 8) - b.at(x + i % 8, y + i / 8))) / 64;
      squares += d * d;
    }
  }
  return std::sqrt(squares / blocks) / std::max(mean(b), 1e-20);
}

// How far means may be off by chance, relatively, where blocks are by so much: three standard deviations, and one per cent.
double likely(double error) { return 3 * error / std::sqrt(kWidth / 8 * kHeight / 8) + 0.01; }

void expectSum(const Rendered& layered, const Image& plain) {
  ASSERT_TRUE(layered.image.pixels == plain.pixels) << "layers changed the picture itself";
  double worst = 0;
  for (size_t i = 0; i < plain.pixels.size(); ++i) {
    Vec3 sum;
    for (const RenderedLayer& l : layered.layers) {
      sum += l.image.pixels[i];
      ASSERT_GE(minComponent(l.image.pixels[i]), 0) << l.light.name;
    }
    for (int c = 0; c < 3; ++c) worst = std::max(worst, std::abs(static_cast<double>(sum[c] - plain.pixels[i][c])) / std::max(1e-12, static_cast<double>(plain.pixels[i][c])));
  }
  EXPECT_LE(worst, 1e-5);
}

const RenderedLayer& layerOf(const Rendered& r, const std::string& name) {
  for (const RenderedLayer& l : r.layers) {
    if (l.light.name == name) return l;
  }
  ADD_FAILURE() << "no layer " << name;
  return r.layers.front();
}

// The scene with nothing but one of its lights.
Scene alone(const std::string& name) {
  Scene scene = home();
  if (name != "sun") scene.suns.clear();
  if (name != "sky") scene.sky = {};
  std::erase_if(scene.lamps, [&](const Lamp& l) { return l.name != name; });
  for (const Instance& i : scene.instances) {
    Material& m = scene.materials[static_cast<size_t>(scene.meshes[static_cast<size_t>(i.mesh)].material)];
    if (!isBlack(m.emission) && i.name != name) m.emission = {};
  }
  return scene;
}

class Layers : public testing::TestWithParam<std::string> {};

TEST_P(Layers, addUpToThePlainPicture) {
  const RenderSettings settings = settingsOf(GetParam(), GetParam() == "path" ? 8 : 0);
  const Rendered layered = rendered(home(), settings, true);
  ASSERT_EQ(layered.layers.size(), 7u);
  expectSum(layered, rendered(home(), settings, false).image);
}

TEST_P(Layers, areDarkBehindWalls) {
  const Rendered layered = rendered(home(), settingsOf(GetParam(), GetParam() == "path" ? 8 : 0), true);
  for (const Vec3 p : layerOf(layered, "Cellar").image.pixels) ASSERT_TRUE(isBlack(p));
}

// Against paths of that light alone, which know nothing of layers.
TEST_P(Layers, eachIsThatLightAlone) {
  const bool isPath = GetParam() == "path";
  const Rendered layered = rendered(home(), settingsOf(GetParam(), isPath ? 64 : 0), true);
  for (const std::string name : {"Ceiling", "Red. \"spot\"", "Dim", "Globe", "sun", "sky"}) {
    RenderSettings reference = settingsOf("path", 256);
    reference.seed = 17;
    const Image expected = rendered(alone(name), reference, false).image, own = rendered(alone(name), settingsOf(GetParam(), isPath ? 64 : 0), false).image;
    const Image& layer = layerOf(layered, name).image;
    const double error = blockError(layer, expected), errorAlone = blockError(own, expected);
    fmt::print("{} {}: mean {:.4f} of {:.4f}, block error {:.4f}, rendered alone {:.4f} (mean {:.4f})\n", GetParam(), name, mean(layer), mean(expected), error, errorAlone, mean(own));
    EXPECT_NEAR(mean(layer), mean(expected), likely(error) * mean(expected)) << name;
    // Technique path asks one lamp at a time: its layers are right, but a dim lamp's has more noise.
    if (!isPath) {
      EXPECT_LE(error, 1.3 * errorAlone + 0.03) << name;
    }
  }
}

TEST_P(Layers, mixLikeDimmedLamps) {
  const bool isPath = GetParam() == "path";
  const Rendered layered = rendered(home(), settingsOf(GetParam(), isPath ? 64 : 0), true);
  Scene dimmed = home();
  dimmed.suns.clear(), dimmed.sky = {};
  dimmed.lamps[0].intensityCd *= 0.2f;
  dimmed.lamps[1].intensityCd *= Vec3{0.5f, 2, 8};  // another colour
  Image mix(kWidth, kHeight);
  for (size_t i = 0; i < mix.pixels.size(); ++i) {
    mix.pixels[i] = layerOf(layered, "Ceiling").image.pixels[i] * 0.2f + layerOf(layered, "Red. \"spot\"").image.pixels[i] * Vec3{0.5f, 2, 8} + layerOf(layered, "Dim").image.pixels[i] +
                    layerOf(layered, "Globe").image.pixels[i];
  }
  RenderSettings reference = settingsOf("path", 256);
  reference.seed = 17;
  const Image expected = rendered(dimmed, reference, false).image, own = rendered(dimmed, settingsOf(GetParam(), isPath ? 64 : 0), false).image;
  const double error = blockError(mix, expected), errorAlone = blockError(own, expected);
  fmt::print("{} mix: mean {:.4f} of {:.4f}, block error {:.4f}, rendered so {:.4f}\n", GetParam(), mean(mix), mean(expected), error, errorAlone);
  EXPECT_NEAR(mean(mix), mean(expected), likely(error) * mean(expected));
  EXPECT_LE(error, 1.3 * errorAlone + 0.03);
}

INSTANTIATE_TEST_SUITE_P(Techniques, Layers, testing::Values("hybrid", "path"), [](const auto& which) { return which.param; });

TEST(LayersOfManyLamps, addUpAndHaveNoMoreNoise) {
  Scene scene = home();
  scene.suns.clear(), scene.sky = {};
  for (int i = 0; i < 8; ++i) scene.lamps.push_back(lampAt(fmt::format("row {}", i), {0.4f + 0.4f * static_cast<float>(i), 2.4f, 2.5f}, Vec3(4 + static_cast<float>(i))));
  const RenderSettings settings = settingsOf("hybrid");
  const Rendered layered = rendered(scene, settings, true);
  ASSERT_EQ(layered.layers.size(), 13u);
  expectSum(layered, rendered(scene, settings, false).image);
  Scene one = alone("Dim");
  RenderSettings reference = settingsOf("path", 256);
  const Image expected = rendered(one, reference, false).image;
  EXPECT_LE(blockError(layerOf(layered, "Dim").image, expected), 0.08);
}

TEST(LayersOfManyLamps, groupsAndNamesAreOne) {
  Scene scene = home();
  scene.lamps[0].group = scene.lamps[2].group = "Evening";
  scene.lamps[1].name = "Globe";
  const Rendered layered = rendered(scene, settingsOf("path", 1), true);
  ASSERT_EQ(layered.layers.size(), 5u);
  EXPECT_EQ(layered.layers[0].light.name, "Evening");
  EXPECT_EQ(layered.layers[0].light.kind, LayerKind::Group);
  EXPECT_EQ(layered.layers[1].light.name, "Globe");
}

TEST(LayersOfManyLamps, refusedWhereTheyCannotBeKept) {
  RenderSettings settings = settingsOf("cone");
  settings.layers = true;
  const auto cone = render(home(), camera(), settings);
  ASSERT_FALSE(cone);
  EXPECT_NE(cone.error().find("hybrid or path"), std::string::npos) << cone.error();
  Scene scene = home();
  for (int i = 0; i < 80; ++i) scene.lamps.push_back(lampAt(fmt::format("row {}", i), {0.4f, 2.4f, 2.5f}, Vec3(4)));
  settings.technique = "hybrid";
  const auto many = render(scene, camera(), settings);
  ASSERT_FALSE(many);
  EXPECT_NE(many.error().find("group"), std::string::npos) << many.error();
}

}  // namespace
}  // namespace roomlight
