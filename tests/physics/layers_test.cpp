// Light in layers: what lamps, suns and sky give apart adds up to the whole picture, and each part is the light of that
// lamp alone.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <map>

#include "engine/render.h"
#include "scene/primitives.h"
#include "support/techniques.h"

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

// A room of 4 x 2.6 x 3 m with a window in the wall x = 0, a glossy box, a pane and a glowing globe; three lamps in it,
// one in a cellar without doors.
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
  scene.lamps = {lampAt("Ceiling", {2, 2.2f, 1.5f}, {110, 100, 80}),
                 lampAt("Red. \"spot\"", {0.6f, 1.9f, 0.5f}, {30, 6, 3}),
                 lampAt("Dim", {3.4f, 0.6f, 0.6f}, {1.5f, 2, 3}), lampAt("Cellar", {9.5f, 2, 1.5f}, {200, 200, 200})};
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
      for (int i = 0; i < 64; ++i)
        d += static_cast<double>(luminance(a.at(x + i % 8, y + i / 8) - b.at(x + i % 8, y + i / 8))) / 64;
      squares += d * d;
    }
  }
  return std::sqrt(squares / blocks) / std::max(mean(b), 1e-20);
}

// One picture of several seeds, against two references.
struct Trial {
  double mean = 0, meanError = 0;  // over seeds, relative to the references'; standard error of that, with theirs
  double blocks = 0;  // root mean square of block errors
};

constexpr uint64_t kSeeds = 8;

Trial trialOf(const std::vector<Image>& pictures, const Image& first, const Image& second) {
  const double truth = (mean(first) + mean(second)) / 2, n = static_cast<double>(pictures.size());
  Trial t;
  double squares = 0;
  Image expected = first;
  for (size_t i = 0; i < expected.pixels.size(); ++i) expected.pixels[i] = (first.pixels[i] + second.pixels[i]) * 0.5f;
  for (const Image& p : pictures) {
    const double m = mean(p) / truth, b = blockError(p, expected);
    t.mean += m / n, squares += m * m / n, t.blocks += b * b / n;
  }
  t.blocks = std::sqrt(t.blocks);
  const double ofReferences = (mean(first) - mean(second)) / truth / 2;
  t.meanError = std::sqrt(std::max(0.0, squares - t.mean * t.mean) / (n - 1) + ofReferences * ofReferences);
  return t;
}

// What meters of a technique promise at every place (validate/validation.h), and three standard errors.
double allowed(const std::string& technique, const Trial& t) {
  return (technique == "path" ? 0.01 : 0.03) + 3 * t.meanError;
}

// `path` renders the same picture with layers and without. `hybrid` with layers asks every light, however little it
// gives to the whole: its picture differs by noise.
void expectSum(const std::string& technique, const Rendered& layered, const Image& plain) {
  if (technique == "path") {
    ASSERT_TRUE(layered.image.pixels == plain.pixels) << "layers changed the picture itself";
  } else {
    EXPECT_LT(blockError(layered.image, plain), 0.04);
  }
  double worst = 0;
  for (size_t i = 0; i < plain.pixels.size(); ++i) {
    Vec3 sum;
    for (const RenderedLayer& l : layered.layers) {
      sum += l.image.pixels[i];
      ASSERT_GE(minComponent(l.image.pixels[i]), 0) << l.light.name;
    }
    const Vec3 whole = layered.image.pixels[i];
    for (int c = 0; c < 3; ++c)
      worst = std::max(
          worst, std::abs(static_cast<double>(sum[c] - whole[c])) / std::max(1e-12, static_cast<double>(whole[c])));
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
  expectSum(GetParam(), layered, rendered(home(), settings, false).image);
  if (GetParam() == "path") return;
  double withLayers = 0, without = 0;
  for (uint64_t seed = 0; seed < kSeeds; ++seed) {
    RenderSettings s = settings;
    s.seed = seed;
    withLayers += mean(rendered(home(), s, true).image), without += mean(rendered(home(), s, false).image);
  }
  fmt::print("with layers {:.5f} of the mean without\n", withLayers / without);
  EXPECT_NEAR(withLayers / without, 1, 0.006);
}

// A mix knows by them what light a lamp alone gives surfaces, so that it is shown as a render of that lamp is.
TEST_P(Layers, tellTheColourOfTheirLight) {
  const RenderSettings settings = settingsOf(GetParam(), GetParam() == "path" ? 64 : 0);
  const Rendered layered = rendered(home(), settings, true);
  Vec3 sum;
  for (const RenderedLayer& l : layered.layers) sum += l.lightColour;
  EXPECT_NEAR(length(sum - layered.lightColour), 0, 1e-3f);
  EXPECT_NEAR(luminance(sum), 1, 1e-3f);
  EXPECT_TRUE(isBlack(layerOf(layered, "Cellar").lightColour));
  for (const char* name : {"Ceiling", "Red. \"spot\""}) {
    const Vec3 layer = layerOf(layered, name).lightColour, own = rendered(alone(name), settings, false).lightColour;
    EXPECT_NEAR(length(layer / luminance(layer) - own), 0, 0.1f * length(own)) << name;
  }
}

TEST_P(Layers, areDarkBehindWalls) {
  const Rendered layered = rendered(home(), settingsOf(GetParam(), GetParam() == "path" ? 8 : 0), true);
  for (const Vec3 p : layerOf(layered, "Cellar").image.pixels) ASSERT_TRUE(isBlack(p));
}

// Pictures of the settings, of seeds 0 to kSeeds - 1.
std::vector<Rendered> seeded(const Scene& scene, const std::string& technique, bool layers) {
  std::vector<Rendered> out;
  for (uint64_t seed = 0; seed < kSeeds; ++seed) {
    RenderSettings s = settingsOf(technique, technique == "path" ? 64 : 0);
    s.hybrid.hitCellM =
        -1;  // a layer and its lamp alone by the same rays: with cells these follow the noise of what is in the picture
    s.seed = seed;
    out.push_back(rendered(scene, s, layers));
  }
  return out;
}

// Two pictures by paths that know nothing of layers.
struct References {
  explicit References(const Scene& scene) : first(of(scene, 17)), second(of(scene, 18)) {}
  Image first, second;

 private:
  static Image of(const Scene& scene, uint64_t seed) {
    RenderSettings s = settingsOf("path", 256);
    s.seed = seed;
    return rendered(scene, s, false).image;
  }
};

const std::vector<std::string> kLights = {"Ceiling", "Red. \"spot\"", "Dim", "Globe", "sun", "sky"};

std::vector<Image> imagesOf(const std::vector<Rendered>& layered, const std::string& light) {
  std::vector<Image> out;
  for (const Rendered& r : layered) out.push_back(layerOf(r, light).image);
  return out;
}

// Each picture of `parts` and of `alone` against references of the latter.
void expectSame(const std::string& technique, const std::string& name, const std::vector<Image>& parts,
                const Scene& alone, const References& references) {
  std::vector<Image> own;
  for (Rendered& r : seeded(alone, technique, false)) own.push_back(std::move(r.image));
  const Trial layer = trialOf(parts, references.first, references.second),
              single = trialOf(own, references.first, references.second);
  fmt::print("{} {}: mean {:.4f} +- {:.4f}, block error {:.4f}; rendered alone {:.4f} +- {:.4f}, {:.4f}\n", technique,
             name, layer.mean, layer.meanError, layer.blocks, single.mean, single.meanError, single.blocks);
  EXPECT_NEAR(layer.mean, 1, allowed(technique, layer)) << technique << ", " << name;
  EXPECT_NEAR(single.mean, 1, allowed(technique, single)) << technique << ", " << name;
  // As little error as alone: 24 blocks of 8 seeds tell each root mean square to 5 %, their ratio to 7. Technique path
  // asks one lamp at a time, so its dim lamps have more (docs/methods/layers.md).
  if (technique == "hybrid") {
    EXPECT_LE(layer.blocks, 1.2 * single.blocks) << name;
  }
}

std::vector<std::string> techniquesOfLayers() { return test::techniquesThatCan(&Technique::layers); }

// Cells of the cache of hits know whose their light is.
std::vector<Rendered> byCells() {
  std::vector<Rendered> out;
  for (uint64_t seed = 0; seed < kSeeds; ++seed) {
    RenderSettings s = settingsOf("hybrid");
    s.seed = seed;
    out.push_back(rendered(home(), s, true));
  }
  return out;
}

// All techniques in one test: references are most of the work.
TEST(LayersOfTechniques, eachIsThatLightAlone) {
  std::map<std::string, std::vector<Rendered>> layered;
  for (const std::string& technique : techniquesOfLayers()) layered[technique] = seeded(home(), technique, true);
  ASSERT_EQ(layered.size(), 2u);
  const std::vector<Rendered> cells = byCells();
  for (const std::string& name : kLights) {
    const Scene lit = alone(name);
    const References references(lit);
    for (const auto& [technique, pictures] : layered)
      expectSame(technique, name, imagesOf(pictures, name), lit, references);
    const Trial cell = trialOf(imagesOf(cells, name), references.first, references.second);
    fmt::print("with cells, {}: mean {:.4f} +- {:.4f}, block error {:.4f}\n", name, cell.mean, cell.meanError,
               cell.blocks);
    EXPECT_NEAR(cell.mean, 1, allowed("hybrid", cell)) << name;
  }
}

TEST(LayersOfTechniques, mixLikeDimmedLamps) {
  Scene dimmed = home();
  dimmed.suns.clear(), dimmed.sky = {};
  dimmed.lamps[0].intensityCd *= 0.2f;
  dimmed.lamps[1].intensityCd *= Vec3{0.5f, 2, 8};  // another colour
  const References references(dimmed);
  for (const std::string& technique : techniquesOfLayers()) {
    std::vector<Image> mixes;
    for (const Rendered& layered : seeded(home(), technique, true)) {
      Image mix(kWidth, kHeight);
      for (size_t i = 0; i < mix.pixels.size(); ++i) {
        mix.pixels[i] = layerOf(layered, "Ceiling").image.pixels[i] * 0.2f +
                        layerOf(layered, "Red. \"spot\"").image.pixels[i] * Vec3{0.5f, 2, 8} +
                        layerOf(layered, "Dim").image.pixels[i] + layerOf(layered, "Globe").image.pixels[i];
      }
      mixes.push_back(std::move(mix));
    }
    expectSame(technique, "mix", mixes, dimmed, references);
  }
}

INSTANTIATE_TEST_SUITE_P(Techniques, Layers, testing::ValuesIn(techniquesOfLayers()),
                         [](const auto& which) { return which.param; });

TEST(LayersOfManyLamps, addUpAndADimOneHasLittleMoreNoise) {
  Scene scene = home();
  scene.suns.clear(), scene.sky = {};
  for (int i = 0; i < 8; ++i)
    scene.lamps.push_back(lampAt(fmt::format("row {}", i), {0.4f + 0.4f * static_cast<float>(i), 2.4f, 2.5f},
                                 Vec3(4 + static_cast<float>(i))));
  const RenderSettings settings = settingsOf("hybrid");
  const Rendered layered = rendered(scene, settings, true);
  ASSERT_EQ(layered.layers.size(), 13u);
  expectSum("hybrid", layered, rendered(scene, settings, false).image);
  const References references(alone("Dim"));
  std::vector<Image> parts, own;
  for (const Rendered& r : seeded(scene, "hybrid", true)) parts.push_back(layerOf(r, "Dim").image);
  for (const Rendered& r : seeded(alone("Dim"), "hybrid", false)) own.push_back(r.image);
  const Trial layer = trialOf(parts, references.first, references.second),
              single = trialOf(own, references.first, references.second);
  fmt::print("Dim among many: mean {:.4f}, block error {:.4f}; rendered alone {:.4f}\n", layer.mean, layer.blocks,
             single.blocks);
  // A lamp of a fiftieth of another's light gets fewer of the samples that twelve share: up to 1.45 times the error
  // it has alone was measured here. Ratios are told to 7 %.
  EXPECT_LE(layer.blocks, 1.45 * 1.2 * single.blocks);
}

// Whose gathering looks at the error after a pass, and ends where it is small enough.
TEST(LayersOfManyLamps, areThereWhereTheErrorEndsThePicture) {
  RenderSettings settings = settingsOf("hybrid");
  settings.blendUntilMse = 1;
  const Rendered layered = rendered(home(), settings, true);
  ASSERT_EQ(layered.layers.size(), 7u);
  EXPECT_GT(mean(layerOf(layered, "Ceiling").image), 0);
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
