// FBX, COLLADA, 3D Studio, STL and PLY as scenes.
#include <gtest/gtest.h>

#include <cmath>

#include "import/foreign_model.h"
#include "import/import.h"
#include "scene/validate.h"
#include "support/foreign_files.h"
#include "unit/temporary_folder.h"

namespace roomlight {
namespace {

using namespace testing;

class ForeignFormats : public ::testing::Test {
 protected:
  Imported read(const std::string& name, const std::string& bytes, const ImportOptions& options = {}) {
    writeFile(folder_ / name, bytes);
    Result<Imported> r = importScene(folder_ / name, options);
    EXPECT_TRUE(r) << r.error();
    return r ? std::move(r.value()) : Imported{};
  }
  TemporaryFolder folder_;
};

void expectNear(Vec3 a, Vec3 b, float tolerance = 1e-4f) {
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(a[i], b[i], tolerance) << "coordinate " << i;
}

const Instance* find(const Scene& scene, const std::string& name) {
  for (const Instance& i : scene.instances) {
    if (i.name == name) return &i;
  }
  return nullptr;
}

const Lamp* findLamp(const Scene& scene, const std::string& name) {
  for (const Lamp& l : scene.lamps) {
    if (l.name == name) return &l;
  }
  return nullptr;
}

bool says(const std::vector<std::string>& lines, const std::string& text) {
  for (const std::string& line : lines) {
    if (line.find(text) != std::string::npos) return true;
  }
  return false;
}

TEST_F(ForeignFormats, fbxInItsUnitAndAxes) {
  for (const bool binary : {false, true}) {
    SCOPED_TRACE(binary);
    const Imported i = read("a.fbx", binary ? fbxBytes(fbxScene()) : fbxText(fbxScene()));
    const Instance *low = find(i.scene, "low"), *high = find(i.scene, "high");
    ASSERT_TRUE(low && high);
    EXPECT_EQ(low->mesh, high->mesh);  // placed twice, stored once
    EXPECT_NE(low->object, high->object);
    const Bounds3 b = instanceBounds(i.scene, *high);
    expectNear(b.lo, {0, 2.54f, -20 * 0.0254f});
    expectNear(b.hi, {40 * 0.0254f, 2.54f, 0});
    const Mesh& mesh = i.scene.meshes[static_cast<size_t>(low->mesh)];
    const Material& m = i.scene.materials[static_cast<size_t>(mesh.material)];
    EXPECT_EQ(m.name, "wood");
    expectNear(m.baseColor, {0.8f, 0.4f, 0.2f});  // its picture is missing
    expectNear(m.emission, {0.5f, 0.25f, 0});
    EXPECT_NEAR(m.roughness, std::pow(2 / 32.0f, 0.25f), 1e-4);
    EXPECT_TRUE(says(i.warnings, "pictures are missing"));
  }
}

TEST_F(ForeignFormats, fbxCameraAndLights) {
  const Imported i = read("a.fbx", fbxText(fbxScene()));
  ASSERT_EQ(i.scene.cameras.size(), 1u);
  const Camera& c = i.scene.cameras[0];
  expectNear(c.worldFromCamera.w, {0.254f, 60 * 0.0254f, 50 * 0.0254f});
  expectNear(c.worldFromCamera.vector({0, 0, -1}), {1, 0, 0});  // FBX cameras look along x
  EXPECT_NEAR(c.yFovRad, 2 * std::atan(std::tan(kPi / 6) / 2), 1e-4);
  EXPECT_FLOAT_EQ(c.aspect, 2);

  const Lamp *spot = findLamp(i.scene, "spot"), *bulb = findLamp(i.scene, "bulb"), *panel = findLamp(i.scene, "panel");
  ASSERT_TRUE(spot && bulb && panel);
  EXPECT_EQ(spot->kind, LampKind::Spot);
  expectNear(spot->position, {0, 90 * 0.0254f, 0});
  expectNear(spot->direction, {0, -1, 0});  // along -y, turned by 90 degrees to -z, which is down
  EXPECT_NEAR(spot->innerConeRad, 20 * kPi / 180, 1e-4);
  EXPECT_NEAR(spot->outerConeRad, 30 * kPi / 180, 1e-4);
  EXPECT_NEAR(luminance(bulb->intensityCd) * 4 * kPi, 400, 0.1);  // half as bright as the brightest
  EXPECT_EQ(panel->kind, LampKind::Area);
  EXPECT_NEAR(luminance(panel->luminanceCdM2) * kPi * panel->widthM * panel->heightM, 800, 0.1);
  ASSERT_EQ(i.scene.suns.size(), 1u);
  EXPECT_NEAR(luminance(i.scene.suns[0].illuminanceLux), 50'000, 1);
  expectNear(i.scene.suns[0].toLight, {0, 0, -1});  // from +y in the file's axes
  EXPECT_TRUE(says(i.warnings, "no photometric unit"));
}

TEST_F(ForeignFormats, fbxPicturesInsideAndBeside) {
  const std::vector<uint8_t> red{255, 0, 0, 255};
  for (const bool binary : {false, true}) {
    const Imported inside = read("a.fbx", binary ? fbxBytes(fbxScene(redBmp())) : fbxText(fbxScene(redBmp())));
    ASSERT_EQ(inside.scene.textures.size(), 1u);
    EXPECT_EQ(inside.scene.textures[0].rgba, red);
    expectNear(inside.scene.materials[0].baseColor, Vec3(1));
  }
  std::filesystem::create_directories(folder_ / "Maps");
  writeFile(folder_ / "Maps/red.bmp", redBmp());
  const Imported beside = read("a.fbx", fbxText(fbxScene()));
  ASSERT_EQ(beside.scene.textures.size(), 1u);
  EXPECT_EQ(beside.scene.textures[0].rgba, red);
}

TEST_F(ForeignFormats, upAxisOfTheUserDecides) {
  const Imported i = read("a.fbx", fbxText(fbxScene()), {.upAxis = 'y'});
  const Instance* high = find(i.scene, "high");
  ASSERT_TRUE(high);
  expectNear(instanceBounds(i.scene, *high).hi, {40 * 0.0254f, 20 * 0.0254f, 2.54f});
  const Imported dae = read("a.dae", colladaScene(), {.upAxis = 'y'});
  expectNear(dae.scene.bounds().hi, {0.2f, 0.4f, 0.3f});
}

TEST_F(ForeignFormats, colladaInMetresWithLightsAndCamera) {
  std::filesystem::create_directories(folder_ / "tex");
  writeFile(folder_ / "tex/red.bmp", redBmp());
  const Imported i = read("a.dae", colladaScene());
  expectNear(i.scene.bounds().lo, {0, 0.3f, -0.4f});
  expectNear(i.scene.bounds().hi, {0.2f, 0.3f, 0});
  EXPECT_EQ(i.scene.textures.size(), 1u);
  ASSERT_EQ(i.scene.cameras.size(), 1u);
  expectNear(i.scene.cameras[0].worldFromCamera.w, {0.1f, 3, -0.2f});
  expectNear(i.scene.cameras[0].worldFromCamera.vector({0, 0, -1}), {0, -1, 0});
  EXPECT_NEAR(i.scene.cameras[0].yFovRad, 2 * std::atan(std::tan(kPi / 6) / 2), 1e-4);
  ASSERT_EQ(i.scene.lamps.size(), 2u);
  expectNear(i.scene.lamps[0].position, {0.1f, 3, -0.2f});
  EXPECT_NEAR(i.scene.lamps[1].outerConeRad, kPi / 6, 1e-4);
  ASSERT_EQ(i.scene.suns.size(), 1u);
  expectNear(i.scene.suns[0].toLight, {0, 1, 0});
  EXPECT_TRUE(says(i.warnings, "ambient"));
}

TEST_F(ForeignFormats, stlPlyAnd3dsStandOnTheFloor) {
  const Triangles z = tableZUp(), y = turnedYUp(z);
  const std::pair<const char*, std::string> files[] = {{"t.stl", stlText(z)},
                                                       {"b.stl", stlBytes(z)},
                                                       {"t.ply", ply(z, false, {255, 0, 128})},
                                                       {"b.ply", ply(z, true, {255, 0, 128})},
                                                       {"a.3ds", studio3d(z)},
                                                       {"y.stl", stlText(y)},
                                                       {"y.ply", ply(y, true, {255, 0, 128})}};
  for (const auto& [name, bytes] : files) {
    SCOPED_TRACE(name);
    const Imported i = read(name, bytes);
    EXPECT_EQ(i.scene.triangleCount(), 60u);
    expectNear(i.scene.bounds().lo, {-1, 0, -0.5f});
    expectNear(i.scene.bounds().hi, {1, 0.8f, 0.5f});
    EXPECT_EQ(says(i.warnings, "taken to be y"), name[0] == 'y');
  }
  const Imported coloured = read("b.ply", ply(z, true, {255, 0, 128}));
  ASSERT_FALSE(coloured.scene.meshes.empty());
  const Mesh& mesh = coloured.scene.meshes[0];
  ASSERT_EQ(mesh.colors.size(), mesh.positions.size());
  expectNear(mesh.colors[0], {1, 0, 0.2159f});
  expectNear(coloured.scene.materials[static_cast<size_t>(mesh.material)].baseColor, Vec3(0.85f));
  const Imported plain = read("t.stl", stlText(z));
  expectNear(plain.scene.materials[0].baseColor, Vec3(0.6f));
  const Imported camera = read("a.3ds", studio3d(z));
  ASSERT_EQ(camera.scene.cameras.size(), 1u);
  expectNear(camera.scene.cameras[0].worldFromCamera.w, {0, 2, 5});
  expectNear(camera.scene.cameras[0].worldFromCamera.vector({0, 0, -1}), {0, 0, -1});
  EXPECT_NEAR(camera.scene.cameras[0].yFovRad, 2 * std::atan(std::tan(24 * kPi / 180) / 1.5),
              1e-4);  // 48 degrees across
}

// The library would look for it until its time is over.
TEST_F(ForeignFormats, aPlyHeaderHasAnEnd) {
  writeFile(folder_ / "a.ply", "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nend_he\n0\n");
  const Result<Imported> r = importScene(folder_ / "a.ply", {});
  ASSERT_FALSE(r);
  EXPECT_NE(r.error().find("its header does not end"), std::string::npos) << r.error();
}

TEST_F(ForeignFormats, verticesThatAreNoPlaceCostTheirTriangles) {
  Triangles t = tableZUp();
  t.corners[0] = {NAN, 0, 0};
  const Imported i = read("a.stl", stlBytes(t));
  EXPECT_EQ(i.scene.triangleCount(), 59u);
  EXPECT_TRUE(says(i.faults, "no finite place"));
}

// What comes from the reader is a model or none.
TEST(ForeignModels, brokenValuesOfVerticesAreMended) {
  importers::ForeignModel model;
  model.materials.emplace_back();
  Mesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  mesh.uv[0] = {{0, 0}, {NAN, 0}, {0, 1e30f}};
  mesh.colors = {{NAN, 0, 0}, {0, -1, 0}, {0, 0, INFINITY}};
  mesh.indices = {0, 1, 2};
  model.meshes.push_back(mesh);
  model.instances.emplace_back();
  importers::Warnings warnings;
  const Scene scene = importers::sceneOf(
      importers::foreignModel(importers::toBytes(model)),
      [](std::string_view, const std::string&) { return std::nullopt; }, warnings);
  EXPECT_EQ(warnings.lines(),
            (std::vector<std::string>{"texture coordinates that are no finite numbers are taken as 0 (2 times)"}));
  EXPECT_TRUE(validate(scene).ok()) << validate(scene).error();
}

// Lights of no size, no brightness and no direction still make lamps that can be worked with.
TEST(ForeignModels, lightsOfAbsurdValuesAreMended) {
  importers::ForeignModel model;
  for (const auto kind : {importers::ForeignLightKind::Spot, importers::ForeignLightKind::Area,
                          importers::ForeignLightKind::Directional}) {
    for (const float v : {NAN, 1e-38f, 1e30f}) {
      importers::ForeignLight light;
      light.kind = kind, light.colour = Vec3(1e-30f);
      light.innerConeRad = light.outerConeRad = light.width = light.height = v;
      light.direction = Vec3(v);
      model.lights.push_back(light);
      light.colour = Vec3(1);
      model.lights.push_back(light);
    }
  }
  Scene scene;
  scene.materials.emplace_back();
  Mesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, mesh.indices = {0, 1, 2};
  scene.meshes.push_back(mesh);
  scene.instances.emplace_back();
  importers::Warnings warnings;
  importers::addForeignLights(importers::foreignModel(importers::toBytes(model)).lights, 1, scene, warnings);
  EXPECT_EQ(scene.suns.size(), 3u);
  EXPECT_TRUE(validate(scene).ok()) << validate(scene).error();
}

// The parent never crashes, whatever becomes of the reader.
TEST(DamagedFiles, giveASceneOrOneLine) {
  const Triangles t = tableZUp();
  const std::pair<const char*, std::string> files[] = {{"a.fbx", fbxText(fbxScene(redBmp()))},
                                                       {"b.fbx", fbxBytes(fbxScene(redBmp()))},
                                                       {"a.dae", colladaScene()},
                                                       {"a.3ds", studio3d(t)},
                                                       {"a.stl", stlText(t)},
                                                       {"b.stl", stlBytes(t)},
                                                       {"a.ply", ply(t, false, {1, 2, 3})},
                                                       {"b.ply", ply(t, true, {1, 2, 3})},
                                                       {"a.obj", obj(t)}};
  const TemporaryFolder folder;
  uint32_t state = 1;
  const auto random = [&](size_t below) {
    return (state = state * 1664525u + 1013904223u) / 65536u % static_cast<uint32_t>(below);
  };
  for (const auto& [name, whole] : files) {
    for (int round = 0; round < 24; ++round) {
      std::string bytes = whole;
      if (round % 3 == 0) bytes.resize(bytes.size() * random(1000) / 1000);
      for (int k = 0; round % 3 != 0 && k < 1 + round; ++k)
        bytes[random(60000) % bytes.size()] = static_cast<char>(random(256));
      writeFile(folder / name, bytes);
      const Result<Imported> r = importScene(folder / name, {.maxTriangles = 1 << 20});
      if (r) continue;
      EXPECT_NE(r.error().find(name), std::string::npos) << r.error();
      EXPECT_EQ(r.error().find('\n'), std::string::npos) << r.error();
    }
  }
  EXPECT_EQ(folder.fileCount(), std::size(files));
}

}  // namespace
}  // namespace roomlight
