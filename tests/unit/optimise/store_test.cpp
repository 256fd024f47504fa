#include "optimise/store.h"

#include "optimise/evaluate.h"
#include "optimise/proposal.h"
#include "optimise/report.h"
#include "photometry/colour_temperature.h"
#include "unit/optimise/small_study.h"

namespace roomlight::optimise {
namespace {

using testing::SmallProblem;

TEST(Store, AResponseComesBackBitByBitAndOnlyForItsInputs) {
  const SmallProblem p;
  const testing::TemporaryFolder folder;
  ASSERT_TRUE(saveResponse(folder / "response.bin", "abc", p.response));
  const ResponseSizes sizes{p.candidates.candidates.size(), p.meters.elements.size(), 1, 1};
  const auto back = loadResponse(folder / "response.bin", "abc", sizes);
  ASSERT_TRUE(back);
  EXPECT_EQ(back->elements, p.response.elements);
  EXPECT_TRUE(std::equal(back->lux.begin(), back->lux.end(), p.response.lux.begin(), p.response.lux.end()));
  EXPECT_EQ(back->base.size(), p.response.base.size());
  EXPECT_FALSE(loadResponse(folder / "response.bin", "abd", sizes));
  // Nor is one that has other sizes than the study.
  for (const ResponseSizes& other : {ResponseSizes{sizes.candidates + 1, sizes.elements, 1, 1},
                                     {sizes.candidates, sizes.elements + 1, 1, 1},
                                     {sizes.candidates, sizes.elements, 2, 1},
                                     {sizes.candidates, sizes.elements, 1, 2}})
    EXPECT_FALSE(loadResponse(folder / "response.bin", "abc", other));
  Response broken = p.response;
  broken.base[0].lux.pop_back();
  ASSERT_TRUE(saveResponse(folder / "broken.bin", "abc", broken));
  EXPECT_FALSE(loadResponse(folder / "broken.bin", "abc", sizes));
  // Half a file is none.
  const std::string bytes = testing::readFile(folder / "response.bin");
  testing::writeFile(folder / "half.bin", bytes.substr(0, bytes.size() / 2));
  EXPECT_FALSE(loadResponse(folder / "half.bin", "abc", sizes));
}

TEST(Store, ASearchThatWasStoppedGoesOnToTheSameFront) {
  const SmallProblem p;
  const search::Problem problem = problemOf(p.model);
  const search::Settings settings{.seed = 5, .evaluations = 3000, .population = 40};
  const search::Genomes first = sparseDesigns(p.model, 40, 5);
  search::State whole = search::start(problem, settings, first);
  search::run(problem, whole);
  search::State part = search::start(problem, settings, first);
  for (int i = 0; i < 4; ++i) search::advance(problem, part);
  const testing::TemporaryFolder folder;
  ASSERT_TRUE(saveSearch(folder / "search.json", "abc", part));
  EXPECT_FALSE(loadSearch(folder / "search.json", "other", problem));
  auto again = loadSearch(folder / "search.json", "abc", problem);
  ASSERT_TRUE(again);
  search::run(problem, *again);
  EXPECT_EQ(again->archive.objectives, whole.archive.objectives);
  EXPECT_EQ(again->evaluations, whole.evaluations);
}

TEST(Store, TheHashOfInputsFollowsEveryFile) {
  testing::SmallStudy s;
  const std::string before = inputHash(s.folder() / "study.toml", s.study(), "x");
  EXPECT_EQ(inputHash(s.folder() / "study.toml", s.study(), "x"), before);
  EXPECT_NE(inputHash(s.folder() / "study.toml", s.study(), "y"), before);
  testing::writeFile(s.folder() / "catalogue.toml", std::string(testing::kCatalogue) + "# a word\n");
  EXPECT_NE(inputHash(s.folder() / "study.toml", s.study(), "x"), before);
}

TEST(Store, TheHashOfAHomeFollowsWhatCameFromOtherFiles) {
  Scene home = testing::smallRoom();
  const std::string before = hashOfScene(home);
  EXPECT_EQ(hashOfScene(testing::smallRoom()), before);
  home.materials[0].baseColor.x *= 0.9f;
  EXPECT_NE(hashOfScene(home), before);
  home = testing::smallRoom();
  home.meshes[0].positions[0].y += 0.1f;
  EXPECT_NE(hashOfScene(home), before);
}

TEST(Proposal, FilesOfConditionsHaveNamesOfTheirOwn) {
  const std::vector<Condition> conditions = {{"Late night", nullptr, 1, 0, 0},
                                             {"late-night", nullptr, 1, 0, 0},
                                             {"late_night_2", nullptr, 1, 0, 0},
                                             {"day", nullptr, 1, 0, 0}};
  EXPECT_EQ(fileNamesOf(conditions), (std::vector<std::string>{"late_night", "late_night_2", "late_night_2_2", "day"}));
}

// Goals are judged with the maintenance factor, by the full solution as by the prediction.
TEST(Proposal, TheFullSolutionIsMaintainedAsThePredictionIs) {
  const SmallProblem p(testing::replaced(testing::kStudy, "catalogue =", "maintenance = 0.8\ncatalogue ="));
  search::Genomes designs = testing::darkDesigns(p.model, 1);
  designs[0].integers[0] = 1, designs[0].reals[0] = 1;
  Certificate::OfCondition c;
  const Vec3* lamp = p.response.of(p.candidates.options[0].candidate);
  for (size_t i = 0; i < p.meters.points(); ++i)
    c.fullLux.push_back(luminance(p.response.base[0].lux[i]) +
                        luminance(lamp[i] * blackBodyColour(p.candidates.options[0].kelvin)));
  const std::vector<float> lux = maintainedLux(p.file.study(), p.model, c, 0), rows = rowsOf(p.model, designs[0], 0);
  ASSERT_EQ(lux.size(), p.meters.points());
  for (size_t i = 0; i < lux.size(); ++i) EXPECT_NEAR(lux[i], rows[i], 1e-4f * rows[i]);
}

TEST(Proposal, IsASpreadOfTheFrontWithTheBestOfEachObjective) {
  const SmallProblem p;
  const search::Problem problem = problemOf(p.model);
  search::State state =
      search::start(problem, {.seed = 1, .evaluations = 3000, .population = 40}, sparseDesigns(p.model, 40, 1));
  search::run(problem, state);
  const std::vector<size_t> chosen = spreadOf(p.model, state.archive, 6);
  ASSERT_EQ(chosen.size(), 6u);
  double least = 1e30;
  for (size_t i = 0; i < state.archive.size(); ++i) least = std::min(least, state.archive.objectivesOf(i)[0]);
  EXPECT_DOUBLE_EQ(state.archive.objectivesOf(chosen[0])[0], least);
  for (const size_t i : chosen) EXPECT_LE(state.archive.objectivesOf(i)[0], least + kProposedMissPercent);
}

TEST(Proposal, LightingFilesNameLampsWithTheirDimmingAndColour) {
  const SmallProblem p;
  search::Genomes designs = testing::darkDesigns(p.model, 1);
  designs[0].integers[0] = 2, designs[0].reals[0] = 0.25;
  const auto lamps = lampsOf(p.file.study(), p.candidates, p.model, designs[0], 0);
  ASSERT_EQ(lamps.size(), 1u);
  EXPECT_EQ(lamps[0]["type"], "spot");
  EXPECT_EQ(lamps[0]["dimming"], 0.25);
  EXPECT_EQ(lamps[0]["temperature"], "3000 K");
  const auto scene = litBy(p.file.home, p.file.study(), nullptr, lamps, true);
  ASSERT_TRUE(scene) << scene.error();
  ASSERT_EQ(scene.value().lamps.size(), 1u);
  EXPECT_NEAR(scene.value().lamps[0].wattsW, 6, 1e-6);
}

TEST(Report, ThePageHoldsTheFrontAndEscapesNames) {
  SmallProblem p(testing::replaced(testing::kStudy, "catalogue =", "title = \"A <b> & </script>\"\ncatalogue ="));
  const search::Problem problem = problemOf(p.model);
  search::State state = search::start(problem, {.seed = 1, .evaluations = 1000, .population = 40});
  search::run(problem, state);
  Report report{p.file.study(), p.candidates, p.meters, p.model, state.archive, {}, {}, {}};
  const auto html = reportHtml(report, p.file.home);
  ASSERT_TRUE(html) << html.error();
  EXPECT_NE(html.value().find("A &lt;b&gt; &amp;"), std::string::npos);
  EXPECT_EQ(html.value().find("<b> &"), std::string::npos);
  const std::string csv = frontCsv(report);
  EXPECT_EQ(static_cast<size_t>(std::count(csv.begin(), csv.end(), '\n')), state.archive.size() + 1);
}

}  // namespace
}  // namespace roomlight::optimise
