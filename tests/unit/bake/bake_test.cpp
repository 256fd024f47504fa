// Light on the atlas against closed forms, and the file as another reader has it.
#include "bake/bake.h"

#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "bake/light_texels.h"
#include "bake/lit_places.h"
#include "bake/smooth.h"
#include "base/parallel.h"
#include "import/import.h"
#include "support/rooms.h"
#include "unit/bake/texels_of.h"
#include "unit/temporary_folder.h"

namespace roomlight::bake {
namespace {

using roomlight::testing::TemporaryFolder;

constexpr float kCandela = 100;

Scene room(float albedo) {
  Scene scene;
  addRoom(scene, {0, 0, 0}, {4, 2.5f, 3}, std::vector<int>(6, addMaterial(scene, lambertian(albedo))));
  scene.lamps = {pointLamp({2, 2, 1.5f}, kCandela)};
  scene.lamps[0].name = "Pendant";
  Room floor;
  floor.name = "Kitchen", floor.floor = {{0, 0}, {0, 3}, {4, 3}, {4, 0}};
  scene.rooms = {floor};
  return scene;
}

nlohmann::json jsonOf(const std::string& glb) {
  uint32_t length = 0;
  std::memcpy(&length, glb.data() + 12, 4);
  return nlohmann::json::parse(glb.substr(20, length));
}

class Bake : public ::testing::Test {
 protected:
  BakeSettings settings_ = bakeSettings("draft").value();
  const RenderProgress quiet_;
  RenderStats stats_;
  Stages stages_{quiet_, stats_};
};

TEST_F(Bake, aPointLampInABlackRoomGivesItsInverseSquare) {
  const Scene scene = room(0);
  std::vector<SurfaceElement> places;
  for (float x = 0.2f; x < 4; x += 0.4f) places.push_back({{x, 0, 1.1f}, {0, 1, 0}});
  const Result<LampLayers> lamps = lampLayers(scene, places, settings_.layers, stages_);
  ASSERT_TRUE(lamps) << lamps.error();
  ASSERT_EQ(lamps.value().layers.size(), 1u);
  const BakedLayer& layer = lamps.value().layers[0];
  EXPECT_EQ(layer.name, "Pendant");
  for (size_t i = 0; i < places.size(); ++i) {
    const Vec3 d = scene.lamps[0].position - places[i].position;
    const float expected = kCandela * d.y / std::pow(length(d), 3.0f);
    EXPECT_NEAR(luminance(layer.lux[i]), expected, 0.005f * expected);
  }
}

TEST_F(Bake, aFurnaceIsEvenEverywhereAfterSmoothing) {
  Scene scene;
  addRoom(scene, {0, 0, 0}, {4, 2.5f, 3}, std::vector<int>(6, addMaterial(scene, lambertian(0.5f, 100))));
  Room floor;
  floor.floor = {{0, 0}, {0, 3}, {4, 3}, {4, 0}};
  scene.rooms = {floor};
  const RayScene rays(scene);
  const SeenSides seen = seenFrom(rays, eyesIn(rays), 1 << 16);
  const Atlas atlas = atlasOf(scene, chartsOf(scene, seen, settings_.charts), settings_.atlas).value();
  const LitPlaces lit = litPlacesOf(atlas, rays, seen, settings_.placesApartM);
  Result<LampLayers> lamps = lampLayers(scene, lit.places, settings_.layers, stages_);
  ASSERT_TRUE(lamps) << lamps.error();
  std::vector<BakedLayer>& layers = lamps.value().layers;
  const double expected = kPi * 100 / 0.5;  // E = π L / (1 - ρ)
  std::vector<double> sums(atlas.elements.size());
  for (BakedLayer& layer : layers) {
    layer.lux = lit.spread<Vec3>(layer.lux), layer.errorLux = lit.spread<float>(layer.errorLux);
  }
  const auto deviation = [&] {
    double sum = 0, squares = 0;
    for (size_t i = 0; i < sums.size(); ++i) {
      double lux = 0;
      for (const BakedLayer& layer : layers) lux += static_cast<double>(luminance(layer.lux[i]));
      sum += lux / expected, squares += std::pow(lux / expected - 1, 2);
    }
    const auto n = static_cast<double>(sums.size());
    EXPECT_NEAR(sum / n, 1, 0.01);
    return std::sqrt(squares / n);
  };
  ASSERT_GT(sums.size(), 1000u);
  const double before = deviation();
  Smoothing(atlas, lit.buried, rays).smooth(atlas, layers);
  const double after = deviation();
  EXPECT_LT(after, 0.03);
  EXPECT_LT(after, 0.6 * before);
}

// The sum of all light in the first layer of a file.
double lightIn(const std::string& glb) {
  const auto json = jsonOf(glb);
  const auto& light = json["extensions"]["ROOMLIGHT_light_layers"]["layers"][0]["light"];
  const auto& view = json["bufferViews"][light["bufferView"].get<size_t>()];
  uint32_t length = 0;
  std::memcpy(&length, glb.data() + 12, 4);
  const std::string_view bytes = std::string_view(glb).substr(28 + length);
  const auto tile = json["extensions"]["ROOMLIGHT_light_layers"]["atlas"]["tile"].get<size_t>();
  double sum = 0;
  for (const uint32_t texel : texelsOf(bytes.substr(view["byteOffset"].get<size_t>(), view["byteLength"].get<size_t>()),
                                       light["tiles"].size() * tile * tile, tile, tile))
    sum += static_cast<double>(luminance(fromRgb9e5(texel)));
  return sum * light["scale"].get<double>();
}

// A bulb in a trough, which nobody sees. Simplified, one of this size would lose a tenth of its area, and so of its
// flux.
TEST_F(Bake, theHomeIsLitAsItIs) {
  constexpr float kRadiusM = 0.03f, kLuminance = 10000;
  const Vec3 place{2, 2.1f, 1.5f};
  Scene bulb = room(0);
  bulb.lamps.clear();
  addTube(bulb, {2, 2, 1.5f}, 0.2f, 0.2f, 0);
  addRectangle(bulb, {1.7f, 2, 1.2f}, {0.6f, 0, 0}, {0, 0, 0.6f}, 0);
  Scene point = bulb;
  addSphere(bulb, place, kRadiusM, addMaterial(bulb, lambertian(0, kLuminance)));
  point.lamps = {pointLamp(place, kLuminance * kPi * kRadiusM * kRadiusM)};
  double light[2] = {};
  for (const bool isBulb : {false, true}) {
    const Result<BakedHome> baked = bakeHome(isBulb ? bulb : point, {}, settings_, stages_);
    ASSERT_TRUE(baked) << baked.error();
    light[isBulb] = lightIn(baked.value().glb.bytes);
  }
  EXPECT_NEAR(light[1] / light[0], 1, 0.01);
}

// It is looked at from nearer than a room.
TEST_F(Bake, ofASmallThingAloneTexelsAreSmallToo) {
  Scene scene;
  addBox(scene, {0, 0, 0}, {0.4f, 0.4f, 0.4f}, addMaterial(scene, lambertian(0.5f)));
  scene.lamps = {pointLamp({1, 1, 1}, kCandela)};
  scene.cameras = {defaultCamera(scene)};
  const Result<BakedHome> alone = bakeHome(scene, {}, settings_, stages_);
  ASSERT_TRUE(alone) << alone.error();
  EXPECT_NEAR(alone.value().settings.atlas.texelM, 0.2f * settings_.atlas.texelM, 1e-5f);
  addRectangle(scene, {-20, 0, -20}, {0, 0, 40}, {40, 0, 0}, 0);
  const Result<BakedHome> onGround = bakeHome(scene, {}, settings_, stages_);
  ASSERT_TRUE(onGround) << onGround.error();
  EXPECT_EQ(onGround.value().settings.atlas.texelM, alone.value().settings.atlas.texelM);
  Room floor;
  floor.floor = {{-2, -2}, {-2, 2}, {2, 2}, {2, -2}};
  scene.rooms = {floor};
  const Result<BakedHome> inRoom = bakeHome(scene, {}, settings_, stages_);
  ASSERT_TRUE(inRoom) << inRoom.error();
  EXPECT_EQ(inRoom.value().settings.atlas.texelM, settings_.atlas.texelM);
}

TEST_F(Bake, theFileOpensAsAnyGltfAndHoldsWhatIsSeen) {
  const Scene scene = room(0.5f);
  const Result<BakedHome> baked = bakeHome(scene, {}, settings_, stages_);
  ASSERT_TRUE(baked) << baked.error();
  EXPECT_EQ(baked.value().layers, 1u);
  EXPECT_EQ(baked.value().triangles, 12u);
  const TemporaryFolder folder;
  const std::filesystem::path file = folder / "home.glb";
  std::ofstream(file, std::ios::binary) << baked.value().glb.bytes;
  const Result<Imported> opened = importScene(file);
  ASSERT_TRUE(opened) << opened.error();
  EXPECT_EQ(opened.value().scene.triangleCount(), 12u);
  const Bounds3 bounds = opened.value().scene.bounds();
  EXPECT_NEAR(bounds.hi.x, 4, 1e-5);
  EXPECT_NEAR(bounds.hi.y, 2.5f, 1e-5);
}

// Another reader finds the same corners, within a step, in a smaller file.
TEST_F(Bake, aCompressedFileHoldsTheSameHome) {
  Scene scene = room(0.5f);
  addSphere(scene, {2, 1, 1.5f}, 0.3f, 0);
  const TemporaryFolder folder;
  size_t bytes[2] = {};
  Bounds3 bounds[2];
  size_t triangles[2] = {};
  for (const bool compressed : {false, true}) {
    settings_.glb.compressed = compressed;
    const std::string glb = bakeHome(scene, {}, settings_, stages_).value().glb.bytes;
    bytes[compressed] = glb.size();
    std::ofstream(folder / "home.glb", std::ios::binary) << glb;
    const Result<Imported> opened = importScene(folder / "home.glb");
    ASSERT_TRUE(opened) << opened.error();
    bounds[compressed] = opened.value().scene.bounds();
    triangles[compressed] = opened.value().scene.triangleCount();
  }
  EXPECT_LT(bytes[1], bytes[0] * 3 / 4);
  EXPECT_EQ(triangles[1], triangles[0]);
  EXPECT_LT(length(bounds[1].lo - bounds[0].lo) + length(bounds[1].hi - bounds[0].hi), 2e-4f);
}

TEST_F(Bake, theExtensionNamesLampRoomAndCamera) {
  Scene scene = room(0.5f);
  Camera camera;
  camera.name = "Door", camera.worldFromCamera.w = {1, 1.6f, 2};
  scene.cameras = {camera};
  Lamp off = pointLamp({1, 1, 1}, 10);
  off.name = "Desk lamp";
  const Result<BakedHome> baked = bakeHome(scene, {{off}, {}}, settings_, stages_);
  ASSERT_TRUE(baked) << baked.error();
  const auto json = jsonOf(baked.value().glb.bytes);
  const auto& light = json["extensions"]["ROOMLIGHT_light_layers"];
  ASSERT_EQ(light["layers"].size(), 2u);
  EXPECT_EQ(light["layers"][0]["name"], "Pendant");
  EXPECT_EQ(light["layers"][0]["room"], "Kitchen");
  EXPECT_EQ(light["layers"][0]["on"], true);
  EXPECT_NEAR(light["layers"][0]["kelvin"].get<double>(), 6504, 30);  // (1, 1, 1) is D65
  EXPECT_EQ(light["layers"][1]["name"], "Desk lamp");
  EXPECT_EQ(light["layers"][1]["on"], false);
  EXPECT_EQ(light["cameras"][0]["name"], "Door");
  EXPECT_EQ(light["rooms"][0]["floor"].size(), 4u);
}

TEST_F(Bake, sunAndSkyOfEachHourAreLayersOfTheirOwn) {
  Scene scene = room(0.5f);
  scene.meshes.erase(scene.meshes.begin() + 3), scene.instances.erase(scene.instances.begin() + 3);  // the ceiling
  for (size_t i = 0; i < scene.instances.size(); ++i) scene.instances[i].mesh = static_cast<int>(i);
  scene.lamps.clear();
  DaylightHour noon{12, {Sun()}, {}}, night{22.5, {}, {}};
  noon.suns[0].illuminanceLux = Vec3(50000);
  noon.sky.luminanceCdM2 = Vec3(2000), night.sky.luminanceCdM2 = Vec3(0.1f);
  const Result<BakedHome> baked = bakeHome(scene, {{}, {noon, night}}, settings_, stages_);
  ASSERT_TRUE(baked) << baked.error();
  const auto json = jsonOf(baked.value().glb.bytes);
  const auto& layers = json["extensions"]["ROOMLIGHT_light_layers"]["layers"];
  ASSERT_EQ(layers.size(), 3u);
  EXPECT_EQ(layers[0]["kind"], "sun");
  EXPECT_EQ(layers[0]["hour"], 12);
  EXPECT_EQ(layers[0]["sun"]["lux"][1], 50000);
  EXPECT_EQ(layers[0]["sun"]["mask"]["channels"], 1);
  EXPECT_EQ(layers[1]["kind"], "sky");
  EXPECT_EQ(layers[1]["panorama"]["width"], 256);
  EXPECT_EQ(layers[2]["hour"], 22.5);
}

TEST_F(Bake, aLampThatIsOffLeavesItsNamesakeOn) {
  Scene scene = room(0.5f);
  Lamp off = pointLamp({1, 1, 1}, 10);
  off.name = "Pendant";
  const Result<BakedHome> baked = bakeHome(scene, {{off, scene.lamps[0]}, {}}, settings_, stages_);
  ASSERT_TRUE(baked) << baked.error();
  const auto json = jsonOf(baked.value().glb.bytes);
  const auto& layers = json["extensions"]["ROOMLIGHT_light_layers"]["layers"];
  ASSERT_EQ(layers.size(), 2u);  // the second is the one that is on
  EXPECT_EQ(layers[0]["on"], true);
  EXPECT_EQ(layers[1]["name"], "Pendant");
  EXPECT_EQ(layers[1]["on"], false);
}

// A panel in the middle of the room, seen from both sides.
TEST_F(Bake, aOneSidedPanelIsDarkFromBehind) {
  for (const bool doubleSided : {false, true}) {
    Scene scene = room(0.5f);
    Material glow = lambertian(0.5f, 1000);
    glow.doubleSided = doubleSided;
    addRectangle(scene, {1.5f, 1, 1.5f}, {1, 0, 0}, {0, 1, 0}, addMaterial(scene, glow));
    const Result<BakedHome> baked = bakeHome(scene, {}, settings_, stages_);
    ASSERT_TRUE(baked) << baked.error();
    const auto json = jsonOf(baked.value().glb.bytes);
    size_t shining = 0;
    for (const auto& primitive : json["meshes"][0]["primitives"]) {
      const auto& material = json["materials"][primitive["material"].get<size_t>()];
      if (material.contains("emissiveFactor"))
        shining += json["accessors"][primitive["indices"].get<size_t>()]["count"].get<size_t>();
    }
    EXPECT_EQ(shining, doubleSided ? 12u : 6u);
  }
}

TEST_F(Bake, theFileNamesWhatReadersMustKnow) {
  const auto json = jsonOf(bakeHome(room(0.5f), {}, settings_, stages_).value().glb.bytes);
  EXPECT_EQ(json["extensionsRequired"], nlohmann::json::array({"KHR_mesh_quantization"}));
  EXPECT_EQ(json["extensionsUsed"],
            nlohmann::json::array({"KHR_mesh_quantization", "KHR_materials_specular", "ROOMLIGHT_light_layers"}));
}

TEST_F(Bake, theSameBitsByOneThreadAndByTwo) {
  const Scene scene = room(0.5f);
  std::string first;
  for (const int threads : {1, 2}) {
    withThreads(threads, [&] {
      const Result<BakedHome> baked = bakeHome(scene, {}, settings_, stages_);
      ASSERT_TRUE(baked) << baked.error();
      if (threads == 1) first = baked.value().glb.bytes;
      EXPECT_TRUE(baked.value().glb.bytes == first);
    });
  }
}

// Two rooms that no door joins, a camera in the second.
TEST_F(Bake, roomsThatAreNotWalkedInAreLeftOut) {
  Scene scene = room(0.5f);
  addRoom(scene, {6, 0, 0}, {10, 2.5f, 3}, std::vector<int>(6, 0));
  Lamp other = pointLamp({8, 2, 1.5f}, kCandela);
  other.name = "Floor lamp";
  scene.lamps.push_back(other);
  Room bath;
  bath.name = "Bath", bath.floor = {{6, 0}, {6, 3}, {10, 3}, {10, 0}};
  scene.rooms.push_back(bath);
  Camera camera;
  camera.name = "Tub", camera.worldFromCamera.w = {8, 1.6f, 2};
  scene.cameras = {camera};
  BakeWish wish;
  for (const size_t which : {size_t{0}, size_t{1}}) {
    wish.rooms = {which};
    const Result<BakedHome> baked = bakeHome(scene, wish, settings_, stages_);
    ASSERT_TRUE(baked) << baked.error();
    EXPECT_EQ(baked.value().triangles, 12u);
    const auto light = jsonOf(baked.value().glb.bytes)["extensions"]["ROOMLIGHT_light_layers"];
    ASSERT_EQ(light["rooms"].size(), 1u);
    EXPECT_EQ(light["rooms"][0]["name"], which == 0 ? "Kitchen" : "Bath");
    ASSERT_EQ(light["layers"].size(), 1u);
    EXPECT_EQ(light["layers"][0]["name"], which == 0 ? "Pendant" : "Floor lamp");
    ASSERT_GE(light["cameras"].size(), 1u) << "one is proposed where there is none";
    const bool placed = light["cameras"][0]["name"] == "Tub";
    EXPECT_EQ(placed, which == 1);
  }
}

TEST_F(Bake, theBudgetIsKept) {
  const Scene scene = room(0.5f);
  BakeWish wish;
  const size_t free = bakeHome(scene, wish, settings_, stages_).value().glb.bytes.size();
  wish.budgetBytes = free * 3 / 4;
  const Result<BakedHome> small = bakeHome(scene, wish, settings_, stages_);
  ASSERT_TRUE(small) << small.error();
  EXPECT_LE(small.value().glb.bytes.size(), wish.budgetBytes);
  EXPECT_GT(small.value().settings.charts.texelM, settings_.charts.texelM);
}

TEST_F(Bake, whatARunBeforeHasFoundGivesTheSameBits) {
  const TemporaryFolder folder;
  settings_.layers.kept = KeptLight(folder / "home.light");
  const Scene scene = room(0.5f);
  const std::string first = bakeHome(scene, {}, settings_, stages_).value().glb.bytes;
  EXPECT_TRUE(settings_.layers.kept.any());
  EXPECT_TRUE(bakeHome(scene, {}, settings_, stages_).value().glb.bytes == first);
}

TEST_F(Bake, aHomeThatNobodySeesIsToldSo) {
  const Result<BakedHome> baked = bakeHome(Scene(), {}, settings_, stages_);
  ASSERT_FALSE(baked);
  EXPECT_EQ(baked.error(), "nothing of the home can be seen from its rooms or cameras");
}

}  // namespace
}  // namespace roomlight::bake
