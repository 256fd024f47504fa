// What is saved lights a home as it was seen.
#include "view/save_lighting.h"

#include <gtest/gtest.h>

#include "unit/temporary_folder.h"
#include "import/import.h"
#include "import/lighting_file.h"
#include "view/open_home.h"

namespace roomlight::view {
namespace {

using nlohmann::json;

// A floor, a panel that shines twice, and a lamp of the file's own.
constexpr const char* kHome = R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0, 1, 2, 3]}],
  "nodes": [{"name": "Floor", "mesh": 0, "scale": [3, 3, 3]}, {"name": "Panel", "mesh": 1, "translation": [0, 2, 0]}, {"name": "Panel", "mesh": 1, "translation": [1, 2, 0]},
            {"name": "Bulb", "translation": [0, 1, 1], "extensions": {"KHR_lights_punctual": {"light": 0}}}],
  "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "material": 0}]}, {"primitives": [{"attributes": {"POSITION": 0}, "material": 1}]}],
  "materials": [{"name": "Floor"}, {"name": "Glow", "emissiveFactor": [1, 1, 1], "extensions": {"KHR_materials_emissive_strength": {"emissiveStrength": 100}}}],
  "extensionsUsed": ["KHR_lights_punctual", "KHR_materials_emissive_strength"],
  "extensions": {"KHR_lights_punctual": {"lights": [{"type": "point", "intensity": 50}]}},
  "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3", "min": [0, 0, 0], "max": [1, 0, 1]}],
  "bufferViews": [{"buffer": 0, "byteLength": 36}],
  "buffers": [{"byteLength": 36, "uri": "data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAAAAAAAAAAAAAIA/AACAPwAAAAAAAAAA"}]})";

constexpr const char* kLighting =
    R"({"lamps": [{"name": "Desk", "type": "spot", "position": [0, 1, 0], "direction": [0, -1, 0], "flux": "300 lm", "dimming": 0.5, "temperature": "3000 K"}],
  "own": [{"name": "Panel", "number": 2, "dimming": 0.25}],
  "daylight": {"sky": "clear", "latitude": 48, "longitude": 11, "time": "2026-06-21T12:00+02:00"}})";

class SaveLighting : public ::testing::Test {
 protected:
  SaveLighting() {
    roomlight::testing::writeFile(folder_ / "home.gltf", kHome);
    roomlight::testing::writeFile(folder_ / "light.json", kLighting);
  }
  home::OpenWish wishFor(const std::string& lighting, home::LightWish light = home::LightWish::File) const {
    home::OpenWish wish;
    wish.scene = folder_ / "home.gltf", wish.light = light;
    if (!lighting.empty()) wish.lighting = folder_ / lighting;
    return wish;
  }
  ViewHome open(const std::string& lighting, home::LightWish light = home::LightWish::File) {
    Result<OpenedView> opened = view::openHome(wishFor(lighting, light));
    EXPECT_TRUE(opened.ok()) << opened.error();
    return std::move(opened.value().home);
  }
  // The scene as `render --lighting` has it.
  Scene rendered(const std::string& lighting) {
    Scene scene = std::move(importScene(folder_ / "home.gltf", {}).value().scene);
    const Status s = applyLightingFile(folder_ / lighting, scene);
    EXPECT_TRUE(s.ok()) << s.error();
    return scene;
  }
  static void expectSameLight(const Scene& a, const Scene& b) {
    ASSERT_EQ(a.lamps.size(), b.lamps.size());
    for (size_t i = 0; i < a.lamps.size(); ++i) {
      EXPECT_NEAR(luminance(a.lamps[i].intensityCd), luminance(b.lamps[i].intensityCd),
                  1e-3 * static_cast<double>(luminance(b.lamps[i].intensityCd)) + 1e-6)
          << i;
      EXPECT_NEAR(length(a.lamps[i].position - b.lamps[i].position), 0, 1e-4) << i;
      EXPECT_NEAR(length(a.lamps[i].direction - b.lamps[i].direction), 0, 1e-4) << i;
    }
    const auto emission = [](const Scene& s, size_t i) {
      return s.materials[static_cast<size_t>(s.meshes[static_cast<size_t>(s.instances[i].mesh)].material)].emission;
    };
    for (size_t i = 0; i < b.instances.size(); ++i) EXPECT_NEAR(length(emission(a, i) - emission(b, i)), 0, 1e-3) << i;
    ASSERT_EQ(a.suns.size(), b.suns.size());
    for (size_t i = 0; i < a.suns.size(); ++i) EXPECT_NEAR(length(a.suns[i].toLight - b.suns[i].toLight), 0, 1e-4);
  }
  static size_t lampNamed(const ViewHome& home, const std::string& name, size_t number = 0) {
    for (size_t i = 0; i < home.editable.lamps.size(); ++i) {
      if (home.editable.lamps[i].name == name && number-- == 0) return i;
    }
    ADD_FAILURE() << name;
    return 0;
  }
  roomlight::testing::TemporaryFolder folder_;
};

TEST_F(SaveLighting, homesOpenAsTheirFilesSay) {
  const ViewHome home = open("light.json");
  EXPECT_EQ(home.atStart().lamps[lampNamed(home, "Desk")].dim, 0.5f);
  EXPECT_EQ(home.atStart().lamps[lampNamed(home, "Panel", 1)].dim, 0.25f);
  ASSERT_TRUE(home.atStart().sun);
  EXPECT_NEAR(home.atStart().sun->hour, 12, 1e-9);
  expectSameLight(sceneIn(home, home.atStart()).value(), rendered("light.json"));
}

TEST_F(SaveLighting, whatWasChangedIsSaved) {
  const ViewHome home = open("light.json");
  HomeState state = home.atStart();
  LampState& desk = state.lamps[lampNamed(home, "Desk")];
  desk.dim = 0.8f, desk.position = {0.5f, 1.5f, 0}, desk.direction = {1, 0, 0}, desk.temperatureK = 4000,
  desk.fluxLm = 600;
  state.lamps[lampNamed(home, "Panel")].on = false;
  LampState& bulb = state.lamps[lampNamed(home, "Bulb")];
  bulb.fluxLm *= 2, bulb.position = {0, 2, 1}, bulb.color = Vec3(1, 1, 1);
  state.sun->hour = 17.5;
  roomlight::testing::writeFile(folder_ / "saved.json", lightingFile(home, state));
  expectSameLight(sceneIn(home, state).value(), rendered("saved.json"));
  const ViewHome again = open("saved.json");
  EXPECT_EQ(again.atStart().lamps[lampNamed(again, "Desk")].dim, 0.8f);
  EXPECT_NEAR(again.atStart().sun->hour, 17.5, 1e-3);
  EXPECT_EQ(json::parse(lightingFile(again, again.atStart()))["lamps"],
            json::parse(lightingFile(home, state))["lamps"]);
}

TEST_F(SaveLighting, homesWithoutAFileSaveWhatWasChanged) {
  const ViewHome home = open("");
  HomeState state = home.atStart();
  EXPECT_EQ(json::parse(lightingFile(home, state)), json({{"version", 1}}));
  state.lamps[lampNamed(home, "Panel", 1)].dim = 0.5f;
  roomlight::testing::writeFile(folder_ / "saved.json", lightingFile(home, state));
  expectSameLight(sceneIn(home, state).value(), rendered("saved.json"));
}

// Light that was added is part of what is saved, after what the file says.
TEST_F(SaveLighting, ofAddedLight) {
  const ViewHome home = open("light.json", home::LightWish::Evening);
  const json saved = json::parse(lightingFile(home, home.atStart()));
  ASSERT_TRUE(saved.contains("daylight"));
  EXPECT_GT(saved["daylight"].at("time").get<std::string>().substr(11, 5), "20:00");  // not the file's noon
  EXPECT_EQ(saved.at("scene"), json({{"suns", "off"}, {"sky", "off"}}));
  roomlight::testing::writeFile(folder_ / "saved.json", saved.dump());
  expectSameLight(sceneIn(home, home.atStart()).value(), rendered("saved.json"));
}

TEST_F(SaveLighting, wrongDimmingIsRefused) {
  for (const char* text : {R"({"lamps": [{"type": "point", "position": [0, 0, 0], "flux": "1 lm", "dimming": 3}]})",
                           R"({"own": [{"name": "Nobody"}]})", R"({"own": [{"name": "Panel", "number": 3}]})"}) {
    roomlight::testing::writeFile(folder_ / "wrong.json", text);
    EXPECT_FALSE(view::openHome(wishFor("wrong.json")).ok()) << text;
  }
}

}  // namespace
}  // namespace roomlight::view
