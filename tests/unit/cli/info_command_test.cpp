// `roomlight info` from outside.
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <numbers>

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
  ASSERT_EQ(json["cameras"].size(), 5u);  // two of the file, Room 1, Outside and Plan
  EXPECT_FALSE(json["cameras"][1]["proposed"].get<bool>());
  EXPECT_EQ(json["cameras"][2]["name"], "Room 1");
  EXPECT_TRUE(json["cameras"][2]["proposed"].get<bool>());
  ASSERT_EQ(json["rooms"].size(), 1u);
  EXPECT_NEAR(json["rooms"][0]["heightM"].get<double>(), 3, 0.01);
  EXPECT_NEAR(json["boundsM"]["high"][1].get<double>(), 3, 1e-5);
}

// Lamps of homes are often meshes: what people switch is told whatever it is made of.
TEST(InfoCommand, lightsAreLampsAndShiningMeshes) {
  const TemporaryFolder folder;
  const auto json = nlohmann::json::parse(runProgram({"info", testing::writeRoom(folder), "--json"}).out);
  ASSERT_EQ(json["lights"].size(), 1u);
  EXPECT_EQ(json["lights"][0]["kind"], "lamp");
  EXPECT_NEAR(json["lights"][0]["fluxLm"].get<double>(), 200 * 4 * std::numbers::pi, 1);
  testing::writeFile(folder / "a.mtl", "newmtl bulb\nKd 0 0 0\nKe 100 100 100\n");
  testing::writeFile(folder / "a.obj", "mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\no Globe\nusemtl bulb\nf 1 2 3\n");
  const ProgramRun run = runProgram({"info", folder / "a.obj"});
  EXPECT_NE(run.out.find("mesh 'Globe'"), std::string::npos) << run.out;
}

TEST(InfoCommand, tableNamesCamerasAndLamps) {
  const TemporaryFolder folder;
  const ProgramRun run = runProgram({"info", testing::writeRoom(folder)});
  ASSERT_EQ(run.exitStatus, 0) << run.err;
  for (const char* word : {"triangles", "Front", "Back", "Bulb", "200 cd", "4.00 x 3.00 x 4.00 m"}) {
    EXPECT_NE(run.out.find(word), std::string::npos) << word << "\n" << run.out;
  }
}

TEST(InfoCommand, aPhotometricFileIsShown) {
  const TemporaryFolder folder;
  testing::writeFile(
      folder / "even.ies",
      "IESNA:LM-63-2002\n[LUMINAIRE] globe\nTILT=NONE\n1 1000 1 2 1 1 2 -0.3 -0.3 0 1 1 9\n0 180\n0\n100 100\n");
  const ProgramRun run = runProgram({"info", folder / "even.ies"});
  ASSERT_EQ(run.exitStatus, 0) << run.err;
  for (const char* word : {"'globe'", "1256.64 lm", "100 cd", "0.3 m along C0", "round", "LM-63-2002, type C"})
    EXPECT_NE(run.out.find(word), std::string::npos) << word << "\n" << run.out;
  EXPECT_NE(run.err.find("even.ies: the intensities add up to 1256.64 lm, 126 % of the 1000 lm stated for its lamps"),
            std::string::npos)
      << run.err;
  const auto json = nlohmann::json::parse(runProgram({"info", folder / "even.ies", "--json"}).out);
  EXPECT_NEAR(json["fileFluxLm"].get<double>(), 1256.637, 0.01);
  testing::writeFile(folder / "cut.ies", "IESNA91\nTILT=NONE\n1 1000\n");
  const ProgramRun bad = runProgram({"info", folder / "cut.ies"});
  EXPECT_EQ(bad.exitStatus, 2);
  EXPECT_NE(bad.err.find("cut.ies: line 3: the file ends before the multiplier"), std::string::npos) << bad.err;
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
