// `roomlight study` from outside.
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <nlohmann/json.hpp>

#include "base/image_io.h"
#include "unit/cli/program.h"

namespace roomlight {
namespace {

using testing::ProgramRun;
using testing::readFile;
using testing::runProgram;
using testing::TemporaryFolder;
using testing::writeFile;

std::vector<std::string> command(const TemporaryFolder& folder, std::initializer_list<std::string> more = {}) {
  testing::writeRoom(folder);
  writeFile(
      folder / "plan.json",
      R"({"scenes": [{"name": "Room", "scene": "room.gltf", "camera": "Front", "lights": [{"name": "own"}, {"name": "one dim lamp", "dimLamp": "150 lm"}]}]})");
  std::vector<std::string> words = {"study",
                                    folder / "plan.json",
                                    "-o",
                                    folder / "out",
                                    "--technique",
                                    "cone",
                                    "--technique",
                                    "lpv",
                                    "--size",
                                    "32x18",
                                    "--runs",
                                    "1",
                                    "--most-seconds",
                                    "0.2",
                                    "--reference-seconds",
                                    "1"};
  words.insert(words.end(), more);
  return words;
}

TEST(StudyCommand, measuresAndWritesEveryReportAndDoesNotMeasureTwice) {
  const TemporaryFolder folder;
  const ProgramRun run = runProgram(command(folder));
  ASSERT_EQ(run.exitStatus, 0) << run.err;
  EXPECT_NE(run.err.find("Room, one dim lamp: cone, 1 samples"), std::string::npos) << run.err;
  const auto j = nlohmann::json::parse(readFile(folder / "out/study.json"));
  ASSERT_EQ(j["cases"].size(), 2u);
  for (const auto& one : j["cases"]) {
    for (const auto& curve : one["curves"]) {
      ASSERT_FALSE(curve["points"].empty()) << curve;
      EXPECT_GT(curve["points"][0]["memoryMiB"].get<double>(), 5);
      EXPECT_LT(curve["points"].back()["mseBeyondNoise"].get<double>(), 0.1);
    }
  }
  for (const char* name : {"study.html", "study.csv", "study.md"})
    EXPECT_GT(readFile(folder / "out" / name).size(), 300u) << name;
  const auto lighting =
      nlohmann::json::parse(readFile(folder / ("out/runs/" + j["cases"][1]["lighting"].get<std::string>())));
  EXPECT_EQ(lighting["lamps"][0]["flux"], "150 lm");

  const ProgramRun again = runProgram(command(folder));
  ASSERT_EQ(again.exitStatus, 0) << again.err;
  EXPECT_EQ(nlohmann::json::parse(readFile(folder / "out/study.json"))["cases"], j["cases"])
      << "times too are those of the first";
}

TEST(StudyCommand, takesThePictureOfAnother) {
  const TemporaryFolder folder;
  testing::writeRoom(folder);
  ASSERT_EQ(runProgram({"render", folder / "room.gltf", "--camera", "Front", "--size", "32x18", "--technique", "path",
                        "--samples", "16", "-o", folder / "other.exr", "--quiet"})
                .exitStatus,
            0);
  const ProgramRun run = runProgram(
      command(folder, {"--only", "own", "--external", "offline=" + (folder / "other.exr").string() + ",90"}));
  ASSERT_EQ(run.exitStatus, 0) << run.err;
  const auto j = nlohmann::json::parse(readFile(folder / "out/study.json"));
  ASSERT_EQ(j["cases"].size(), 1u);
  EXPECT_EQ(j["cases"][0]["externals"][0]["name"], "offline");
  EXPECT_EQ(j["cases"][0]["externals"][0]["seconds"], 90);
  EXPECT_NE(readFile(folder / "out/study.md").find("offline (external)"), std::string::npos);
}

// The same in which the room is walked through, past this object.
std::vector<std::string> walkCommand(const TemporaryFolder& folder, const std::string& object) {
  const std::vector<std::string> words =
      command(folder, {"--only", "one dim lamp", "--walk-size", "32x18", "--walk-frames", "2"});
  const std::string objects =
      R"([{"name": ")" + object + R"(", "keys": [{"time": 0}, {"time": 1, "move": [0.2, 0, 0]}]}])";
  const std::string camera =
      R"([{"time": 0, "position": [0, 1.5, 1.8], "target": [0, 1.5, 0]}, {"time": 1, "position": [-1, 1.5, 1.5], "target": [0, 1.5, 0]}])";
  writeFile(folder / "walk.json", R"({"seconds": 1, "camera": )" + camera + R"(, "objects": )" + objects + "}");
  writeFile(
      folder / "plan.json",
      R"({"scenes": [{"name": "Room", "scene": "room.gltf", "camera": "Front", "lights": [{"name": "own"}, {"name": "one dim lamp", "dimLamp": "150 lm"}], "walk": "walk.json"}]})");
  return words;
}

TEST(StudyCommand, walksInTheFirstLightOfThePlan) {
  const TemporaryFolder folder;
  const ProgramRun run = runProgram(walkCommand(folder, "Pillar"));
  ASSERT_EQ(run.exitStatus, 0) << run.err;
  const auto j = nlohmann::json::parse(readFile(folder / "out/study.json"));
  ASSERT_EQ(j["cases"].size(), 1u);
  EXPECT_EQ(j["cases"][0]["light"], "one dim lamp");
  ASSERT_EQ(j["frames"].size(), 2u);
  for (const auto& frames : j["frames"]) {
    EXPECT_EQ(frames["light"], "own");
    EXPECT_EQ(frames["frames"], 2) << frames;
  }
}

TEST(StudyCommand, readsWalksBeforeItMeasures) {
  const TemporaryFolder folder;
  const ProgramRun run = runProgram(walkCommand(folder, "Sofa"));
  EXPECT_EQ(run.exitStatus, 2);
  EXPECT_NE(run.err.find("walk.json: objects[0].name: no object 'Sofa'"), std::string::npos) << run.err;
  EXPECT_EQ(run.err.find("reference"), std::string::npos) << run.err;
}

TEST(StudyCommand, endsWithAnErrorWhereNothingCouldBeMeasured) {
  const TemporaryFolder folder;
  const std::vector<std::string> words = command(folder);
  writeFile(folder / "plan.json",
            R"({"scenes": [{"name": "Room", "scene": "room.gltf", "camera": "Garden", "lights": [{"name": "own"}]}]})");
  const ProgramRun run = runProgram(words);
  EXPECT_EQ(run.exitStatus, 1);
  EXPECT_NE(run.err.find("nothing could be measured: Room, own: left out: "), std::string::npos) << run.err;
  EXPECT_NE(readFile(folder / "out/study.html").find("Room, own: left out: "), std::string::npos);
}

TEST(StudyCommand, refusesWhatItCannotUse) {
  const TemporaryFolder folder;
  Image broken(32, 18);
  broken.pixels[5].x = std::numeric_limits<float>::infinity();
  ASSERT_TRUE(writeExr(folder / "broken.exr", broken, {}));
  ASSERT_TRUE(writeExr(folder / "black.exr", Image(32, 18), {}));
  const std::pair<std::vector<std::string>, std::string> wrong[] = {
      {command(folder, {"--external", "offline"}), "NAME=picture.exr,SECONDS"},
      {command(folder, {"--external", "offline=gone.exr,9"}), "gone.exr: no such file"},
      {command(folder, {"--external", "offline@Room/own=" + (folder / "broken.exr").string() + ",9"}),
       "broken.exr: holds values that are not finite"},
      {command(folder, {"--external", "cone@Room/own=" + (folder / "black.exr").string() + ",9"}),
       "the name is taken in Room/own"},
      {command(folder, {"--external", "a@Room/own=" + (folder / "black.exr").string() + ",9", "--external",
                        "a@Room/own=" + (folder / "black.exr").string() + ",8"}),
       "the name is taken in Room/own"},
      {command(folder, {"--only", "garden"}), "no SCENE/LIGHT holds this"},
      {command(folder, {"--technique", "vxgj"}), "'vxgi'"},
      {{"study", folder / "gone.json", "-o", folder / "out"}, "gone.json"},
  };
  for (const auto& [words, expected] : wrong) {
    const ProgramRun run = runProgram(words);
    EXPECT_EQ(run.exitStatus, 2) << expected;
    EXPECT_NE(run.err.find(expected), std::string::npos) << run.err;
  }
  EXPECT_FALSE(std::filesystem::exists(folder / "out"));
}

TEST(StudyCommand, reportsOfOtherOptionsLeaveThoseThatAreThere) {
  const TemporaryFolder folder;
  ASSERT_EQ(runProgram(command(folder, {"--only", "Room/own"})).exitStatus, 0);
  const std::string report = readFile(folder / "out/study.csv");
  EXPECT_EQ(runProgram(command(folder, {"--only", "Room/own", "--report-only"})).exitStatus, 0);
  EXPECT_EQ(readFile(folder / "out/study.csv"), report);
  std::vector<std::string> words = command(folder, {"--report-only"});
  std::replace(words.begin(), words.end(), std::string("32x18"), std::string("16x16"));
  const ProgramRun other = runProgram(words);
  EXPECT_EQ(other.exitStatus, 1);
  EXPECT_NE(other.err.find("was not measured"), std::string::npos) << other.err;
  EXPECT_EQ(readFile(folder / "out/study.csv"), report);
}

}  // namespace
}  // namespace roomlight
