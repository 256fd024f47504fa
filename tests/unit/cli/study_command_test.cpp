// `roomlight study` from outside.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

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
  writeFile(folder / "plan.json", R"({"scenes": [{"name": "Room", "scene": "room.gltf", "camera": "Front", "lights": [{"name": "own"}, {"name": "one dim lamp", "dimLamp": "150 lm"}]}]})");
  std::vector<std::string> words = {"study", folder / "plan.json", "-o", folder / "out", "--technique", "cone", "--technique", "lpv", "--size", "32x18", "--runs", "1", "--most-seconds", "0.2", "--reference-seconds", "1"};
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
  for (const char* name : {"study.html", "study.csv", "study.md"}) EXPECT_GT(readFile(folder / "out" / name).size(), 300u) << name;
  const auto lighting = nlohmann::json::parse(readFile(folder / ("out/runs/" + j["cases"][1]["lighting"].get<std::string>())));
  EXPECT_EQ(lighting["lamps"][0]["flux"], "150 lm");

  const ProgramRun again = runProgram(command(folder));
  ASSERT_EQ(again.exitStatus, 0) << again.err;
  EXPECT_EQ(nlohmann::json::parse(readFile(folder / "out/study.json"))["cases"], j["cases"]) << "times too are those of the first";
}

TEST(StudyCommand, takesThePictureOfAnother) {
  const TemporaryFolder folder;
  testing::writeRoom(folder);
  ASSERT_EQ(runProgram({"render", folder / "room.gltf", "--camera", "Front", "--size", "32x18", "--technique", "path", "--samples", "16", "-o", folder / "other.exr", "--quiet"}).exitStatus, 0);
  const ProgramRun run = runProgram(command(folder, {"--only", "own", "--external", "offline=" + (folder / "other.exr").string() + ",90"}));
  ASSERT_EQ(run.exitStatus, 0) << run.err;
  const auto j = nlohmann::json::parse(readFile(folder / "out/study.json"));
  ASSERT_EQ(j["cases"].size(), 1u);
  EXPECT_EQ(j["cases"][0]["externals"][0]["name"], "offline");
  EXPECT_EQ(j["cases"][0]["externals"][0]["seconds"], 90);
  EXPECT_NE(readFile(folder / "out/study.md").find("offline (external)"), std::string::npos);
}

TEST(StudyCommand, refusesWhatItCannotUse) {
  const TemporaryFolder folder;
  const std::pair<std::vector<std::string>, std::string> wrong[] = {
      {command(folder, {"--external", "offline"}), "NAME=picture.exr,SECONDS"},
      {command(folder, {"--external", "offline=gone.exr,9"}), "gone.exr: no such file"},
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

}  // namespace
}  // namespace roomlight
