// `roomlight doctor`, and what it and packages are told of the program.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <nlohmann/json.hpp>

#include "unit/cli/program.h"

namespace roomlight {
namespace {

using testing::ProgramRun;
using testing::runProgram;
using testing::TemporaryFolder;
using Json = nlohmann::json;

// PATH while it lives.
class SearchPath {
 public:
  explicit SearchPath(const std::filesystem::path& folder) : before_(std::getenv("PATH")) {
    setenv("PATH", folder.c_str(), 1);
  }
  ~SearchPath() { setenv("PATH", before_.c_str(), 1); }

 private:
  std::string before_;
};

Json findingOf(const Json& report, const std::string& name) {
  for (const Json& f : report["findings"]) {
    if (f["name"] == name) return f;
  }
  return {};
}

TEST(DoctorCommand, saysWhatIsThereAndWhatIsMissingForWhat) {
  const TemporaryFolder folder;
  testing::writeFile(folder / "ffmpeg", "#!/bin/sh\n");
  std::filesystem::permissions(folder / "ffmpeg", std::filesystem::perms::owner_all);
  testing::writeFile(folder / "blender", "not executable");
  const SearchPath path(folder.path());
  const ProgramRun run = runProgram({"doctor", "--quick", "--json"});
  ASSERT_EQ(run.exitStatus, 0) << run.err;
  const Json json = Json::parse(run.out);
  EXPECT_EQ(findingOf(json, "ffmpeg")["place"], (folder / "ffmpeg").string());
  EXPECT_TRUE(findingOf(json, "blender").is_null());
  EXPECT_TRUE(findingOf(json, "Blender")["place"].is_null());
  EXPECT_NE(findingOf(json, "Blender")["without"].get<std::string>().find(".blend"), std::string::npos);
  EXPECT_FALSE(findingOf(json, "model reader")["place"].is_null());
  EXPECT_GE(json["cores"].get<int>(), 1);
  EXPECT_GT(json["memoryGiB"].get<double>(), json["availableGiB"].get<double>() * 0.5);
  EXPECT_NE(std::string("3. 4.").find(json["embree"].get<std::string>().substr(0, 2)), std::string::npos);
  EXPECT_FALSE(json["builtFor"].get<std::string>().empty());
  EXPECT_FALSE(json.contains("selfTest"));
}

TEST(DoctorCommand, textHasALineForEachThingMissing) {
  const TemporaryFolder folder;
  const SearchPath path(folder.path());
  const ProgramRun run = runProgram({"doctor", "--quick"});
  ASSERT_EQ(run.exitStatus, 0) << run.err;
  for (const char* line : {"\nffmpeg: missing; films of walks stay single pictures\n", "\nSweet Home 3D: missing; ",
                           "\nNode.js: missing; ", "\nEmbree           3.", "\ncores            "})
    EXPECT_NE(run.out.find(line), std::string::npos) << line << run.out;
  EXPECT_EQ(run.out.find("self-test"), std::string::npos);
}

TEST(DoctorCommand, knownPicturesComeOutRight) {
  const ProgramRun run = runProgram({"doctor", "--json"});
  ASSERT_EQ(run.exitStatus, 0) << run.err << run.out;
  const Json tests = Json::parse(run.out)["selfTest"];
  ASSERT_EQ(tests.size(), 2u);
  for (const Json& t : tests) {
    EXPECT_NEAR(t["meanCdM2"].get<double>(), 3.3157, 0.1) << t["technique"];
    EXPECT_GT(t["samplesPerSecond"].get<double>(), 0);
  }
}

TEST(DoctorCommand, aPictureThatIsWrongIsExitStatusOne) {
  const ProgramRun run = runProgram({"doctor", "--tolerance", "0"});
  EXPECT_EQ(run.exitStatus, 1);
  EXPECT_NE(run.out.find("FAILED"), std::string::npos) << run.out;
  EXPECT_NE(run.err.find("a known picture came out wrong"), std::string::npos) << run.err;
}

Json options() { return Json::parse(runProgram({"--options"}).out); }

TEST(Options, listNamesCommandsOptionsAndWhatTheyTake) {
  const Json json = options();
  EXPECT_EQ(json["name"], "roomlight");
  const auto render = std::find_if(json["commands"].begin(), json["commands"].end(),
                                   [](const Json& c) { return c["name"] == "render"; });
  ASSERT_NE(render, json["commands"].end());
  EXPECT_EQ((*render)["arguments"][0]["names"][0], "SCENE");
  EXPECT_TRUE((*render)["arguments"][0]["isRequired"].get<bool>());
  std::map<std::string, Json> byName;
  for (const Json& o : (*render)["options"]) {
    for (const Json& name : o["names"]) byName[name] = o;
  }
  EXPECT_EQ(byName["-o"], byName["--output"]);
  EXPECT_EQ(byName["--output"]["value"], "TEXT");
  EXPECT_TRUE(byName["--quiet"]["value"].is_null());
  EXPECT_EQ(byName["--light"]["default"], "auto");
}

// docs/reference/command-line.md has a section for every command, and names every option.
TEST(Options, allAreDocumented) {
  const std::string page =
      testing::readFile(std::filesystem::path(ROOMLIGHT_SOURCE_DIR) / "docs/reference/command-line.md");
  for (const Json& command : options()["commands"]) {
    const std::string name = command["name"];
    EXPECT_NE(page.find("\n## " + name + "\n"), std::string::npos) << name;
    std::vector<Json> parts(command["commands"].begin(), command["commands"].end());
    parts.push_back(command);
    for (const Json& part : parts) {
      for (const Json& option : part["options"]) {
        const std::string word = option["names"].back();
        EXPECT_NE(page.find(word), std::string::npos) << name << " " << word;
      }
    }
  }
}

}  // namespace
}  // namespace roomlight
