// What is saved lights a home as it was seen.
#include "view/save_lighting.h"

#include "unit/view/opened_file.h"

namespace roomlight::view {
namespace {

using nlohmann::json;

constexpr const char* kLighting =
    R"({"lamps": [{"name": "Desk", "type": "spot", "position": [0, 1, 0], "direction": [0, -1, 0], "flux": "300 lm", "dimming": 0.5, "temperature": "3000 K"}],
  "own": [{"name": "Panel", "number": 2, "dimming": 0.25}],
  "daylight": {"sky": "clear", "latitude": 48, "longitude": 11, "time": "2026-06-21T12:00+02:00"}})";

class SaveLighting : public OpenedFile {
 protected:
  SaveLighting() { write("light.json", kLighting); }
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
  write("saved.json", lightingFile(home, state));
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
  write("saved.json", lightingFile(home, state));
  expectSameLight(sceneIn(home, state).value(), rendered("saved.json"));
}

// Light that was added is part of what is saved, after what the file says.
TEST_F(SaveLighting, ofAddedLight) {
  const ViewHome home = open("light.json", home::LightWish::Evening);
  const json saved = json::parse(lightingFile(home, home.atStart()));
  ASSERT_TRUE(saved.contains("daylight"));
  EXPECT_GT(saved["daylight"].at("time").get<std::string>().substr(11, 5), "20:00");  // not the file's noon
  EXPECT_EQ(saved.at("scene"), json({{"suns", "off"}, {"sky", "off"}}));
  write("saved.json", saved.dump());
  expectSameLight(sceneIn(home, home.atStart()).value(), rendered("saved.json"));
}

TEST_F(SaveLighting, wrongDimmingIsRefused) {
  for (const char* text : {R"({"lamps": [{"type": "point", "position": [0, 0, 0], "flux": "1 lm", "dimming": 3}]})",
                           R"({"own": [{"name": "Nobody"}]})", R"({"own": [{"name": "Panel", "number": 3}]})"}) {
    write("wrong.json", text);
    EXPECT_FALSE(view::openHome(wishFor("wrong.json")).ok()) << text;
  }
}

}  // namespace
}  // namespace roomlight::view
