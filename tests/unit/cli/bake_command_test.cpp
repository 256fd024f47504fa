// `roomlight bake` from outside.
#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "unit/cli/program.h"

namespace roomlight {
namespace {

using testing::ProgramRun;
using testing::readFile;
using testing::runProgram;
using testing::TemporaryFolder;

TEST(BakeCommand, writesTheHomeThatOtherCommandsOpen) {
  const TemporaryFolder folder;
  const ProgramRun run = runProgram({"bake", testing::writeRoom(folder), "--quality", "draft", "-o",
                                     folder / "home.glb", "--stats", folder / "s.json"});
  ASSERT_EQ(run.exitStatus, 0) << run.err;
  const auto stats = nlohmann::json::parse(readFile(folder / "s.json"));
  EXPECT_EQ(stats["layers"], 1);
  EXPECT_EQ(stats["bytes"], std::filesystem::file_size(folder / "home.glb"));
  EXPECT_GT(stats["places"].get<int>(), 500);
  EXPECT_EQ(stats["cameras"][0]["name"], "Front");
  const ProgramRun info = runProgram({"info", folder / "home.glb"});
  EXPECT_EQ(info.exitStatus, 0) << info.err;
}

bool pageIsBuilt() { return std::filesystem::exists(ROOMLIGHT_SOURCE_DIR "/viewer/dist-baked/index.html"); }

TEST(BakeCommand, aPageHoldsTheHome) {
  if (!pageIsBuilt()) GTEST_SKIP() << "the page is not built";
  const TemporaryFolder folder;
  const ProgramRun run =
      runProgram({"bake", testing::writeRoom(folder), "--quality", "draft", "-o", folder / "home.html"});
  ASSERT_EQ(run.exitStatus, 0) << run.err;
  const std::string page = readFile(folder / "home.html");
  EXPECT_NE(page.find("id=\"roomlight-home\" data-bytes=\""), std::string::npos);
  EXPECT_EQ(page.find("<!--roomlight-home-->"), std::string::npos);
}

TEST(BakeCommand, aFolderHoldsTheNewestHomeAlone) {
  if (!pageIsBuilt()) GTEST_SKIP() << "the page is not built";
  const TemporaryFolder folder;
  const std::filesystem::path web = folder / "web";
  std::filesystem::create_directory(web);
  testing::writeFile(web / "home-plan.glb", "of somebody else");
  std::string first;
  for (const char* hours : {"9", "15"}) {
    const ProgramRun run = runProgram(
        {"bake", testing::writeRoom(folder), "--light", "day", "--hours", hours, "--quality", "draft", "-o", web});
    ASSERT_EQ(run.exitStatus, 0) << run.err;
    std::vector<std::string> homes;
    for (const auto& entry : std::filesystem::directory_iterator(web)) {
      const std::string name = entry.path().filename().string();
      if (name.ends_with(".glb") && name != "home-plan.glb") homes.push_back(name);
    }
    ASSERT_EQ(homes.size(), 1u);
    EXPECT_NE(homes[0], first);
    EXPECT_NE(readFile(web / "index.html").find("href=\"" + homes[0] + "\""), std::string::npos);
    first = homes[0];
  }
  EXPECT_TRUE(std::filesystem::exists(web / "home-plan.glb"));
}

TEST(BakeCommand, daylightAtTheHourAskedFor) {
  const TemporaryFolder folder;
  const ProgramRun run =
      runProgram({"bake", testing::writeRoom(folder), "--light", "day", "--hours", "9,9", "--quality", "draft", "-o",
                  folder / "home.glb", "--stats", folder / "s.json", "--quiet"});
  ASSERT_EQ(run.exitStatus, 0) << run.err;
  // The room is closed: no daylight comes in, and a sun that gives nothing is left out; the sky tells the hour.
  EXPECT_EQ(nlohmann::json::parse(readFile(folder / "s.json"))["layers"], 2);
  EXPECT_NE(readFile(folder / "home.glb").find("\"hour\":9.0"), std::string::npos);
}

TEST(BakeCommand, wrongWordsAreOneLineBeforeAnyWork) {
  const TemporaryFolder folder;
  const std::string room = testing::writeRoom(folder).string();
  testing::writeFile(folder / "afile", "in the way");
  const std::pair<std::vector<std::string>, std::string> faults[] = {
      {{"bake", room, "-o", folder / "home.png"}, "unknown kind of file; use .html, .glb or the name of a folder"},
      {{"bake", room, "-o", folder / "home.glb", "--hours", "9,25"}, "--hours 9,25: an hour is from 0 to 24"},
      {{"bake", room, "-o", folder / "home.glb", "--quality", "perfect"}, "--quality"},
      {{"bake", room, "-o", folder / "none/home.glb"}, "none"},
      {{"bake", room, "-o", folder / "room.bin"}, "unknown kind of file"},
      {{"bake", room, "-o", folder / "afile"}, "afile"},
      {{"bake", folder / "missing.glb", "-o", folder / "home.glb"}, "missing.glb"},
  };
  for (const auto& [words, part] : faults) {
    const ProgramRun run = runProgram(words);
    EXPECT_NE(run.exitStatus, 0);
    EXPECT_NE(run.err.find(part), std::string::npos) << run.err;
    EXPECT_EQ(std::count(run.err.begin(), run.err.end(), '\n'), 1) << run.err;
  }
  EXPECT_FALSE(std::filesystem::exists(folder / "home.glb"));
}

TEST(BakeCommand, roomsByNameAndABudget) {
  const TemporaryFolder folder;
  const std::string room = testing::writeRoom(folder).string();
  const std::pair<std::vector<std::string>, std::string> faults[] = {
      {{"--rooms", "Attic"}, "--rooms: no room 'Attic'"},
      {{"--budget", "20"}, "--budget 20: write a size such as 20MB"},
      {{"--budget", "-1MB"}, "--budget -1MB"},
  };
  for (const auto& [words, part] : faults) {
    std::vector<std::string> all{"bake", room, "-o", folder / "home.glb", "--quality", "draft"};
    all.insert(all.end(), words.begin(), words.end());
    const ProgramRun run = runProgram(all);
    EXPECT_NE(run.exitStatus, 0);
    EXPECT_NE(run.err.find(part), std::string::npos) << run.err;
  }
  const ProgramRun tight =
      runProgram({"bake", room, "-o", folder / "home.glb", "--quality", "draft", "--budget", "0.001MB"});
  EXPECT_EQ(tight.exitStatus, 0) << tight.err;
  EXPECT_NE(tight.err.find("above the budget of 0.0 MB"), std::string::npos) << tight.err;
}

TEST(BakeCommand, goesOnWhereItWasInterrupted) {
  const TemporaryFolder folder;
  const std::string room = testing::writeRoom(folder).string();
  const std::vector<std::string> words{"bake", room, "--quality", "draft", "--light", "day", "-o", folder / "home.glb"};
  const ProgramRun first = runProgram(words, "lamps");
  ASSERT_EQ(first.exitStatus, 130) << first.err;
  EXPECT_NE(first.err.find("home.glb.light"), std::string::npos) << first.err;
  EXPECT_TRUE(std::filesystem::exists(folder / "home.glb.light"));
  const ProgramRun second = runProgram(words);
  ASSERT_EQ(second.exitStatus, 0) << second.err;
  EXPECT_FALSE(std::filesystem::exists(folder / "home.glb.light")) << "what was kept is not needed any more";
}

TEST(BakeCommand, interruptedItWritesNothing) {
  const TemporaryFolder folder;
  const ProgramRun run =
      runProgram({"bake", testing::writeRoom(folder), "--quality", "best", "-o", folder / "home.glb"}, "charts");
  EXPECT_EQ(run.exitStatus, 130) << run.err;
  EXPECT_NE(run.err.find("nothing was written"), std::string::npos) << run.err;
  EXPECT_FALSE(std::filesystem::exists(folder / "home.glb"));
}

}  // namespace
}  // namespace roomlight
