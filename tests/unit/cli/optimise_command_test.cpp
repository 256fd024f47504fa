// `roomlight optimise` from outside: what it writes, and when it goes on.
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "base/write_file.h"
#include "unit/cli/program.h"

namespace roomlight {
namespace {

using testing::ProgramRun;
using testing::readFile;
using testing::runProgram;
using testing::TemporaryFolder;
using testing::writeFile;

constexpr const char* kCatalogue = R"(
[[luminaire]]
name = "Bulb"
type = "point"
flux = "800 lm"
watts = 8
price = 20
mounting = ["ceiling"]
drop = 0.3
)";

// The room of writeRoom(), with four places.
const std::string kStudy = std::string(R"(
catalogue = "catalogue.toml"
)") + testing::kHallZone + "spacing = 1\n" +
                           testing::kHallPlaces + R"([search]
evaluations = 600
population = 20
certify = 0
)";

class OptimiseCommand : public ::testing::Test {
 protected:
  OptimiseCommand() {
    writeFile(files_ / "catalogue.toml", kCatalogue);
    writeFile(files_ / "study.toml", kStudy);
  }
  ProgramRun optimise(const std::string& folder, std::vector<std::string> more = {},
                      const std::string& interruptAt = "") const {
    std::vector<std::string> arguments = {"optimise",  room_,  files_ / "study.toml", "-o", files_ / folder,
                                          "--quality", "draft"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return runProgram(arguments, interruptAt);
  }
  std::string written(const std::string& file) const { return readFile(files_ / file); }

  TemporaryFolder files_;
  const std::string room_ = testing::writeRoom(files_).string();
};

TEST_F(OptimiseCommand, WritesThePageTheFrontAndLightingFilesThatCanBeRendered) {
  std::filesystem::create_directories(files_ / "out");
  writeFile(files_ / "out/design_99.json", "{}");
  writeFile(files_ / "out/design_notes.json", "{}");
  const ProgramRun run = optimise("out", {"--baseline", "random"});
  ASSERT_EQ(run.exitStatus, 0) << run.err;
  EXPECT_NE(run.out.find("design 1"), std::string::npos) << run.out;
  const std::string html = written("out/index.html");
  for (const char* part : {"<!doctype html>", "data-plot=\"front\"", "Design 1", "predicted", "</html>"})
    EXPECT_NE(html.find(part), std::string::npos) << part;
  const auto json = nlohmann::json::parse(written("out/run.json"));
  EXPECT_EQ(json["methods"].size(), 2u);
  EXPECT_GT(json["methods"][0]["hypervolume"].get<double>(), 0);
  EXPECT_EQ(json["candidates"], 4);
  EXPECT_GT(written("out/front.csv").size(), 200u);
  // What an earlier run left is gone, what is the user's is not.
  EXPECT_FALSE(std::filesystem::exists(files_ / "out/design_99.json"));
  EXPECT_TRUE(std::filesystem::exists(files_ / "out/design_notes.json"));
  const ProgramRun picture = runProgram({"render", room_, "--lighting", files_ / "out/design_1.json", "--size", "32x18",
                                         "--quality", "draft", "-o", files_ / "a.png"});
  EXPECT_EQ(picture.exitStatus, 0) << picture.err;
}

TEST_F(OptimiseCommand, TheSameSeedGivesTheSameFrontAlsoInAFolderThatHasGoneFurther) {
  ASSERT_EQ(optimise("a", {"--seed", "7"}).exitStatus, 0);
  ASSERT_EQ(optimise("b", {"--seed", "7", "--evaluations", "1500"}).exitStatus, 0);
  const std::string front = written("a/front.csv");
  const std::string further = written("b/front.csv");
  EXPECT_NE(further, front);
  ASSERT_EQ(optimise("b", {"--seed", "7"}).exitStatus, 0);
  EXPECT_EQ(written("b/front.csv"), front);
  ASSERT_EQ(optimise("a", {"--seed", "7", "--evaluations", "1500"}).exitStatus, 0);
  EXPECT_EQ(written("a/front.csv"), further);
}

TEST_F(OptimiseCommand, StoppedAmidTheSearchItWritesTheFrontThereIs) {
  const ProgramRun run = optimise("out", {"--evaluations", "1000000000"}, "on the front");
  EXPECT_EQ(run.exitStatus, 130) << run.err;
  EXPECT_NE(written("out/index.html").find("</html>"), std::string::npos);
  const std::string front = written("out/front.csv");
  EXPECT_GT(std::count(front.begin(), front.end(), '\n'), 1);
}

TEST_F(OptimiseCommand, SaysWhyThereIsNoLamp) {
  writeFile(files_ / "study.toml", "limits = { cost = 5 }\n" + std::string(kStudy));
  const ProgramRun run = optimise("out", {"--quiet"});
  EXPECT_EQ(run.exitStatus, 0) << run.err;
  EXPECT_NE(run.err.find("no design has a lamp"), std::string::npos) << run.err;
}

TEST_F(OptimiseCommand, WhatIsWrongIsOneLineAndExitStatusTwo) {
  writeFile(files_ / "number.json", R"({"scene": 3})");
  writeFile(files_ / "object.json", R"({"lamps": {}})");
  const std::pair<std::string, const char*> cases[] = {
      {"lighting = \"number.json\"\n" + std::string(kStudy), "number.json: scene: must be an object"},
      {"lighting = \"object.json\"\n" + std::string(kStudy), "object.json: lamps: must be a list"},
      {std::string(kStudy) + "[[condition]]\nname = \"day\"\ndaylight = { sky = \"green\" }\n",
       "study.toml:22: condition 'day': daylight"},
      {std::string(kStudy) + "[[condition]]\nname = \"day\"\ndaylight = \"none\"\nweight = 0\n",
       "study.toml:22: condition[0]: all have weight 0"},
      {std::string(kStudy) + "colour = 3\n", "study.toml:22: search: unknown key 'colour'"},
  };
  for (const auto& [study, says] : cases) {
    writeFile(files_ / "study.toml", study);
    const ProgramRun run = optimise("out", {"--quiet"});
    EXPECT_EQ(run.exitStatus, 2) << says;
    EXPECT_NE(run.err.find(says), std::string::npos) << run.err;
    EXPECT_EQ(std::count(run.err.begin(), run.err.end(), '\n'), 1) << run.err;
    EXPECT_FALSE(std::filesystem::exists(files_ / "out")) << "made for results that there are none of";
  }
  // A folder that was there before stays.
  std::filesystem::create_directories(files_ / "out");
  EXPECT_EQ(optimise("out", {"--quiet"}).exitStatus, 2);
  EXPECT_TRUE(std::filesystem::exists(files_ / "out"));
}

TEST_F(OptimiseCommand, TheResponseIsTakenFromTheFolderUnlessItIsDamagedOrAnInputHasChanged) {
  const std::string known = "known from before", damaged = "response.bin: is damaged";
  const auto errOf = [&](const ProgramRun& run) {
    EXPECT_EQ(run.exitStatus, 0) << run.err;
    return run.err;
  };
  EXPECT_EQ(errOf(optimise("out")).find(known), std::string::npos);
  const std::string front = written("out/front.csv");
  EXPECT_NE(errOf(optimise("out")).find(known), std::string::npos);
  std::string bytes = written("out/response.bin");
  bytes[bytes.size() / 2] = static_cast<char>(bytes[bytes.size() / 2] ^ 4);
  writeFile(files_ / "out/response.bin", bytes);
  const std::string again = errOf(optimise("out"));
  EXPECT_EQ(again.find(known), std::string::npos) << again;
  EXPECT_NE(again.find(damaged), std::string::npos) << again;
  EXPECT_EQ(written("out/front.csv"), front);
  EXPECT_EQ(errOf(optimise("out", {"--metres-per-unit", "1.01"})).find(known), std::string::npos);
}

TEST_F(OptimiseCommand, OneRunAtATimeWritesIntoAFolder) {
  const Result<HeldFolder> other = holdFolder(files_ / "out");
  ASSERT_TRUE(other && other.value());
  const ProgramRun run = optimise("out", {"--quiet"});
  EXPECT_EQ(run.exitStatus, 1);
  EXPECT_NE(run.err.find("out: is in use by another run of optimise"), std::string::npos) << run.err;
  EXPECT_EQ(std::count(run.err.begin(), run.err.end(), '\n'), 1) << run.err;
}

}  // namespace
}  // namespace roomlight
