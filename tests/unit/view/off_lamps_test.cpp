// Lamps that are off when a home is opened can be switched on, and give no light before.
#include "view/off_lamps.h"

#include "home/light.h"
#include "support/rooms.h"
#include "unit/view/opened_file.h"
#include "view/save_lighting.h"

namespace roomlight::view {
namespace {

using nlohmann::json;

constexpr const char* kDay = R"({"scene": {"lamps": "off", "suns": "off", "sky": "off", "emission": "off"},
  "daylight": {"sky": "clear", "latitude": 48, "longitude": 11, "time": "2026-06-21T12:00+02:00"}})";

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return at == std::string::npos ? text : text.replace(at, from.size(), to);
}

void expectNoLamps(const Scene& scene) {
  for (const Lamp& lamp : scene.lamps) EXPECT_TRUE(isBlack(lamp.intensityCd) && isBlack(lamp.luminanceCdM2));
  for (const Material& m : scene.materials) EXPECT_TRUE(isBlack(m.emission)) << m.name;
}

float candela(const Scene& scene, size_t lamp) { return luminance(scene.lamps[lamp].intensityCd); }

class OffLamp : public OpenedFile {
 protected:
  OffLamp() { write("day.json", kDay); }
};

TEST_F(OffLamp, lampsThatTheFileSwitchesOffAreListedAndGiveNoLight) {
  const ViewHome home = open("day.json");
  ASSERT_EQ(home.editable.lamps.size(), 3u);
  for (const LampState& s : home.atStart().lamps) EXPECT_TRUE(!s.on && s.dim == 1);
  const Scene first = sceneIn(home, home.atStart()).value(), day = rendered("day.json");
  expectNoLamps(first);
  ASSERT_EQ(first.suns.size(), 1u);
  EXPECT_EQ(first.suns[0].illuminanceLux, day.suns.at(0).illuminanceLux);
  EXPECT_EQ(first.sky.image.pixels, day.sky.image.pixels);
}

TEST_F(OffLamp, switchedOnTheyGiveWhatTheHomeSays) {
  const ViewHome home = open("day.json");
  const size_t bulb = lampNamed(home, "Bulb"), panel = lampNamed(home, "Panel", 1);
  HomeState state = home.atStart();
  state.lamps[bulb].on = state.lamps[panel].on = true, state.lamps[panel].dim = 0.5f;
  Scene scene = sceneIn(home, home.atStart()).value();
  const SceneChange change = bring(home, home.atStart(), state, scene);
  EXPECT_TRUE(change.lamps);
  EXPECT_EQ(change.glow, home.editable.lamps[panel].instances);
  EXPECT_EQ(candela(scene, 0), 50);
  EXPECT_EQ(emissionOf(scene, home.editable.lamps[panel].instances.at(0)), Vec3(50));
  EXPECT_EQ(emissionOf(scene, home.editable.lamps[lampNamed(home, "Panel")].instances.at(0)), Vec3(0));
  bring(home, state, home.atStart(), scene);
  expectNoLamps(scene);
}

TEST_F(OffLamp, whatIsSavedKeepsThemOffUntilOneIsOn) {
  const ViewHome home = open("day.json");
  HomeState state = home.atStart();
  const size_t panel = lampNamed(home, "Panel", 1);
  EXPECT_EQ(json::parse(lightingFile(home, state))["scene"], json::parse(kDay)["scene"]);
  EXPECT_FALSE(json::parse(lightingFile(home, state)).contains("own"));
  state.lamps[panel].dim = 0.5f;  // while it is off
  write("saved.json", lightingFile(home, state));
  expectNoLamps(rendered("saved.json"));
  EXPECT_EQ(open("saved.json").atStart().lamps, state.lamps);
  state.lamps[lampNamed(home, "Bulb")].on = true;
  write("saved.json", lightingFile(home, state));
  expectSameLight(sceneIn(home, state).value(), rendered("saved.json"));
  const HomeState again = open("saved.json").atStart();
  EXPECT_TRUE(again.lamps[lampNamed(home, "Bulb")].on);
  EXPECT_FALSE(again.lamps[panel].on);
}

TEST_F(OffLamp, changesOfLampsThatTheFileSwitchesOffAreRead) {
  write("day.json", replaced(kDay, "{\"scene\"", R"({"own": [{"name": "Bulb", "dimming": 0.5}], "scene")"));
  const ViewHome home = open("day.json");
  const LampState bulb = home.atStart().lamps[lampNamed(home, "Bulb")];
  EXPECT_FALSE(bulb.on);
  EXPECT_EQ(bulb.dim, 0.5f);
}

TEST_F(OffLamp, withoutLightTheHomesLampsAreOff) {
  const ViewHome home = open("", home::LightWish::None);
  ASSERT_EQ(home.editable.lamps.size(), 3u);
  expectNoLamps(sceneIn(home, home.atStart()).value());
  write("saved.json", lightingFile(home, home.atStart()));
  expectNoLamps(rendered("saved.json"));
}

// The lamp and the panel are one lamp of the home, of which the file leaves the panel on.
TEST_F(OffLamp, halfALampStaysOff) {
  write("home.gltf", replaced(kHome, R"("name": "Bulb", "translation": [0, 1, 1])",
                              R"("name": "Panel", "translation": [0.2, 2, 0.2])"));
  write("light.json", R"({"scene": {"lamps": "off"}})");
  const ViewHome home = open("light.json");
  ASSERT_EQ(home.editable.lamps.size(), 2u);
  for (const LampState& s : home.atStart().lamps) EXPECT_TRUE(s.on);
  expectSameLight(sceneIn(home, home.atStart()).value(), rendered("light.json"));
}

TEST_F(OffLamp, dimmedToNothingIsOff) {
  write("light.json", R"({"own": [{"name": "Bulb", "dimming": 0}],
    "lamps": [{"name": "Desk", "type": "point", "position": [0, 1, 0], "flux": "300 lm", "dimming": 0}]})");
  const ViewHome home = open("light.json");
  const HomeState state = home.atStart();
  for (const char* name : {"Bulb", "Desk"}) {
    const LampState& s = state.lamps[lampNamed(home, name)];
    EXPECT_TRUE(!s.on && s.dim == 1) << name;
  }
  expectSameLight(sceneIn(home, state).value(), rendered("light.json"));
}

TEST_F(OffLamp, ofUnknownFluxTheyGiveWhatIsAssumed) {
  write("home.gltf", replaced(kHome, R"("intensity": 50)", R"("intensity": 0)"));
  const ViewHome home = open("");
  const size_t bulb = lampNamed(home, "Bulb");
  const double assumed = home::assumedFluxLm(home.scene.rooms, {0, 1, 1});
  EXPECT_TRUE(home.editable.lamps[bulb].fluxAssumed);
  HomeState state = home.atStart();
  EXPECT_FALSE(state.lamps[bulb].on);
  EXPECT_EQ(candela(sceneIn(home, state).value(), 0), 0);
  EXPECT_EQ(json::parse(lightingFile(home, state)), json({{"version", 1}}));
  state.lamps[bulb].on = true;
  EXPECT_NEAR(candela(sceneIn(home, state).value(), 0), assumed / (4 * static_cast<double>(kPi)), 0.01);
  write("saved.json", lightingFile(home, state));
  expectSameLight(sceneIn(home, state).value(), rendered("saved.json"));
  const LampState again = open("saved.json").atStart().lamps[bulb];
  EXPECT_TRUE(again.on);
  EXPECT_NEAR(again.fluxLm, assumed, 0.01);
}

TEST_F(OffLamp, ofTheFileWithoutFluxLikewise) {
  write("light.json", R"({"lamps": [{"name": "Desk", "type": "point", "position": [0, 1, 0], "flux": "0 lm"}]})");
  const ViewHome home = open("light.json");
  HomeState state = home.atStart();
  const size_t desk = lampNamed(home, "Desk");
  EXPECT_FALSE(state.lamps[desk].on);
  expectSameLight(sceneIn(home, state).value(), rendered("light.json"));
  state.lamps[desk].on = true, state.lamps[desk].dim = 0.5f;
  write("saved.json", lightingFile(home, state));
  const Scene saved = rendered("saved.json");
  EXPECT_GT(candela(saved, 1), 1);
  expectSameLight(sceneIn(home, state).value(), saved);
}

// A home of two lamps, of which one is off and not in the scene.
ViewHome homeWithOffLamp(LightingSource source, const std::vector<Lamp>& more) {
  home::OpenedHome opened;
  const int grey = test::addMaterial(opened.scene, test::lambertian(0.5f));
  test::addRoom(opened.scene, {0, 0, 0}, {3, 2.5f, 3}, std::vector<int>(6, grey));
  opened.scene.lamps = {test::pointLamp({1.5f, 2, 1.5f}, 100)};
  opened.scene.lamps[0].name = "Lamp";
  opened.before = {opened.scene.lamps, std::vector<Vec3>(opened.scene.materials.size())};
  opened.scene.lamps.insert(opened.scene.lamps.end(), more.begin(), more.end());
  Lamp off = test::pointLamp({0.5f, 1, 0.5f}, 60);
  off.name = "Spare";
  opened.offLamps = {off};
  const OffLamps marks = bringBackLamps(opened, source);
  ViewHome home("room", std::move(opened.scene));
  home.lighting = std::move(source);
  markOff(marks, home);
  home.opened = stateOfFile(home, home.lighting.document);
  return home;
}

TEST(OffLamps, thoseOfTheHomeAreThere) {
  const ViewHome home = homeWithOffLamp({}, {});
  ASSERT_EQ(home.editable.lamps.size(), 2u);
  HomeState state = home.atStart();
  EXPECT_TRUE(state.lamps[0].on);
  EXPECT_FALSE(state.lamps[1].on);
  EXPECT_TRUE(home.editable.lamps[1].fluxAssumed);
  EXPECT_EQ(candela(sceneIn(home, state).value(), 1), 0);
  state.lamps[1].on = true, state.lamps[1].dim = 0.25f;
  EXPECT_NEAR(candela(sceneIn(home, state).value(), 1), 15, 1e-3);
  // Saved it is a lamp of the file, which stands for that of the home.
  LightingSource saved;
  saved.document = json::parse(lightingFile(home, state)), saved.lamps = saved.document.at("lamps").size();
  ASSERT_EQ(saved.lamps, 1u);
  const ViewHome again = homeWithOffLamp(saved, {home.scene.lamps[1]});
  ASSERT_EQ(again.editable.lamps.size(), 2u);
  EXPECT_TRUE(again.atStart().lamps[1].on);
  EXPECT_EQ(again.atStart().lamps[1].dim, 0.25f);
}

}  // namespace
}  // namespace roomlight::view
