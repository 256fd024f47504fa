#include "study/study_plan.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <fstream>

#include "engine/technique.h"
#include "engine/settings.h"
#include "unit/temporary_folder.h"

namespace roomlight {
namespace {

class StudyPlanTest : public ::testing::Test {
 protected:
  void SetUp() override {
    write("room.glb", "x");
    write("day.json", "{}");
  }
  void write(const std::string& name, const std::string& text) const { std::ofstream(folder_.path() / name) << text; }
  Result<StudyPlan> read(const std::string& text) const {
    write("plan.json", text);
    return readStudyFile(folder_.path() / "plan.json");
  }
  testing::TemporaryFolder folder_;
};

TEST_F(StudyPlanTest, ReadsScenesLightsAndTechniques) {
  const auto plan = read(
      R"({"version": 1, "scenes": [{"name": "Room", "scene": "room.glb", "camera": 2, "lights": [{"name": "daylight", "lighting": "day.json"}, {"name": "dim", "dimLamp": "150 lm"}, {"name": "own"}]}],
    "techniques": [{"name": "slow lpv", "technique": "lpv", "settings": {"lpv": {"steps": 99}}}]})");
  ASSERT_TRUE(plan) << plan.error();
  const StudyScene& s = plan.value().scenes.at(0);
  EXPECT_EQ(s.camera, "2");
  EXPECT_EQ(s.file, folder_.path() / "room.glb");
  ASSERT_EQ(s.lights.size(), 3u);
  EXPECT_EQ(s.lights[0].lighting, folder_.path() / "day.json");
  EXPECT_EQ(s.lights[1].dimLampLm, 150);
  EXPECT_TRUE(s.lights[2].lighting.empty());
  EXPECT_EQ(s.walkLight.name, "daylight");
  EXPECT_EQ(s.walkLight.lighting, s.lights[0].lighting);
  ASSERT_EQ(plan.value().techniques.size(), 1u);
  EXPECT_EQ(plan.value().techniques[0].kind, "rival");
  const auto settings = settingsFromJson(plan.value().techniques[0].settings, "plan");
  ASSERT_TRUE(settings);
  EXPECT_EQ(settings.value().lpv.steps, 99);
}

TEST_F(StudyPlanTest, IsAgainstThePublishedStudyOnlyWhereItSaysSo) {
  const std::string scenes = R"("scenes": [{"name": "Room", "scene": "room.glb", "lights": [{"name": "own"}]}])";
  EXPECT_FALSE(read("{" + scenes + "}").value().againstPublished);
  EXPECT_TRUE(read(R"({"againstPublished": true, )" + scenes + "}").value().againstPublished);
  EXPECT_FALSE(read(R"({"againstPublished": 1, )" + scenes + "}"));
}

TEST_F(StudyPlanTest, WithoutTechniquesTakesTheUsualOnes) {
  const auto plan = read(R"({"scenes": [{"name": "Room", "scene": "room.glb", "lights": [{"name": "own"}]}]})");
  ASSERT_TRUE(plan) << plan.error();
  EXPECT_EQ(plan.value().techniques.size(), usualTechniques().size());
}

TEST(StudyTechniques, TheUsualOnesAreThereWithSettingsThatAreTaken) {
  for (const StudyTechnique& t : usualTechniques()) {
    EXPECT_TRUE(findTechnique(t.technique)) << t.name;
    const auto settings = settingsFromJson(t.settings, t.name);
    EXPECT_TRUE(settings) << settings.error();
  }
}

TEST_F(StudyPlanTest, SaysWhatIsWrongAndWhere) {
  const auto scene = [](const std::string& lights, const std::string& more = "") {
    return fmt::format(R"({{"scenes": [{{"name": "Room", "scene": "room.glb", "lights": [{}]}}]{}}})", lights, more);
  };
  const std::pair<std::string, std::string> wrong[] = {
      {R"({"scenes": []})", "scenes"},
      {R"({"scenes": [{"name": "Room", "scene": "gone.glb", "lights": [{"name": "own"}]}]})", "gone.glb"},
      {scene(R"({"name": "a"}, {"name": "a"})"), "lights[1].name: 'a' is there twice"},
      {scene(R"({"name": "a", "lighting": "day.json", "dimLamp": "1 lm"})"), "one of lighting, dimLamp"},
      {scene(R"({"name": "a", "dimLamp": 150})"), "dimLamp"},
      {R"({"scenes": [{"name": "Room", "scene": "room.glb", "camera": 1.6, "lights": [{"name": "own"}]}]})",
       "scenes[0].camera: 1.6 is no camera"},
      {R"({"scenes": [{"name": "Room", "scene": "room.glb", "camera": -1, "lights": [{"name": "own"}]}]})",
       "scenes[0].camera"},
      {scene(R"({"name": "a"})", R"(, "techniques": [{"name": "x", "technique": "radiosity"}])"),
       "unknown technique 'radiosity'"},
      {scene(R"({"name": "a"})",
             R"(, "techniques": [{"name": "x", "technique": "lpv", "settings": {"lpv": {"stepps": 1}}}])"),
       "stepps"},
      {scene(R"({"name": "a"})", R"(, "techniques": [{"name": "x", "technique": "lpv", "kind": "friend"}])"), "kind"},
      {scene(R"({"name": "a"})", R"(, "techniques": [{"name": "x", "technique": "lpv", "only": "sundays"}])"), "only"},
  };
  for (const auto& [text, expected] : wrong) {
    const auto plan = read(text);
    ASSERT_FALSE(plan) << text;
    EXPECT_NE(plan.error().find(expected), std::string::npos) << plan.error();
    EXPECT_NE(plan.error().find("plan.json"), std::string::npos) << plan.error();
  }
}

}  // namespace
}  // namespace roomlight
