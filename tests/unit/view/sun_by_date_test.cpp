// Every home has a sun to move: by its lighting, else off until somebody switches it on.
#include "view/sun_by_date.h"

#include <fmt/format.h>

#include "home/light.h"
#include "unit/view/opened_file.h"
#include "view/apply_edit.h"
#include "view/save_lighting.h"

namespace roomlight::view {
namespace {

using nlohmann::json;

constexpr const char* kLampsOnly =
    R"({"scene": {"suns": "off"}, "lamps": [{"name": "Desk", "type": "point", "position": [0, 1, 0], "flux": "300 lm"}]})";

HomeState edited(const ViewHome& home, const HomeState& now, auto set) {
  Edit edit;
  edit.id = 1, edit.target = "sun";
  set(edit.set);
  Edited out;
  EXPECT_FALSE(applyEdit(home.editable, home.scene, edit, now, out));
  return out.state;
}

class SunByDateOf : public OpenedFile {
 protected:
  ViewHome openWith(const std::string& lighting) {
    write("light.json", lighting);
    return open("light.json");
  }
};

TEST_F(SunByDateOf, aFileOfLampsHasASunThatIsOff) {
  const ViewHome home = openWith(kLampsOnly);
  ASSERT_TRUE(home.sun);
  EXPECT_EQ(home.sun->placeFrom, PlaceFrom::Assumed);
  EXPECT_EQ(home.sun->latitudeDeg, home::assumedDaylight()["latitude"].get<double>());
  const HomeState first = home.atStart();
  ASSERT_TRUE(first.sun);
  EXPECT_FALSE(first.sun->on);
  Scene scene = sceneIn(home, first).value();
  EXPECT_TRUE(scene.suns.empty());
  EXPECT_FALSE(scene.sky.present());
  const HomeState moved = edited(home, first, [](EditFields& s) { s.hour = 15; });
  EXPECT_TRUE(moved.sun->on);
  EXPECT_TRUE(bring(home, first, moved, scene).daylight);
  EXPECT_EQ(scene.suns.size(), 1u);
  EXPECT_TRUE(scene.sky.present());
  const HomeState off = edited(home, moved, [](EditFields& s) { s.on = false; });
  EXPECT_EQ(off.sun->hour, 15);
  bring(home, moved, off, scene);
  EXPECT_TRUE(scene.suns.empty());
  EXPECT_FALSE(scene.sky.present());
}

TEST_F(SunByDateOf, daylightThatWasAddedStandsAtAnAssumedPlace) {
  const ViewHome home = open("", home::LightWish::Day);
  ASSERT_TRUE(home.sun);
  EXPECT_TRUE(home.sun->atStart.on);
  EXPECT_EQ(home.sun->placeFrom, PlaceFrom::Assumed);
}

TEST_F(SunByDateOf, switchedOnItShinesAtTheHourThatItShows) {
  const ViewHome home = openWith(kLampsOnly);
  const HomeState on = edited(home, home.atStart(), [](EditFields& s) { s.on = true; });
  EXPECT_EQ(on.sun->hour, home.sun->atStart.hour);
  EXPECT_EQ(sceneIn(home, on).value().suns.size(), 1u);
}

// An hour that is dragged asks for many moments.
TEST_F(SunByDateOf, weatherIsReadOnceForAllMoments) {
  std::string weather = "LOCATION,Town,-,DEU,IWEC,1,48.14,11.58,1.0,500\nDATA PERIODS,1,1,Data,Sunday,1/1,12/31\n";
  for (const auto& [hour, direct] : {std::pair(12, 700), std::pair(16, 300)})
    weather +=
        fmt::format("2005,6,10,{},60,?9,20,8,50,101300,0,1300,300,500,{},120,50000,0,0,9999,180,3\n", hour, direct);
  write("town.epw", weather);
  const auto lighting = [](const char* time) {
    return json({{"daylight", {{"weather", "town.epw"}, {"time", time}}}}).dump();
  };
  write("later.json", lighting("2026-06-10T15:30+01:00"));
  const Scene expected = rendered("later.json");
  const ViewHome home = openWith(lighting("2026-06-10T11:30+01:00"));
  EXPECT_EQ(home.sun->latitudeDeg, 48.14);
  EXPECT_EQ(home.sun->longitudeDeg, 11.58);
  std::filesystem::remove(folder_ / "town.epw");
  const HomeState later = edited(home, home.atStart(), [](EditFields& s) { s.hour = 15.5; });
  const Result<Scene> scene = sceneIn(home, later);
  ASSERT_TRUE(scene) << scene.error();
  expectSameLight(scene.value(), expected);
  EXPECT_EQ(scene.value().sky.image.pixels, expected.sky.image.pixels);
  // What its file does not hold is still told.
  const Result<Scene> none = sceneIn(home, edited(home, later, [](EditFields& s) { s.hour = 9; }));
  ASSERT_FALSE(none);
  EXPECT_NE(none.error().find("no weather of that hour"), std::string::npos) << none.error();
}

TEST_F(SunByDateOf, whatHasNoDateStaysUntilThen) {
  const ViewHome home = openWith(R"({"sun": [{"direction": [0, 1, 1], "illuminance": "10 klx"},
    {"latitude": -33.9, "longitude": 151.2, "time": "2026-01-05T10:00+11:00"}], "sky": {"luminance": "500 cd/m2"}})");
  EXPECT_EQ(home.sun->placeFrom, PlaceFrom::Lighting);
  EXPECT_EQ(home.sun->latitudeDeg, -33.9);
  EXPECT_EQ(home.sun->utcOffsetH, 11);
  expectSameLight(sceneIn(home, home.atStart()).value(), rendered("light.json"));
  const HomeState on = edited(home, home.atStart(), [](EditFields& s) { s.on = true; });
  const Scene dated = sceneIn(home, on).value();
  EXPECT_EQ(dated.suns.size(), 1u);
  write("saved.json", lightingFile(home, on));
  const Scene saved = rendered("saved.json");
  expectSameLight(dated, saved);
  EXPECT_EQ(saved.sky.image.pixels, dated.sky.image.pixels);
}

TEST_F(SunByDateOf, aSkyByDirectionGivesWay) {
  const ViewHome home =
      openWith(R"({"daylight": {"sky": "clear", "direction": [0.6, -0.14, -0.8], "sunIlluminance": "0 lx"}})");
  EXPECT_FALSE(home.atStart().sun->on);
  const HomeState on = edited(home, home.atStart(), [](EditFields& s) { s.year = 2026, s.month = 6, s.day = 21; });
  write("saved.json", lightingFile(home, on));
  expectSameLight(sceneIn(home, on).value(), rendered("saved.json"));
  EXPECT_TRUE(open("saved.json").atStart().sun->on);
}

TEST_F(SunByDateOf, offItIsSavedAsItCame) {
  const ViewHome home = openWith(kLampsOnly);
  HomeState state = home.atStart();
  state.sun->hour = 3;
  const json saved = json::parse(lightingFile(home, state));
  EXPECT_FALSE(saved.contains("daylight"));
  EXPECT_EQ(saved["scene"], json({{"suns", "off"}}));
}

TEST_F(SunByDateOf, daylightOfTheFileCanBeSwitchedOff) {
  const ViewHome home =
      openWith(R"({"daylight": {"sky": "clear", "latitude": 48, "longitude": 11, "time": "2026-06-21T12:00+02:00"}})");
  EXPECT_TRUE(home.atStart().sun->on);
  const HomeState off = edited(home, home.atStart(), [](EditFields& s) { s.on = false; });
  const Scene dark = sceneIn(home, off).value();
  EXPECT_TRUE(dark.suns.empty());
  EXPECT_FALSE(dark.sky.present());
  write("saved.json", lightingFile(home, off));
  const Scene saved = rendered("saved.json");
  EXPECT_TRUE(saved.suns.empty());
  EXPECT_FALSE(saved.sky.present());
}

TEST(SunOffAtFirst, standsWhereTheHomeDoes) {
  const json home = {
      {"sky", "clear"}, {"latitude", 60}, {"longitude", 25}, {"north", 30}, {"time", "2026-03-01T09:00:00+02:00"}};
  const json assumed = home::assumedDaylight();
  const SunByDate own = sunOffAtFirst(json(), home, assumed);
  EXPECT_EQ(own.placeFrom, PlaceFrom::Home);
  EXPECT_EQ(own.latitudeDeg, 60);
  EXPECT_EQ(own.atStart.hour, 9);
  EXPECT_FALSE(own.atStart.on);
  // A place of the lighting file without a time: noon there.
  const SunByDate there =
      sunOffAtFirst({{"daylight", {{"sky", "overcast"}, {"latitude", 35}, {"longitude", 139}}}}, home, assumed);
  EXPECT_EQ(there.placeFrom, PlaceFrom::Lighting);
  EXPECT_EQ(there.utcOffsetH, 9);
  EXPECT_EQ(there.atStart.hour, 12);
  EXPECT_EQ(sunOffAtFirst(json(), json(), assumed).placeFrom, PlaceFrom::Assumed);
}

}  // namespace
}  // namespace roomlight::view
