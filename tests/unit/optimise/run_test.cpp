// A run step by step: what it keeps in its folder, what it takes from there, and what is left of one that was stopped.
#include "optimise/run.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "base/write_file.h"
#include "support/room_file.h"
#include "unit/optimise/small_study.h"

namespace roomlight::optimise {
namespace {

using testing::readFile;
using testing::writeFile;

const std::string kGoals = std::string(R"(
catalogue = "catalogue.toml"
objectives = ["targetMiss", "uniformity", "cost"]
cameras = ["Front"]
)") + testing::kHallZone + "spacing = 1.5\n" +
                           testing::kHallPlaces + R"([search]
evaluations = 600
population = 20
certify = 2
)";

class RunInAFolder : public ::testing::Test {
 protected:
  RunInAFolder() {
    testing::writeRoom(files_);
    writeFile(files_ / "catalogue.toml", testing::kCatalogue);
    writeFile(files_ / "study.toml", kGoals);
    wish_.home = files_ / "room.gltf", wish_.study = files_ / "study.toml", wish_.folder = files_ / "out";
    wish_.metresPerUnit = 1.0f, wish_.stop = &stop_;
    wish_.render.voxel.voxelSizeM = 0.5f, wish_.render.radiance.links = 4, wish_.render.radiance.directSamples = 4;
    std::filesystem::create_directories(wish_.folder);
  }

  RunNews news() {
    return {
        [this](const std::string& line) {
          lines_.push_back(line);
          if (line.find(stopAt_) != std::string::npos) stop_ = !stopAt_.empty();
        },
        [this](const std::string& warning) { warnings_.push_back(warning); },
        [this](const char*, const search::State& s, double, bool) { stop_ = stop_ || s.evaluations >= stopAfter_; }};
  }
  // Home and response. True: the response was found by an earlier run.
  bool responds(optimise::Run& run) {
    lines_.clear();
    const Status read = run.read(), responded = read ? run.respond(stages_) : read;
    EXPECT_TRUE(responded) << responded.error();
    return std::any_of(lines_.begin(), lines_.end(),
                       [](const std::string& l) { return l.find("known from before") != std::string::npos; });
  }
  bool responds() {
    optimise::Run run(wish_, news());
    return responds(run);
  }
  bool isKept(const std::string& name) const { return std::filesystem::exists(wish_.folder / name); }
  bool folderIsEmpty() const { return std::filesystem::is_empty(wish_.folder); }
  static std::vector<double> frontOf(const optimise::Run& run) {
    std::vector<double> all;
    for (size_t i = 0; i < run.report().front.size(); ++i) {
      const auto of = run.report().front.objectivesOf(i);
      all.insert(all.end(), of.begin(), of.end());
    }
    return all;
  }

  testing::TemporaryFolder files_;
  RunWish wish_;
  std::atomic<bool> stop_{false};
  std::string stopAt_;             // once a line has it
  size_t stopAfter_ = SIZE_MAX;    // evaluations
  std::string cancelIn_;           // a stage
  std::vector<std::string> lines_, warnings_;
  RenderProgress progress_{
      [this](const std::string& stage, float) { stop_ = stop_ || stage == cancelIn_; }, &stop_, {}};
  RenderStats stats_;
  Stages stages_{progress_, stats_};
};

TEST_F(RunInAFolder, AResponseServesOtherSearchesAndNoOtherInputs) {
  EXPECT_FALSE(responds());
  wish_.seed = 9, wish_.evaluations = 1000, wish_.certified = 0;
  EXPECT_TRUE(responds());
  wish_.render.radiance.links = 5;
  EXPECT_FALSE(responds()) << "light is found in another way";
  EXPECT_TRUE(responds());
  writeFile(files_ / "catalogue.toml", testing::replaced(testing::kCatalogue, "800 lm", "810 lm"));
  EXPECT_FALSE(responds()) << "lamps are others";
  const std::string room = readFile(files_ / "room.gltf");
  writeFile(files_ / "room.gltf", testing::replaced(room, "[0.7, 0.6, 0.5, 1]", "[0.7, 0.6, 0.6, 1]"));
  EXPECT_FALSE(responds()) << "walls are others";
  EXPECT_TRUE(warnings_.empty()) << warnings_[0];
}

// Light is found once, by whichever process; what comes of it is the same.
TEST_F(RunInAFolder, PartsOfOtherProcessesMakeItsResponse) {
  wish_.evaluations = 1000, wish_.certified = 0;
  EXPECT_FALSE(responds());
  const std::string alone = readFile(wish_.folder / "response.bin");
  wish_.folder = files_ / "shared";
  wish_.parts = 3;
  std::filesystem::create_directories(wish_.folder);
  for (wish_.part = 0; wish_.part < 2; ++wish_.part) {
    optimise::Run run(wish_, news());
    ASSERT_TRUE(run.read());
    const Status found = run.respondPart(stages_);
    ASSERT_TRUE(found) << found.error();
    EXPECT_TRUE(isKept(optimise::Run::partFile(wish_.part, 3)));
  }
  EXPECT_FALSE(isKept("response.bin"));
  EXPECT_TRUE(responds()) << "two of three solutions";
  EXPECT_EQ(readFile(wish_.folder / "response.bin"), alone);
  for (const auto& file : std::filesystem::directory_iterator(wish_.folder))
    EXPECT_NE(file.path().extension(), ".item") << file.path();
  EXPECT_TRUE(warnings_.empty()) << warnings_[0];
}

TEST_F(RunInAFolder, APartOfAResponseThatIsKnownIsNotFoundAgain) {
  wish_.evaluations = 1000, wish_.certified = 0;
  EXPECT_FALSE(responds());
  optimise::Run run(wish_, news());
  ASSERT_TRUE(run.read());
  ASSERT_TRUE(run.respondPart(stages_));
  EXPECT_TRUE(isKept(optimise::Run::partFile(0, 1)));
  for (const auto& file : std::filesystem::directory_iterator(wish_.folder))
    EXPECT_NE(file.path().extension(), ".item") << file.path();
}

TEST_F(RunInAFolder, StoppedBeforeItsResponseIsWholeItKeepsNothing) {
  for (const char* stage : {"bvh", "illuminate"}) {
    cancelIn_ = stage, stop_ = false;
    optimise::Run run(wish_, news());
    EXPECT_FALSE(responds(run));
    EXPECT_TRUE(run.stopped()) << stage;
    EXPECT_EQ(run.report().front.size(), 0u);
    EXPECT_TRUE(folderIsEmpty()) << stage;
  }
}

TEST_F(RunInAFolder, AStoppedSearchGoesOnToTheFrontOfOneThatWasNot) {
  optimise::Run whole(wish_, news());
  responds(whole);
  ASSERT_TRUE(whole.searchAll());
  ASSERT_GT(whole.report().front.size(), 1u);
  std::filesystem::remove(wish_.folder / "search_hybrid.json");
  stopAfter_ = 200;
  optimise::Run stopped(wish_, news());
  EXPECT_TRUE(responds(stopped));
  ASSERT_TRUE(stopped.searchAll());
  EXPECT_TRUE(stopped.stopped());
  EXPECT_LT(stopped.report().methods.at(0).evaluations, 400u);
  EXPECT_GT(stopped.report().front.size(), 0u);
  ASSERT_TRUE(isKept("search_hybrid.json"));
  stop_ = false, stopAfter_ = SIZE_MAX;
  optimise::Run further(wish_, news());
  EXPECT_TRUE(responds(further));
  ASSERT_TRUE(further.searchAll());
  EXPECT_EQ(further.report().methods.at(0).evaluations, whole.report().methods.at(0).evaluations);
  EXPECT_EQ(frontOf(further), frontOf(whole));
  EXPECT_TRUE(warnings_.empty()) << warnings_[0];
}

TEST_F(RunInAFolder, StoppedAmidCertificatesItWritesThoseThereAre) {
  optimise::Run run(wish_, news());
  responds(run);
  ASSERT_TRUE(run.searchAll());
  ASSERT_TRUE(run.propose());
  ASSERT_GE(run.report().designs.size(), 2u);
  stopAt_ = "design 1 certified";
  ASSERT_TRUE(run.certifyAll(stages_));
  EXPECT_TRUE(run.stopped());
  EXPECT_TRUE(run.report().designs[0].certificate);
  EXPECT_FALSE(run.report().designs[1].certificate);
  ASSERT_TRUE(run.write());
  for (const char* file : optimise::Run::kFiles) EXPECT_TRUE(isKept(file)) << file;
}

TEST_F(RunInAFolder, WhatCannotBeKeptIsToldAndTheRunGoesOn) {
  std::filesystem::remove(wish_.folder);
  optimise::Run run(wish_, news());
  EXPECT_FALSE(responds(run));
  ASSERT_TRUE(run.searchAll());
  EXPECT_GT(run.report().front.size(), 0u);
  for (const char* name : {"response.bin", "search_hybrid.json"}) {
    EXPECT_TRUE(std::any_of(warnings_.begin(), warnings_.end(), [&](const std::string& w) {
      return w.find(name) != std::string::npos;
    })) << name;
  }
}

TEST_F(RunInAFolder, ThatFailsLeavesNoFolder) {
  std::filesystem::remove(wish_.folder);
  const std::pair<std::string, const char*> cases[] = {
      {testing::replaced(kGoals, "[\"Front\"]", "[\"Attic\"]"), "study.toml: cameras: "},
      {testing::replaced(kGoals, "fromWalls = 0.6", "fromWalls = 6"), "study.toml:"}};
  for (const auto& [study, says] : cases) {
    writeFile(files_ / "study.toml", study);
    HeldFolder held = holdFolder(wish_.folder).value();
    ASSERT_TRUE(held);
    optimise::Run run(wish_, news());
    const Status read = run.read(), failed = read ? run.respond(stages_) : read;
    ASSERT_FALSE(failed) << says;
    EXPECT_NE(failed.error().find(says), std::string::npos) << failed.error();
    held.reset();
    EXPECT_FALSE(std::filesystem::exists(wish_.folder)) << says;
  }
}

}  // namespace
}  // namespace roomlight::optimise
