#include <nlohmann/json.hpp>

#include "batch/durable.h"
#include "unit/batch/small_batch.h"

namespace roomlight::batch {
namespace {

using testing::readFile;
using testing::SmallBatch;
using testing::writeFile;

class BatchPlan : public SmallBatch {
 protected:
  BatchPlan() {
    std::filesystem::create_directories(files_ / "homes");
    for (const char* home : {"homes/a.sh3d", "homes/b.sh3d", "house.sh3d"}) writeFile(files_ / home, home);
    writeFile(files_ / "evening.json", "{\"lamps\": [{\"photometry\": \"spot.ies\"}]}");
    writeFile(files_ / "spot.ies", "spot");
    writeFile(files_ / "walk.json", "{\"seconds\": 2.5, \"framesPerSecond\": 10}");
  }
  Result<Planned> planned(const std::string& toml, const std::string& version = testing::kVersion) {
    writeFile(files_ / "plan.toml", toml);
    return planBatch(files_ / "plan.toml", folder_.path(), version, [](const auto&) { return Ok{}; });
  }
  std::vector<Task> tasks(const std::string& toml) {
    const Result<Planned> done = planned(toml);
    EXPECT_TRUE(done) << done.error();
    std::vector<Task> out;
    if (!done) return out;
    const TaskList all = list();
    for (size_t i = 0; i < all.size(); ++i) {
      Result<Task> task = all.task(i);
      EXPECT_TRUE(task) << task.error();
      out.push_back(std::move(task.value()));
    }
    return out;
  }
};

using Words = std::vector<std::string>;

TEST_F(BatchPlan, PicturesAreTheProductOfTheirAxes) {
  const std::vector<Task> all = tasks(R"(
[[pictures]]
homes = ["homes/*.sh3d", "house.sh3d"]
cameras = ["Kitchen", "Bath"]
lights = ["day", "evening.json"]
techniques = ["hybrid", "path"]
seeds = 2
size = "96x54"
quality = "draft"
options = ["--look", "evening"]
)");
  ASSERT_EQ(all.size(), 3u * 2 * 2 * 2 * 2);
  EXPECT_EQ(all[0].arguments, (Words{"render",  "../homes/a.sh3d", "--camera",  "Kitchen", "--light",
                                     "day",     "--technique",     "hybrid",    "--seed",  "0",
                                     "--size",  "96x54",           "--quality", "draft",   "--look",
                                     "evening", "--reproducible",  "--quiet",   "-o",      "{output}"}));
  EXPECT_EQ(all[0].output, "picture.png");
  EXPECT_EQ(all[0].inputs.size(), 1u);
  EXPECT_EQ(all[1].labels.back(), (std::pair<std::string, std::string>{"seed", "1"}));
  EXPECT_EQ(all[5].arguments[4], "--lighting");
  EXPECT_EQ(all[5].arguments[5], "../evening.json");
}

TEST_F(BatchPlan, InputsAreWhatFilesName) {
  const std::vector<Task> all = tasks("[[pictures]]\nhomes = 'house.sh3d'\nlights = 'evening.json'\n");
  ASSERT_EQ(all.size(), 1u);
  ASSERT_EQ(all[0].inputs.size(), 3u);
  EXPECT_EQ(all[0].inputs[0].file, "../evening.json");
  EXPECT_EQ(all[0].inputs[1].file, "../house.sh3d");
  EXPECT_EQ(all[0].inputs[2].file, "../spot.ies");
  writeFile(files_ / "spot.ies", "another");
  EXPECT_NE(tasks("[[pictures]]\nhomes = 'house.sh3d'\nlights = 'evening.json'\n")[0].id, all[0].id);
}

TEST_F(BatchPlan, CamerasOfOneTaskAreRenderedTogether) {
  const std::vector<Task> all =
      tasks("[[pictures]]\nhomes = 'house.sh3d'\ncameras = ['A', 'B', 'C']\ncamerasPerTask = 2\n");
  ASSERT_EQ(all.size(), 2u);
  EXPECT_EQ(all[0].labels.back().second, "A, B");
  EXPECT_EQ(Words(all[0].arguments.begin() + 2, all[0].arguments.begin() + 6),
            (Words{"--camera", "A", "--camera", "B"}));
  EXPECT_EQ(Words(all[1].arguments.begin() + 2, all[1].arguments.begin() + 4), (Words{"--camera", "C"}));
}

TEST_F(BatchPlan, OptimiseIsCutIntoPartsOfItsResponse) {
  writeFile(files_ / "goals.toml", "catalogue = 'lamps.toml'\n");
  writeFile(files_ / "lamps.toml", "lamps");
  const std::vector<Task> all =
      tasks("[[optimise]]\nhomes = 'homes/*.sh3d'\nstudies = 'goals.toml'\nparts = 3\nquality = 'draft'\n");
  ASSERT_EQ(all.size(), 2u * 3);
  EXPECT_EQ(all[1].arguments, (Words{"optimise", "../homes/a.sh3d", "../goals.toml", "--part", "2/3", "--quality",
                                     "draft", "--quiet", "-o", "{folder}"}));
  EXPECT_EQ(all[0].group, all[2].group);
  EXPECT_NE(all[0].group, all[3].group) << "another home";
  ASSERT_EQ(all[0].inputs.size(), 3u);
  EXPECT_EQ(all[0].inputs[2].file, "../lamps.toml") << "named between single quotes";
}

TEST_F(BatchPlan, AStudyIsCutIntoItsViewsAndWalks) {
  writeFile(files_ / "study.json", R"({"scenes": [
    {"name": "house", "scene": "house.sh3d", "lights": [{"name": "own"}, {"name": "evening", "lighting": "evening.json"}],
     "walk": "walk.json"}]})");
  const std::vector<Task> all = tasks("[[study]]\nstudy = 'study.json'\noptions = ['--runs', '1']\n");
  ASSERT_EQ(all.size(), 3u);
  EXPECT_EQ(all[1].arguments,
            (Words{"study", "../study.json", "--only", "house/evening", "--runs", "1", "--quiet", "-o", "{folder}"}));
  EXPECT_EQ(all[2].arguments[3], "house/walk");
  EXPECT_EQ(all[0].inputs.size(), 5u) << "the study, what it names, and what that names";
}

TEST_F(BatchPlan, SharedLightIsThatOfAllCameras) {
  const std::vector<Task> all = tasks("[[pictures]]\nhomes = 'house.sh3d'\ncameras = ['A', 'B']\nshareLight = true\n");
  ASSERT_EQ(all.size(), 2u);
  EXPECT_EQ(all[0].arguments, (Words{"render", "../house.sh3d", "--camera", "A", "--light-for", "A", "--light-for", "B",
                                     "--reproducible", "--quiet", "-o", "{output}"}));
}

TEST_F(BatchPlan, IdsChangeWithTheVersion) {
  const std::string toml = "[[pictures]]\nhomes = 'house.sh3d'\n";
  const std::string id = tasks(toml)[0].id;
  ASSERT_TRUE(planned(toml, "newer"));
  EXPECT_NE(idAt(list(), 0), id);
}

TEST_F(BatchPlan, SeedsOfAReferenceAreOneGroup) {
  const std::vector<Task> all =
      tasks("[[references]]\nname = 'ref'\nhomes = 'house.sh3d'\ncameras = ['A', 'B']\nseeds = [3, 5]\nsamples = 4\n");
  ASSERT_EQ(all.size(), 4u);
  EXPECT_EQ(all[0].group, "ref house A");
  EXPECT_EQ(all[1].group, all[0].group);
  EXPECT_EQ(all[2].group, "ref house B");
  EXPECT_EQ(all[0].output, "seed.exr");
}

TEST_F(BatchPlan, FramesOfAWalkAreCutInto) {
  const std::vector<Task> all = tasks("[[walks]]\nhomes = 'house.sh3d'\nwalk = 'walk.json'\nframesPerTask = 10\n");
  ASSERT_EQ(all.size(), 3u);
  EXPECT_EQ(all[2].labels.back().second, "20-24");
  EXPECT_EQ(all[2].group, all[0].group);
  EXPECT_EQ(all[0].output, "frame_%06d.png");
}

TEST_F(BatchPlan, MeasureAndLayersAreCommandsToo) {
  const std::vector<Task> all = tasks(
      "[[measure]]\nhomes = 'house.sh3d'\nlights = ['day', 'night']\n[[layers]]\nhomes = 'house.sh3d'\ngroups = "
      "'room'\n");
  ASSERT_EQ(all.size(), 3u);  // in the order of kinds
  EXPECT_EQ(all[0].arguments, (Words{"render", "../house.sh3d", "--layers", "--layer-groups", "room", "--reproducible",
                                     "--quiet", "-o", "{output}"}));
  EXPECT_EQ(all[1].arguments, (Words{"measure", "../house.sh3d", "--light", "day", "--quiet", "--json", "{output}",
                                     "--csv", "{folder}/measure.csv"}));
}

TEST_F(BatchPlan, CommandsTakeEachAndFindTheirFiles) {
  const std::vector<Task> all = tasks(R"(
[[commands]]
arguments = ["info", "homes/{home}.sh3d", "--up", "{axis}"]
output = "info_{home}.txt"
each = {home = ["a", "b"], axis = ["y", "z"]}
)");
  ASSERT_EQ(all.size(), 4u);
  EXPECT_EQ(all[3].arguments, (Words{"info", "../homes/b.sh3d", "--up", "z"}));
  ASSERT_EQ(all[3].inputs.size(), 1u);
  EXPECT_EQ(all[3].inputs[0].file, "../homes/b.sh3d");
  EXPECT_TRUE(printsOutput(all[3]));
}

TEST_F(BatchPlan, TheSameTwiceIsAnError) {
  const Result<Planned> done =
      planned("[[pictures]]\nhomes = 'house.sh3d'\n\n[[pictures]]\nhomes = ['homes/a.sh3d', 'house.sh3d']\n");
  ASSERT_FALSE(done);
  EXPECT_NE(done.error().find("plan.toml:4: pictures: asks twice for home house; line 1 has it already"),
            std::string::npos)
      << done.error();
}

TEST_F(BatchPlan, AnOptionThatIsNotThereIsToldWithItsLine) {
  writeFile(files_ / "plan.toml", "\n[[pictures]]\nhomes = 'house.sh3d'\noptions = ['--loook', 'evening']\n");
  const Result<Planned> done = planBatch(files_ / "plan.toml", folder_.path(), "1", [](const Words& words) {
    return words.size() > 3 ? Status(Error{"unknown option " + words[2]}) : Status(Ok{});
  });
  ASSERT_FALSE(done);
  EXPECT_NE(done.error().find("plan.toml:2: pictures: unknown option --loook"), std::string::npos) << done.error();
  EXPECT_FALSE(std::filesystem::exists(folder_.plan()));
}

TEST_F(BatchPlan, WaitsForTasksThatRun) {
  const std::string toml = "[[pictures]]\nhomes = 'house.sh3d'\n";
  ASSERT_TRUE(planned(toml));
  Claims claims(folder_);
  ASSERT_TRUE(claims.take(idAt(list(), 0)).value());
  EXPECT_NE(planned(toml).error().find("are being run"), std::string::npos);
}

TEST_F(BatchPlan, ManyTasksAreWrittenAsTheyCome) {
  const std::vector<Task> some = tasks("[[pictures]]\nhomes = 'house.sh3d'\nseeds = 20000\n");
  ASSERT_EQ(some.size(), 20000u);
  EXPECT_EQ(some.back().labels.back().second, "19999");
}

}  // namespace
}  // namespace roomlight::batch
