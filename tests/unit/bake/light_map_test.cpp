// Light as one texture, as programs read it that know no layers.
#include "bake/light_map.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <nlohmann/json.hpp>

#include "bake/bake.h"
#include "base/tone.h"
#include "support/rooms.h"

namespace roomlight::bake {
namespace {

constexpr float kEv100 = 8;

Image light(std::vector<Vec3> lux) {
  Image image(static_cast<int>(lux.size()), 1);
  image.pixels = std::move(lux);
  return image;
}

Vec3 luxOf(const LightMap& map, size_t pixel) {
  const uint8_t* s = &map.image.samples[3 * pixel];
  return Vec3(srgbDecode(static_cast<float>(s[0]) / 255), srgbDecode(static_cast<float>(s[1]) / 255),
              srgbDecode(static_cast<float>(s[2]) / 255)) *
         map.luxAtOne;
}

TEST(LightMap, holdsLightWithinAStepOfEightBits) {
  const std::vector<Vec3> lux{{900, 700, 300}, {90, 90, 90}, {0, 20, 5}};
  const LightMap map = lightMapOf(light(lux), kEv100);
  EXPECT_FLOAT_EQ(map.luxAtOne, 900);
  for (size_t i = 0; i < lux.size(); ++i) {
    const Vec3 back = luxOf(map, i);
    for (const auto& [is, was] : {std::pair(back.x, lux[i].x), {back.y, lux[i].y}, {back.z, lux[i].z}})
      EXPECT_NEAR(is, was, 0.02f * was + 0.3f) << i;
  }
}

TEST(LightMap, clipsWhatIsShownAsWhiteAnyway) {
  const float white = kPi / exposureFromEv100(kEv100);  // lux that make a white surface white
  const LightMap map = lightMapOf(light({Vec3(50 * white), Vec3(0.2f * white)}), kEv100);
  EXPECT_NEAR(map.luxAtOne, 4 * white, 1e-3f * white);
  EXPECT_NEAR(luxOf(map, 1).x, 0.2f * white, 0.02f * 0.2f * white);
}

TEST(LightMap, ofADarkHomeIsBlack) {
  const LightMap map = lightMapOf(light({Vec3(0), Vec3(0)}), kEv100);
  EXPECT_GT(map.luxAtOne, 0);
  EXPECT_EQ(map.image.samples, std::vector<uint8_t>(6));
}

TEST(LightMap, sumsWhatIsOnAtFirst) {
  Atlas atlas;
  atlas.width = 2, atlas.height = 1;
  atlas.elements.resize(1), atlas.texels = {0}, atlas.padding = {{1, 0}};
  const auto layer = [](bool on, double hour, float lux) {
    BakedLayer l;
    l.on = on, l.hour = hour, l.lux = {Vec3(lux)};
    return l;
  };
  const LampLayers lamps{{layer(true, 0, 1), layer(false, 0, 2)}, {}};
  const Image sum = lightAtFirst(atlas, lamps, {layer(true, 9, 4), layer(false, 9, 8), layer(true, 12, 16)});
  EXPECT_EQ(sum.pixels[0].x, 5);
  EXPECT_EQ(sum.pixels[1].x, 5) << "texels beside charts continue them";
}

// The numbers of an accessor, by whole views.
std::vector<uint32_t> numbersOf(const nlohmann::json& json, const std::string& glb, const nlohmann::json& accessor) {
  uint32_t length = 0;
  std::memcpy(&length, glb.data() + 12, 4);
  const auto& view = json["bufferViews"][json["accessors"][accessor.get<size_t>()]["bufferView"].get<size_t>()];
  std::vector<uint32_t> numbers(view["byteLength"].get<size_t>() / 4);
  std::memcpy(numbers.data(), glb.data() + 20 + length + 8 + view.value("byteOffset", size_t{0}), numbers.size() * 4);
  return numbers;
}

TEST(LightMap, isAskedForByEveryMaterialAndTrianglesOfFineThingsHaveOneTexel) {
  Scene scene;
  const int white = addMaterial(scene, lambertian(0.5f));
  addRoom(scene, {0, 0, 0}, {4, 2.5f, 3}, std::vector<int>(6, white));
  addSphere(scene, {2, 1, 1.5f}, 0.1f, addMaterial(scene, lambertian(0.3f)));
  scene.lamps = {pointLamp({2, 2, 1.5f}, 100)};
  Room floor;
  floor.floor = {{0, 0}, {0, 3}, {4, 3}, {4, 0}};
  scene.rooms = {floor};
  BakeSettings settings = bakeSettings("draft").value();
  settings.glb.lightMap = true;
  const RenderProgress quiet;
  RenderStats stats;
  Stages stages(quiet, stats);
  const Result<BakedHome> baked = bakeHome(scene, {}, settings, stages);
  ASSERT_TRUE(baked) << baked.error();
  const std::string& glb = baked.value().glb.bytes;
  uint32_t length = 0;
  std::memcpy(&length, glb.data() + 12, 4);
  const auto json = nlohmann::json::parse(glb.substr(20, length));

  const auto& map = json["extensions"]["ROOMLIGHT_light_layers"]["lightMap"];
  EXPECT_GT(map["luxAtOne"], 0);
  ASSERT_EQ(json["materials"].size(), 2u);
  for (const auto& material : json["materials"]) {
    EXPECT_EQ(material["extensions"]["MOZ_lightmap"]["index"], map["texture"]);
    EXPECT_EQ(material["extensions"]["MOZ_lightmap"]["texCoord"], 1);
  }
  EXPECT_NE(std::find(json["extensionsUsed"].begin(), json["extensionsUsed"].end(), "MOZ_lightmap"),
            json["extensionsUsed"].end());
  size_t fine = 0;
  for (const auto& primitive : json["meshes"][0]["primitives"]) {
    const auto& attributes = primitive["attributes"];
    for (const uint32_t lit : numbersOf(json, glb, attributes["_VERTEX_LIT"])) EXPECT_EQ(lit, 0u);
    const std::vector<uint32_t> texels = numbersOf(json, glb, attributes["TEXCOORD_1"]),
                                indices = numbersOf(json, glb, primitive["indices"]);
    if (indices.size() <= 36) continue;  // the walls
    for (size_t t = 0; t + 2 < indices.size(); t += 3, ++fine) {
      EXPECT_EQ(texels[indices[t]], texels[indices[t + 1]]);
      EXPECT_EQ(texels[indices[t]], texels[indices[t + 2]]);
    }
  }
  EXPECT_GT(fine, 50u);
}

}  // namespace
}  // namespace roomlight::bake
