// The whole study with renders that are made up: what is asked for, kept, found again and written.
#include "study/study.h"

#include <gtest/gtest.h>

#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>
#include <set>

#include "base/image_io.h"
#include "base/random.h"
#include "study/report.h"
#include "unit/temporary_folder.h"

namespace roomlight {
namespace {

constexpr int kWidth = 24, kHeight = 16;

// A grey ramp of about 100 cd/m², off by `bias`, with noise whose variance falls with samples.
Image picture(double bias, double noise, uint64_t seed) {
  Image image(kWidth, kHeight);
  Rng random(0, 0, seed);
  for (size_t i = 0; i < image.pixels.size(); ++i) {
    const float value = 60 + 80 * static_cast<float>(i) / static_cast<float>(image.pixels.size());
    const float off = static_cast<float>(bias + noise * 2 * (random.uniform() - 0.5));
    image.pixels[i] = Vec3(value) * (1 + off);
  }
  return image;
}

class StudyTest : public ::testing::Test {
 protected:
  void SetUp() override {
    for (const char* name : {"room.glb", "day.json", "walk.json"}) std::ofstream(folder_.path() / name) << name;
    plan_.scenes = {{"Room",
                     folder_.path() / "room.glb",
                     "",
                     {{"daylight", folder_.path() / "day.json"}},
                     folder_.path() / "walk.json"}};
    plan_.scenes[0].walkLight = plan_.scenes[0].lights[0];
    plan_.techniques = {{"cone", "cone", "{}", "ours"}, {"vxgi", "vxgi", "{}", "rival"}, {"lpv", "lpv", "{}", "rival"}};
    settings_.width = kWidth, settings_.height = kHeight, settings_.runs = 2, settings_.mostSeconds = 1000,
    settings_.program = "test";
    settings_.reference = {.roundS = 1, .mostS = 6, .noiseMse = 1e-9};
    tools_.render = [this](const StudyRender& r) { return render(r); };
    tools_.walk = [this](const StudyWalk& w) -> Result<WalkCost> {
      ++walks_;
      if (w.technique == "lpv") return Error{"cannot walk"};
      return WalkCost{10, w.technique == "cone" ? 4.0 : 2.0, 5, 6};
    };
  }

  Result<RenderCost> render(const StudyRender& r) {
    ++renders_;
    if (renders_ == cancelAt_) cancelled_ = true;
    if (cancelled_) return Error{"interrupted"};
    const double bias = r.technique == "vxgi" ? 0.2 : r.technique == "cone" ? 0.05 : 0;
    if (r.technique == "lpv") return Error{"out of luck"};
    const double samples = r.samples > 0 ? r.samples : 1000;
    if (const Status s = writeExr(
            r.picture, picture(bias, 0.5 / std::sqrt(samples), r.seed * 77 + static_cast<uint64_t>(r.samples)), {});
        !s)
      return Error{s.error()};
    return RenderCost{0.5 + 0.1 * samples * (r.technique == "path" ? 0.01 : 1), 1, 100, samples, {}};
  }

  Result<StudyResults> run() {
    const Result<RunStore> store = RunStore::open(folder_.path() / "runs");
    StudyProgress progress;
    progress.cancelled = &cancelled_;
    progress.report = [this](const std::string&, double done, double) { done_ = done; };
    return runStudy(plan_, settings_, store.value(), tools_, progress);
  }

  testing::TemporaryFolder folder_;
  StudyPlan plan_;
  StudySettings settings_;
  StudyTools tools_;
  std::atomic<bool> cancelled_{false};
  int renders_ = 0, walks_ = 0, cancelAt_ = -1;
  double done_ = 0;  // as told last
};

TEST_F(StudyTest, CurvesSettleAtTheBiasOfEachTechnique) {
  const Result<StudyResults> r = run();
  ASSERT_TRUE(r) << r.error();
  ASSERT_EQ(r.value().cases.size(), 1u);
  const StudyCase& c = r.value().cases[0];
  EXPECT_GE(c.referenceSamples, 1000);
  EXPECT_FALSE(c.referenceConverged) << "a noise of 1e-9 is out of reach";
  ASSERT_EQ(c.curves.size(), 3u);
  EXPECT_TRUE(hasSettled(c.curves[0]));
  EXPECT_EQ(c.curves[0].points[0].runsS.size(), 2u);
  EXPECT_LT(errorOf(settledPoint(c.curves[0])), errorOf(settledPoint(c.curves[1])) / 4);
  EXPECT_NEAR(settledPoint(c.curves[1]).meanErrorPercent, 20, 2);
  EXPECT_EQ(c.curves[2].failed, "out of luck");
  EXPECT_TRUE(r.value().complete);
  ASSERT_EQ(r.value().frames.size(), 3u);
  EXPECT_EQ(r.value().frames[0].cost.framesPerSecond, 4);
  EXPECT_EQ(r.value().frames[2].failed, "cannot walk");
}

TEST_F(StudyTest, SomeTechniquesAreTriedInWalksOrPicturesAlone) {
  plan_.techniques = {{"cone", "cone", "{}", "ours", "pictures"}, {"walking", "cone", "{}", "ours", "walks"}};
  const Result<StudyResults> r = run();
  ASSERT_TRUE(r) << r.error();
  ASSERT_EQ(r.value().cases.front().curves.size(), 1u);
  EXPECT_EQ(r.value().cases.front().curves[0].technique, "cone");
  ASSERT_EQ(r.value().frames.size(), 1u);
  EXPECT_EQ(r.value().frames[0].technique, "walking");
}

TEST_F(StudyTest, WhereNoTechniqueIsForPicturesThereAreWalksAlone) {
  plan_.techniques = {{"walking", "cone", "{}", "ours", "walks"}};
  const Result<StudyResults> r = run();
  ASSERT_TRUE(r) << r.error();
  EXPECT_EQ(renders_, 0) << "no reference";
  EXPECT_TRUE(r.value().cases.empty());
  EXPECT_DOUBLE_EQ(done_, 0.5) << "before the second of two runs";
  ASSERT_EQ(r.value().frames.size(), 1u);
  EXPECT_FALSE(nothingMeasured(r.value()));
  const Result<std::string> html = studyHtml({}, r.value(), folder_.path() / "runs", "<script>plots</script>");
  ASSERT_TRUE(html) << html.error();
  EXPECT_NE(html.value().find("<h3>Room, daylight</h3>"), std::string::npos);
  EXPECT_EQ(html.value().find("<script"), std::string::npos) << "bars need none";
}

TEST_F(StudyTest, WhereNothingCouldBeMeasuredThePageSaysWhy) {
  plan_.techniques = {{"walking", "lpv", "{}", "ours", "walks"}};
  const Result<StudyResults> r = run();
  ASSERT_TRUE(r) << r.error();
  EXPECT_TRUE(nothingMeasured(r.value()));
  const Result<std::string> html = studyHtml({}, r.value(), folder_.path() / "runs");
  ASSERT_TRUE(html) << html.error();
  EXPECT_NE(html.value().find("Nothing has been measured"), std::string::npos);
  EXPECT_NE(html.value().find("Room: walk: walking: cannot walk"), std::string::npos);
}

TEST_F(StudyTest, WalksAreInTheFirstLightOfThePlanWhateverElseIsTried) {
  plan_.scenes[0].lights[0].name = "lamps", plan_.scenes[0].lights[0].lighting.clear();
  plan_.techniques = {{"cone", "cone", "{}", "ours", "walks"}};
  tools_.walk = [this](const StudyWalk& w) -> Result<WalkCost> {
    EXPECT_EQ(w.lighting, folder_.path() / "day.json");
    return WalkCost{10, 4, 5, 6};
  };
  const Result<StudyResults> r = run();
  ASSERT_TRUE(r) << r.error();
  ASSERT_EQ(r.value().frames.size(), 1u);
  EXPECT_EQ(nlohmann::json::parse(studyJson({}, r.value()))["frames"][0]["light"], "daylight");
  EXPECT_NE(studyCsv(r.value()).find(R"(walk,"Room","daylight","cone")"), std::string::npos);
  EXPECT_NE(studyMarkdown({}, r.value()).find("| Room | daylight | cone | 4.00 |"), std::string::npos);
}

TEST_F(StudyTest, WalksThatWereGoodCountWhereALaterOneIsInterruptedOrFails) {
  plan_.techniques = {{"cone", "cone", "{}", "ours", "walks"}, {"vxgi", "vxgi", "{}", "rival", "walks"}};
  for (const bool interrupted : {true, false}) {
    cancelled_ = false, walks_ = 0;
    settings_.program = interrupted ? "interrupted" : "failing";
    tools_.walk = [&](const StudyWalk&) -> Result<WalkCost> {
      if (++walks_ != 3) return WalkCost{10, 4, 5, 6};
      cancelled_ = interrupted;
      return Error{"lost"};
    };
    const Result<StudyResults> r = run();
    ASSERT_TRUE(r) << r.error();
    EXPECT_EQ(r.value().complete, !interrupted);
    ASSERT_EQ(r.value().frames.size(), 2u);
    EXPECT_EQ(r.value().frames[0].failed, interrupted ? "" : "lost");
    EXPECT_EQ(r.value().frames[0].cost.framesPerSecond, 4);
    EXPECT_EQ(r.value().remarks.size(), interrupted ? 0u : 1u);
    EXPECT_NE(studyCsv(r.value()).find(R"("cone")"), std::string::npos);
  }
}

TEST_F(StudyTest, WhatHasBeenMeasuredIsNotMeasuredAgain) {
  plan_.techniques.pop_back();
  ASSERT_TRUE(run());
  const int renders = renders_, walks = walks_;
  ASSERT_TRUE(run());
  EXPECT_EQ(renders_, renders);
  EXPECT_EQ(walks_, walks);
  settings_.program = "another build";
  ASSERT_TRUE(run());
  EXPECT_GT(renders_, renders);
}

TEST_F(StudyTest, AReferenceIsNotMadeAgainByAnotherBuildButByAnotherLight) {
  plan_.techniques.clear();
  const auto file = folder_.path() / "other.exr";
  ASSERT_TRUE(writeExr(file, picture(0.1, 0, 1), {}));
  settings_.externals = {{"offline", "", "", file, 412}};
  ASSERT_TRUE(run());
  const int renders = renders_;
  EXPECT_GT(renders, 0);
  settings_.program = "another build";
  ASSERT_TRUE(run());
  EXPECT_EQ(renders_, renders);
  std::ofstream(folder_.path() / "day.json") << "brighter";
  ASSERT_TRUE(run());
  EXPECT_GT(renders_, renders);
}

TEST_F(StudyTest, GoesOnWhereItWasStopped) {
  plan_.techniques.pop_back();
  ASSERT_TRUE(run());
  const int all = renders_;
  std::filesystem::remove_all(folder_.path() / "runs");
  renders_ = 0, cancelAt_ = all / 2;
  const Result<StudyResults> part = run();
  ASSERT_TRUE(part) << part.error();
  EXPECT_FALSE(part.value().complete);
  cancelled_ = false, cancelAt_ = -1;
  const int before = renders_;
  const Result<StudyResults> rest = run();
  ASSERT_TRUE(rest) << rest.error();
  EXPECT_TRUE(rest.value().complete);
  EXPECT_LT(renders_ - before, all) << "half was there";
  EXPECT_EQ(rest.value().cases.at(0).curves.size(), 2u);
}

TEST_F(StudyTest, PicturesOfOthersStandInTheSameTable) {
  const auto file = folder_.path() / "other.exr";
  ASSERT_TRUE(writeExr(file, picture(0.1, 0, 1), {}));
  settings_.externals = {{"offline", "", "", file, 412}, {"elsewhere", "Kitchen", "", file, 1}};
  const Result<StudyResults> r = run();
  ASSERT_TRUE(r) << r.error();
  ASSERT_EQ(r.value().cases[0].externals.size(), 1u);
  EXPECT_NEAR(r.value().cases[0].externals[0].meanErrorPercent, 10, 1);
  EXPECT_NE(studyMarkdown({}, r.value()).find("offline (external)"), std::string::npos);
  EXPECT_NE(studyMarkdown({}, r.value()).find("| `cone` over | vxgi"), std::string::npos);
}

TEST_F(StudyTest, APictureOfAnotherThatCannotBeComparedIsARemark) {
  const auto file = folder_.path() / "broken.exr";
  Image broken = picture(0.1, 0, 1);
  broken.pixels[7].y = std::numeric_limits<float>::quiet_NaN();
  ASSERT_TRUE(writeExr(file, broken, {}));
  settings_.externals = {{"offline", "", "", file, 412}};
  const Result<StudyResults> r = run();
  ASSERT_TRUE(r) << r.error();
  ASSERT_EQ(r.value().cases.size(), 1u);
  EXPECT_TRUE(r.value().cases[0].externals.empty());
  EXPECT_FALSE(r.value().cases[0].curves.at(0).points.empty());
  ASSERT_FALSE(r.value().remarks.empty());
  EXPECT_NE(r.value().remarks[0].find("Room, daylight: --external offline: left out"), std::string::npos)
      << r.value().remarks[0];
}

TEST_F(StudyTest, ReportsAreWholeAndAgree) {
  const Result<StudyResults> r = run();
  ASSERT_TRUE(r) << r.error();
  StudyHeader header;
  header.about = {{"processor", "<fast & cheap>"}, {"program", "test"}};
  header.techniques = {{"program", "technique lpv, settings {}"}};
  const auto json = nlohmann::json::parse(studyJson(header, r.value()));
  EXPECT_EQ(json["about"]["program"], "test");
  EXPECT_EQ(json["about"]["techniques"]["program"], "technique lpv, settings {}")
      << "a technique may have the name of another row";
  EXPECT_EQ(json["cases"][0]["curves"].size(), 3u);
  const std::string csv = studyCsv(r.value());
  size_t points = 0;
  for (const StudyCurve& c : r.value().cases[0].curves) points += c.points.size();
  EXPECT_EQ(static_cast<size_t>(std::count(csv.begin(), csv.end(), '\n')), 1 + points + 2)
      << "a head, points, two walks";
  for (size_t from = 0, end; (end = csv.find('\n', from)) != std::string::npos; from = end + 1) {
    EXPECT_EQ(std::count(csv.begin() + static_cast<long>(from), csv.begin() + static_cast<long>(end), ','), 12)
        << csv.substr(from, end - from);
  }
  const Result<std::string> html = studyHtml(header, r.value(), folder_.path() / "runs", "<script>plots</script>");
  ASSERT_TRUE(html) << html.error();
  EXPECT_NE(html.value().find("<script>plots</script>"), std::string::npos);
  const std::string begin = "<script type=\"application/json\">";
  const size_t from = html.value().find(begin) + begin.size();
  const auto plotted = nlohmann::json::parse(html.value().substr(from, html.value().find("</script>", from) - from));
  const auto& curves = plotted["cases"][0]["curves"];
  ASSERT_EQ(curves.size(), 2u) << "one has no points";
  const StudyCurve& cone = r.value().cases[0].curves[0];
  EXPECT_EQ(curves[0]["name"], "cone");
  ASSERT_EQ(curves[0]["points"].size(), cone.points.size());
  EXPECT_EQ(curves[0]["points"][0][0], cone.points[0].samples);
  EXPECT_EQ(&cone.points[curves[0]["settled"].get<size_t>()], &settledPoint(cone));
  EXPECT_NE(html.value().find("<summary>Every point</summary>"), std::string::npos) << "for who has no scripts";
  EXPECT_NE(html.value().find("&lt;fast &amp; cheap&gt;"), std::string::npos);
  EXPECT_NE(html.value().find("data:image/jpeg;base64,"), std::string::npos);
  EXPECT_EQ(html.value().find("src=\"http"), std::string::npos) << "needs nothing from elsewhere";
}

TEST_F(StudyTest, NamesThatLookAlikeInFilesDoNotMeet) {
  plan_.techniques = {
      {"lpv, 256", "cone", "{}", "ours"}, {"lpv 256", "vxgi", "{}", "rival"}, {"reference", "cone", "{}", "ours"}};
  plan_.scenes = {{"居間", folder_.path() / "room.glb", "", {{"day", folder_.path() / "day.json"}}, {}},
                  {"寝室", folder_.path() / "room.glb", "2", {{"day", folder_.path() / "day.json"}}, {}}};
  const Result<StudyResults> r = run();
  ASSERT_TRUE(r) << r.error();
  std::set<std::string> pictures;
  size_t points = 0;
  for (const StudyCase& c : r.value().cases) {
    pictures.insert(c.first.string());
    ++points;
    for (const StudyCurve& curve : c.curves) {
      for (const StudyPoint& p : curve.points) pictures.insert(p.picture), ++points;
    }
  }
  EXPECT_EQ(pictures.size(), points);
  const int renders = renders_;
  ASSERT_TRUE(run());
  EXPECT_EQ(renders_, renders);
}

TEST_F(StudyTest, ResultsOfAnotherBuildStandBesideTheFirst) {
  plan_.techniques.pop_back();
  ASSERT_TRUE(run());
  settings_.program = "another build";
  ASSERT_TRUE(run());
  const int renders = renders_;
  settings_.program = "test";
  ASSERT_TRUE(run());
  EXPECT_EQ(renders_, renders);
}

TEST_F(StudyTest, AViewWithoutLightIsLeftOutWithARemark) {
  plan_.scenes.push_back(plan_.scenes[0]);
  plan_.scenes[1].name = "Cellar", plan_.scenes[1].walk.clear();
  tools_.render = [this](const StudyRender& r) -> Result<RenderCost> {
    if (r.camera != "dark") return render(r);
    if (const Status s = writeExr(r.picture, Image(kWidth, kHeight), {}); !s) return Error{s.error()};
    return RenderCost{1, 1, 1, 1, {}};
  };
  plan_.scenes[0].camera = "dark";
  const Result<StudyResults> r = run();
  ASSERT_TRUE(r) << r.error();
  ASSERT_EQ(r.value().cases.size(), 1u);
  EXPECT_EQ(r.value().cases[0].scene, "Cellar");
  ASSERT_FALSE(r.value().remarks.empty());
  EXPECT_NE(r.value().remarks[0].find("Room, daylight: left out"), std::string::npos) << r.value().remarks[0];
}

TEST_F(StudyTest, PublishedFiguresAreInReportsOfPlansThatAskForThem) {
  for (const bool asked : {false, true}) {
    plan_.againstPublished = asked;
    const Result<StudyResults> r = run();
    ASSERT_TRUE(r) << r.error();
    const auto json = nlohmann::json::parse(studyJson({}, r.value()));
    EXPECT_EQ(json.contains("published"), asked);
    EXPECT_EQ(json.contains("verdicts"), asked);
    EXPECT_EQ(studyVerdicts(r.value()).empty(), !asked);
    const Result<std::string> html = studyHtml({}, r.value(), folder_.path() / "runs");
    ASSERT_TRUE(html) << html.error();
    for (const std::string& page : {html.value(), studyMarkdown({}, r.value())}) {
      // 48.2: of the published first table.
      for (const char* word : {"ublished study", "48.2", "vxgi .0051", "vxgi 28"})
        EXPECT_EQ(page.find(word) != std::string::npos, asked) << word;
      EXPECT_NE(page.find(page.starts_with("#") ? "settles at mse" : "Error where it settles"), std::string::npos);
    }
  }
}

TEST_F(StudyTest, VerdictsTellWhoWins) {
  plan_.againstPublished = true;
  const Result<StudyResults> r = run();
  ASSERT_TRUE(r);
  const auto verdicts = studyVerdicts(r.value());
  const auto found = [&](const std::string& start) {
    for (const StudyVerdict& v : verdicts) {
      if (v.asked.starts_with(start)) return v;
    }
    ADD_FAILURE() << start;
    return StudyVerdict{};
  };
  EXPECT_TRUE(found("cone settles below").met);
  EXPECT_TRUE(found("frames a second").met);
  EXPECT_NE(found("frames a second").measured.find("quickest of ours: 'cone'"), std::string::npos)
      << found("frames a second").measured;
}

TEST(StudyBars, PublishedTicksAreInRatioToCone) {
  const auto ticks = [](const std::vector<Bar>& bars) {
    const std::string html = barsHtml(bars, "/s");
    size_t count = 0;
    for (size_t at = 0; (at = html.find("title=\"published", at)) != std::string::npos; ++at) ++count;
    return count;
  };
  const Bar vxgi{"vxgi", "#000", 9, 28}, cone{"cone", "#000", 18, 36};
  EXPECT_EQ(ticks({vxgi}), 0u) << "nothing to be in ratio to";
  EXPECT_EQ(ticks({vxgi, cone}), 2u);
  EXPECT_NE(barsHtml({vxgi, cone}, "/s").find("left:100.0%\" title=\"published, in ratio: 36"), std::string::npos)
      << "cone's own stands at its end, the longest, whichever comes first";
}

TEST(StudyStore, AFolderIsOfOneStudyAtATime) {
  const testing::TemporaryFolder folder;
  Result<RunStore> first = RunStore::open(folder / "runs");
  ASSERT_TRUE(first) << first.error();
  {
    const RunStore moved = std::move(first.value());
    const Result<RunStore> second = RunStore::open(folder / "runs");
    ASSERT_FALSE(second);
    EXPECT_NE(second.error().find("runs: is in use by another study"), std::string::npos) << second.error();
  }
  EXPECT_TRUE(RunStore::open(folder / "runs"));
}

}  // namespace
}  // namespace roomlight
