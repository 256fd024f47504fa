// `roomlight info` from outside.
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "unit/cli/program.h"

namespace roomlight {
namespace {

using testing::ProgramRun;
using testing::runProgram;
using testing::TemporaryFolder;

TEST(InfoCommand, jsonSaysWhatTheSceneHolds) {
  const TemporaryFolder folder;
  const ProgramRun run = runProgram({"info", testing::writeRoom(folder), "--json"});
  ASSERT_EQ(run.exitStatus, 0) << run.err;
  const auto json = nlohmann::json::parse(run.out);
  EXPECT_EQ(json["triangles"], 24);
  EXPECT_EQ(json["meshes"], 1);
  EXPECT_EQ(json["instances"], 2);
  EXPECT_EQ(json["materials"].is_array() ? json["materials"].size() : json["materials"].get<size_t>(), 1u);
  ASSERT_EQ(json["lamps"].size(), 1u);
  EXPECT_NEAR(json["lamps"][0]["intensityCd"].get<double>(), 200, 1e-3);
  EXPECT_EQ(json["cameras"].size(), 2u);
  EXPECT_NEAR(json["boundsM"]["high"][1].get<double>(), 3, 1e-5);
}

TEST(InfoCommand, tableNamesCamerasAndLamps) {
  const TemporaryFolder folder;
  const ProgramRun run = runProgram({"info", testing::writeRoom(folder)});
  ASSERT_EQ(run.exitStatus, 0) << run.err;
  for (const char* word : {"triangles", "Front", "Back", "Bulb", "200 cd", "4.00 x 3.00 x 4.00 m"}) {
    EXPECT_NE(run.out.find(word), std::string::npos) << word << "\n"
                                                     << run.out;
  }
}

TEST(InfoCommand, damagedFileIsOneLineAndExitStatusTwo) {
  const TemporaryFolder folder;
  testing::writeFile(folder / "a.glb", "glTF\x02");
  const ProgramRun run = runProgram({"info", folder / "a.glb"});
  EXPECT_EQ(run.exitStatus, 2);
  EXPECT_EQ(std::count(run.err.begin(), run.err.end(), '\n'), 1) << run.err;
  EXPECT_NE(run.err.find("a.glb"), std::string::npos) << run.err;
}

}  // namespace
}  // namespace roomlight
