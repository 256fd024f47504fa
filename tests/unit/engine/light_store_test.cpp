// Light that processes share: read back it gives the same pictures bit by bit, and nothing else is ever taken for it.
#include "engine/light_store.h"

#include <gtest/gtest.h>

#include <set>

#include "engine/render.h"
#include "engine/technique.h"
#include "engine/voxel_light_bytes.h"
#include "support/rooms.h"
#include "unit/temporary_folder.h"

namespace roomlight {
namespace {

using testing::readFile;
using testing::TemporaryFolder;
using testing::writeFile;

// Two rooms with a door between, by sun, sky, two lamps and a shining panel.
Scene home() {
  Scene scene;
  const int white = test::addMaterial(scene, test::lambertian(0.7f)),
            wood = test::addMaterial(scene, test::lambertian(0.4f));
  test::addBox(scene, {-0.2f, -0.2f, -0.2f}, {8.2f, 0, 5.2f}, wood);
  test::addBox(scene, {-0.2f, 2.6f, -0.2f}, {8.2f, 2.8f, 5.2f}, white);
  test::addBox(scene, {-0.2f, 0, -0.2f}, {0, 2.6f, 5.2f}, white);
  test::addBox(scene, {-0.2f, 0, 5}, {8.2f, 2.6f, 5.2f}, white);
  test::addBox(scene, {-0.2f, 0, -0.2f}, {8.2f, 2.6f, 0}, white);
  test::addBox(scene, {4, 0, 1}, {4.1f, 2.6f, 5}, white);
  test::addBox(scene, {8, 0, 0}, {8.2f, 1, 5}, white);  // open above: a window
  test::addBox(scene, {1, 0.7f, 1}, {2.5f, 0.75f, 2}, wood);
  test::addRectangle(scene, {1.5f, 2.55f, 2}, {1, 0, 0}, {0, 0, 1}, test::addMaterial(scene, test::lambertian(0, 900)));
  scene.lamps = {test::pointLamp({3.1f, 1.9f, 3.1f}, 80), test::pointLamp({1.5f, 1.1f, 1.5f}, 30)};
  scene.lamps[0].name = "Ceiling", scene.lamps[1].name = "Table";
  scene.suns.push_back({.name = "sun", .toLight = normalize(Vec3{1, 0.7f, 0.2f}), .illuminanceLux = Vec3(50000)});
  scene.sky.luminanceCdM2 = Vec3(3000);
  return scene;
}

Camera camera(const char* name, Vec3 eye) {
  Camera c = test::cameraAt(eye);
  c.name = name;
  return c;
}

RenderSettings small(const char* technique) {
  RenderSettings s;
  applyQuality("draft", s);
  s.technique = technique;
  s.width = 40, s.height = 24, s.samples = 2;
  s.voxel.voxelSizeM = 0.2f;
  return s;
}

class SharedLight : public ::testing::TestWithParam<const char*> {
 protected:
  const TemporaryFolder folder_;
  const Scene scene_ = home();
  const std::vector<Camera> cameras_ = {camera("Left", {2, 1.4f, 4.6f}), camera("Right", {6, 1.4f, 4.6f}),
                                        camera("Door", {3.5f, 1.6f, 0.6f})};
  std::vector<std::string> warnings_;

  LightStore store() {
    return {folder_ / "lights", 100'000'000, [this](const std::string& line) { warnings_.push_back(line); }};
  }
  // As a process of its own would.
  Rendered alone(const RenderSettings& settings, const Camera& camera, std::optional<LightStore> store) {
    Result<Renderer> renderer = Renderer::of(scene_, settings, cameras_, std::move(store));
    EXPECT_TRUE(renderer.ok());
    Result<Rendered> out = renderer.value().picture(camera);
    EXPECT_TRUE(out.ok());
    return std::move(out.value());
  }
  static std::string stages(const Rendered& rendered) {
    std::string out;
    for (const StageStats& s : rendered.stats.stages) {
      for (const char* name : {"light read", "voxelise", "illuminate", "light write"}) {
        if (s.name == name) out += (out.empty() ? "" : ", ") + s.name;
      }
    }
    return out;
  }
  static bool same(const Rendered& a, const Rendered& b) {
    bool same = a.image.pixels == b.image.pixels && a.layers.size() == b.layers.size();
    for (size_t i = 0; same && i < a.layers.size(); ++i)
      same = a.layers[i].light.name == b.layers[i].light.name && a.layers[i].image.pixels == b.layers[i].image.pixels;
    return same;
  }
  std::filesystem::path onlyFile() const { return std::filesystem::directory_iterator(folder_ / "lights")->path(); }
};

TEST_P(SharedLight, givesThePicturesOfOneProcessBitByBit) {
  for (const bool layers : {false, true}) {
    RenderSettings settings = small(GetParam());
    settings.layers = layers;
    if (layers && !findTechnique(GetParam())->layers) continue;
    Result<Renderer> together = Renderer::of(scene_, settings, cameras_);
    ASSERT_TRUE(together.ok());
    for (const Camera& c : cameras_) {
      const Rendered expected = together.value().picture(c).value();
      const bool isFirst = &c == &cameras_.front();
      for (int i = 0; i < 2; ++i) {
        const Rendered got = alone(settings, c, store());
        EXPECT_TRUE(same(got, expected)) << c.name << layers;
        EXPECT_EQ(stages(got), isFirst && i == 0 ? "light read, voxelise, illuminate, light write" : "light read");
      }
      EXPECT_TRUE(same(alone(settings, c, {}), expected)) << "without a store, for the same cameras";
    }
  }
  EXPECT_TRUE(warnings_.empty()) << warnings_.front();
}

TEST_P(SharedLight, isFoundAnewWhereAFileIsDamaged) {
  const RenderSettings settings = small(GetParam());
  const Rendered right = alone(settings, cameras_[0], store());
  const std::string bytes = readFile(onlyFile());
  for (const size_t at : {size_t{0}, bytes.size() / 2, bytes.size() - 1}) {
    std::string wrong = bytes;
    wrong[at] ^= 4;
    writeFile(onlyFile(), wrong);
    warnings_.clear();
    const Rendered got = alone(settings, cameras_[0], store());
    EXPECT_TRUE(same(got, right));
    EXPECT_EQ(stages(got), "light read, voxelise, illuminate, light write");
    ASSERT_EQ(warnings_.size(), 1u);
    EXPECT_NE(warnings_[0].find("damaged"), std::string::npos) << warnings_[0];
    EXPECT_EQ(stages(alone(settings, cameras_[0], store())), "light read");
  }
}

TEST_P(SharedLight, makesThePictureWhereNothingCanBeKept) {
  const RenderSettings settings = small(GetParam());
  const Rendered right = alone(settings, cameras_[0], {});
  LightStore nowhere = store();
  writeFile(folder_ / "file", "");
  nowhere.folder = folder_ / "file";
  EXPECT_TRUE(same(alone(settings, cameras_[0], nowhere), right));
  ASSERT_EQ(warnings_.size(), 1u);
  LightStore tiny = store();
  tiny.mostBytes = 1000;
  EXPECT_TRUE(same(alone(settings, cameras_[0], tiny), right));
  ASSERT_EQ(warnings_.size(), 2u);
  EXPECT_NE(warnings_[1].find("not kept"), std::string::npos) << warnings_[1];
}

TEST_P(SharedLight, isNotUsedWithATimeLimit) {
  RenderSettings settings = small(GetParam());
  settings.timeLimitS = 0.5, settings.blend = false;
  EXPECT_EQ(stages(alone(settings, cameras_[0], store())).find("light"), std::string::npos);
  EXPECT_FALSE(std::filesystem::exists(folder_ / "lights"));
}

INSTANTIATE_TEST_SUITE_P(Techniques, SharedLight, ::testing::Values("hybrid", "cone"),
                         [](const auto& of) { return std::string(of.param); });

TEST(Techniques, ShareLightWhereItIsInVoxels) { EXPECT_EQ(techniquesWith(&Technique::sharesLight), "hybrid or cone"); }

TEST(LightName, ChangesWithAllThatLightDependsOn) {
  Scene scene = home();
  VoxelSettings voxel;
  RadianceSettings radiance;
  radiance.views = {camera("Left", {2, 1.4f, 4.6f}), camera("Right", {6, 1.4f, 4.6f})};
  std::set<std::string> names = {lightName(scene, voxel, radiance)};
  EXPECT_EQ(lightName(scene, voxel, radiance), *names.begin());
  const auto differs = [&](auto change) {
    Scene s = scene;
    VoxelSettings v = voxel;
    RadianceSettings r = radiance;
    change(s, v, r);
    return names.insert(lightName(s, v, r)).second;
  };
  EXPECT_TRUE(differs([](auto& s, auto&, auto&) { s.lamps[0].intensityCd *= 1.0001f; }));
  EXPECT_TRUE(differs([](auto& s, auto&, auto&) { s.instances[3].worldFromObject.w.x += 1e-4f; }));
  EXPECT_TRUE(differs([](auto& s, auto&, auto&) { s.sky.luminanceCdM2 = Vec3(3001); }));
  EXPECT_TRUE(differs([](auto&, auto& v, auto&) { v.sizeFactor = 1.4f; }));
  EXPECT_TRUE(differs([](auto&, auto& v, auto&) { v.voxelSizeM = 0.1f; }));
  EXPECT_TRUE(differs([](auto&, auto&, auto& r) { r.seed = 1; }));
  EXPECT_TRUE(differs([](auto&, auto&, auto& r) { r.links = 4; }));
  EXPECT_TRUE(differs([](auto&, auto&, auto& r) { r.residual = 0.01f; }));
  EXPECT_TRUE(differs([](auto&, auto&, auto& r) { r.still = true; }));
  EXPECT_TRUE(differs([](auto&, auto&, auto& r) { r.pyramid = false; }));
  EXPECT_TRUE(differs([](auto&, auto&, auto& r) { r.views.pop_back(); }));
  EXPECT_TRUE(differs([](auto&, auto&, auto& r) { r.views[0].yFovRad += 0.01f; }));
  EXPECT_TRUE(differs([](auto&, auto&, auto& r) { r.layers = std::make_shared<const LightLayers>(); }));
  EXPECT_TRUE(differs([](auto&, auto&, auto& r) {
    LightLayers layers;
    layers.ofLamp = {0, 0};
    r.layers = std::make_shared<const LightLayers>(layers);
  }));
}

TEST(VoxelLightBytes, ComeBackToTheLastOneOrNotAtAll) {
  const Scene scene = home();
  RenderStats stats;
  RenderProgress silent;
  Stages stages(silent, stats);
  const RayScene rays(scene);
  const Lights lights(scene, true);
  RadianceSettings radiance;
  radiance.still = true, radiance.links = 2, radiance.directSamples = 1;
  radiance.layers = std::make_shared<const LightLayers>(layersOf(scene, lights).value());
  const VoxelLight light = lightVoxels(rays, lights, {.voxelSizeM = 0.4f}, radiance, stages);
  const std::string bytes = bytesOf(light);
  const std::optional<VoxelLight> back = voxelLightFrom(bytes, radiance.layers);
  ASSERT_TRUE(back);
  EXPECT_EQ(bytesOf(*back), bytes);
  EXPECT_EQ(back->field.irradianceLux, light.field.irradianceLux);
  EXPECT_EQ(back->field.levels.size(), light.field.levels.size());
  EXPECT_EQ(back->voxels.slots.size(), light.voxels.slots.size());
  EXPECT_EQ(back->field.layers.lights, radiance.layers);
  EXPECT_EQ(back->field.bytes(), light.field.bytes());
  EXPECT_FALSE(voxelLightFrom(bytes, nullptr)) << "layers are missing";
  EXPECT_FALSE(voxelLightFrom(bytes + "x", radiance.layers));
  EXPECT_FALSE(voxelLightFrom("", radiance.layers));
  for (size_t length = 0; length < bytes.size(); length += 1 + bytes.size() / 97)
    EXPECT_FALSE(voxelLightFrom(std::string_view(bytes).substr(0, length), radiance.layers)) << length;
  std::string hostile = bytes;
  hostile.replace(32, 8, 8, '\xff');  // about where the first count stands
  EXPECT_FALSE(voxelLightFrom(hostile, radiance.layers));
}

}  // namespace
}  // namespace roomlight
