// `roomlight batch` from outside: a plan of real renders, run, told of and merged.
#include <gtest/gtest.h>
#include <signal.h>

#include <algorithm>
#include <cstdlib>
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

constexpr const char* kPlan = R"(
name = "room"

[[pictures]]
homes = "room.gltf"
cameras = ["Front", "Back"]
size = "32x18"
quality = "draft"

[[references]]
homes = "room.gltf"
cameras = "Front"
seeds = 3
samples = 2
size = "32x18"

[[commands]]
arguments = ["info", "{home}.gltf"]
output = "info.txt"
each = {home = ["room"]}
)";

class BatchCommand : public ::testing::Test {
 protected:
  BatchCommand() {
    testing::writeRoom(files_);
    writeFile(files_ / "plan.toml", kPlan);
  }
  ProgramRun batch(std::vector<std::string> words) const {
    words.insert(words.begin(), "batch");
    return runProgram(words);
  }
  void planned() const {
    const ProgramRun run = batch({"plan", files_ / "plan.toml", "-o", folder_});
    ASSERT_EQ(run.exitStatus, 0) << run.err;
    EXPECT_NE(run.out.find("6 tasks planned"), std::string::npos) << run.out;
  }
  nlohmann::json status() const { return nlohmann::json::parse(batch({"status", folder_, "--json"}).out); }
  // All output files by name, with their bytes.
  std::map<std::string, std::string> outputs(const std::string& folder) const {
    std::map<std::string, std::string> out;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(std::filesystem::path(folder) / "out")) {
      if (entry.is_regular_file()) out[entry.path().lexically_relative(folder).string()] = readFile(entry.path());
    }
    return out;
  }

  TemporaryFolder files_;
  const std::string folder_ = files_ / "batch";
};

TEST_F(BatchCommand, PlansRunsTellsAndMerges) {
  planned();
  EXPECT_EQ(status()["waiting"], 6);
  const ProgramRun one = batch({"run", folder_, "--index", "1"});
  ASSERT_EQ(one.exitStatus, 0) << one.err;
  EXPECT_EQ(status()["done"], 1);
  const ProgramRun all = batch({"run", folder_, "--all", "--jobs", "2"});
  ASSERT_EQ(all.exitStatus, 0) << all.err;
  EXPECT_NE(all.out.find("6 tasks: 5 done now, 1 before, 0 failed"), std::string::npos) << all.out;
  const nlohmann::json done = status();
  EXPECT_EQ(done["done"], 6);
  EXPECT_EQ(done["running"], 0);
  const ProgramRun merged = batch({"merge", folder_});
  ASSERT_EQ(merged.exitStatus, 0) << merged.err;
  EXPECT_NE(merged.out.find("mean of 3 seeds"), std::string::npos) << merged.out;
  for (const char* file : {"index.html", "figures.csv", "sheet_pictures_1_1.jpg", "mean_references_1_room_Front.exr"})
    EXPECT_TRUE(std::filesystem::exists(std::filesystem::path(folder_) / "merged" / file)) << file;
}

TEST_F(BatchCommand, OutputsAreTheSameBytesHoweverTheyAreRun) {
  planned();
  ASSERT_EQ(batch({"run", folder_, "--all"}).exitStatus, 0);
  const std::string other = files_ / "other";
  ASSERT_EQ(batch({"plan", files_ / "plan.toml", "-o", other}).exitStatus, 0);
  ASSERT_EQ(batch({"run", other, "--all", "--jobs", "2"}).exitStatus, 0);
  EXPECT_EQ(outputs(folder_).size(), 6u);
  EXPECT_EQ(outputs(folder_), outputs(other));
}

TEST_F(BatchCommand, ArrayJobsTellTheIndex) {
  planned();
  setenv("JOB_COMPLETION_INDEX", "2", 1);
  const ProgramRun run = batch({"run", folder_, "--chunk", "2"});
  unsetenv("JOB_COMPLETION_INDEX");
  ASSERT_EQ(run.exitStatus, 0) << run.err;
  EXPECT_NE(run.out.find("2 tasks: 2 done now"), std::string::npos) << run.out;
  const ProgramRun none = batch({"run", folder_});
  EXPECT_EQ(none.exitStatus, 2);
  EXPECT_NE(none.err.find("say which tasks"), std::string::npos) << none.err;
}

TEST_F(BatchCommand, FailuresHaveTheirLine) {
  writeFile(files_ / "plan.toml", "[[pictures]]\nhomes = 'room.gltf'\ncameras = 'Attic'\n");
  ASSERT_EQ(batch({"plan", files_ / "plan.toml", "-o", folder_}).exitStatus, 0);
  const ProgramRun run = batch({"run", folder_, "--all"});
  EXPECT_EQ(run.exitStatus, 1);
  const ProgramRun told = batch({"status", folder_});
  EXPECT_NE(told.out.find("Attic"), std::string::npos) << told.out;
  EXPECT_NE(told.out.find("1 failed"), std::string::npos) << told.out;
}

TEST_F(BatchCommand, WrongOptionsOfATaskAreToldBeforeItRuns) {
  writeFile(files_ / "plan.toml", "\n[[pictures]]\nhomes = 'room.gltf'\noptions = ['--lok', 'evening']\n");
  const ProgramRun run = batch({"plan", files_ / "plan.toml", "-o", folder_});
  EXPECT_EQ(run.exitStatus, 2);
  EXPECT_NE(run.err.find("plan.toml:2: pictures: unknown option '--lok' of render; did you mean --look?"),
            std::string::npos)
      << run.err;
}

TEST_F(BatchCommand, SubcommandsAreAnsweredByTheNearest) {
  const ProgramRun run = runProgram({"batch", "stats", folder_});
  EXPECT_EQ(run.exitStatus, 2);
  EXPECT_NE(run.err.find("unknown command 'batch stats'; did you mean status?"), std::string::npos) << run.err;
}

TEST_F(BatchCommand, ADryRunShowsTheScripts) {
  planned();
  const ProgramRun run = batch({"submit", folder_, "--slurm", "--dry-run", "--partition", "day"});
  ASSERT_EQ(run.exitStatus, 0) << run.err;
  EXPECT_NE(run.out.find("#SBATCH --array=0-0"), std::string::npos) << run.out;
  EXPECT_NE(run.out.find("batch merge"), std::string::npos);
}

// A study cut into its views and walks, and put together again, has the pages of one that was not.
TEST_F(BatchCommand, AStudyIsMeasuredViewByView) {
  writeFile(files_ / "study.json", R"({"scenes": [{"name": "Room", "scene": "room.gltf", "camera": "Front",
    "lights": [{"name": "own"}, {"name": "dim", "dimLamp": "150 lm"}]}]})");
  writeFile(files_ / "plan.toml",
            "[[study]]\nname = 'rooms'\nstudy = 'study.json'\noptions = ['--technique', 'cone', '--size', '32x18', "
            "'--runs', '1', '--most-seconds', '0.1', '--reference-seconds', '1']\n");
  ASSERT_EQ(batch({"plan", files_ / "plan.toml", "-o", folder_}).exitStatus, 0);
  const ProgramRun one = batch({"run", folder_, "--index", "1"});
  ASSERT_EQ(one.exitStatus, 0) << one.err;
  ProgramRun merged = batch({"merge", folder_});
  ASSERT_EQ(merged.exitStatus, 0) << merged.err;
  const auto cases = [&] { return nlohmann::json::parse(readFile(folder_ + "/merged/rooms/study.json"))["cases"]; };
  ASSERT_EQ(cases().size(), 1u) << "what is not done is left out";
  EXPECT_EQ(cases()[0]["light"], "dim");
  ASSERT_EQ(batch({"run", folder_, "--all"}).exitStatus, 0);
  merged = batch({"merge", folder_});
  ASSERT_EQ(merged.exitStatus, 0) << merged.err;
  ASSERT_EQ(cases().size(), 2u);
  for (const auto& view : cases()) EXPECT_FALSE(view["curves"][0]["points"].empty()) << view;
  EXPECT_NE(readFile(folder_ + "/merged/index.html").find("rooms/study.html"), std::string::npos);
}

TEST_F(BatchCommand, AResponseIsFoundInPartsAndOptimiseGoesOn) {
  writeFile(files_ / "catalogue.toml",
            "[[luminaire]]\nname = 'Bulb'\ntype = 'point'\nflux = '800 lm'\nwatts = 8\nprice = 20\n"
            "mounting = ['ceiling']\ndrop = 0.3\n");
  writeFile(files_ / "goals.toml", "catalogue = 'catalogue.toml'\n" + std::string(testing::kHallZone) +
                                       "spacing = 1\n" + testing::kHallPlaces);
  writeFile(files_ / "plan.toml",
            "[[optimise]]\nname = 'lamps'\nhomes = 'room.gltf'\nstudies = 'goals.toml'\nparts = 2\n"
            "quality = 'draft'\n");
  ASSERT_EQ(batch({"plan", files_ / "plan.toml", "-o", folder_}).exitStatus, 0);
  ASSERT_EQ(batch({"run", folder_, "--index", "0"}).exitStatus, 0);
  ProgramRun merged = batch({"merge", folder_});
  EXPECT_NE(merged.err.find("parts of the response are there"), std::string::npos) << merged.err;
  ASSERT_EQ(batch({"run", folder_, "--all"}).exitStatus, 0);
  merged = batch({"merge", folder_});
  ASSERT_EQ(merged.exitStatus, 0) << merged.err;
  EXPECT_NE(merged.err.find("roomlight optimise ../room.gltf ../goals.toml"), std::string::npos) << merged.err;
  const auto folder = std::filesystem::path(folder_) / "merged" / "lamps_room_goals";
  const std::string response = readFile(folder / "response.bin");
  ASSERT_FALSE(response.empty());
  const ProgramRun on = runProgram({"optimise", files_ / "room.gltf", files_ / "goals.toml", "--quality", "draft",
                                    "--evaluations", "200", "--certify", "0", "-o", folder});
  ASSERT_EQ(on.exitStatus, 0) << on.err;
  EXPECT_NE(on.err.find("is known from before"), std::string::npos) << on.err;
  EXPECT_EQ(readFile(folder / "response.bin"), response);
}

}  // namespace
}  // namespace roomlight
