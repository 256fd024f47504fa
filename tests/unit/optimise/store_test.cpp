#include "optimise/store.h"

#include <map>
#include <nlohmann/json.hpp>
#include <utility>

#include "base/hash.h"
#include "optimise/evaluate.h"
#include "optimise/proposal.h"
#include "optimise/report.h"
#include "photometry/colour_temperature.h"
#include "unit/optimise/small_study.h"
#include "unit/photometry/web_files.h"

namespace roomlight::optimise {
namespace {

using testing::SmallProblem;

// None also where the file is refused; `refused`: with which line.
std::optional<Response> load(const std::filesystem::path& file, const std::string& hash, const ResponseSizes& sizes,
                             std::string* refused = nullptr) {
  const Result<std::optional<Response>> r = loadResponse(file, hash, sizes);
  if (refused) *refused = r ? "" : r.error();
  return r ? r.value() : std::nullopt;
}

TEST(Store, AResponseComesBackBitByBitAndOnlyForItsInputs) {
  const SmallProblem p;
  const testing::TemporaryFolder folder;
  ASSERT_TRUE(saveResponse(folder / "response.bin", "abc", p.response));
  const ResponseSizes sizes{p.candidates.candidates.size(), p.meters.elements.size(), 1, 1};
  std::string refused;
  const auto back = load(folder / "response.bin", "abc", sizes);
  ASSERT_TRUE(back);
  EXPECT_EQ(back->elements, p.response.elements);
  EXPECT_TRUE(std::equal(back->lux.begin(), back->lux.end(), p.response.lux.begin(), p.response.lux.end()));
  EXPECT_EQ(back->base.size(), p.response.base.size());
  EXPECT_FALSE(load(folder / "response.bin", "abd", sizes, &refused));
  EXPECT_EQ(refused, "") << "it is whole";
  EXPECT_FALSE(load(folder / "none.bin", "abc", sizes, &refused));
  EXPECT_EQ(refused, "");
  // Nor is one that has other sizes than the study.
  for (const ResponseSizes& other : {ResponseSizes{sizes.candidates + 1, sizes.elements, 1, 1},
                                     {sizes.candidates, sizes.elements + 1, 1, 1},
                                     {sizes.candidates, sizes.elements, 2, 1},
                                     {sizes.candidates, sizes.elements, 1, 2}})
    EXPECT_FALSE(load(folder / "response.bin", "abc", other));
  Response broken = p.response;
  broken.base[0].lux.pop_back();
  ASSERT_TRUE(saveResponse(folder / "broken.bin", "abc", broken));
  EXPECT_FALSE(load(folder / "broken.bin", "abc", sizes));
  // Half a file is none.
  const std::string bytes = testing::readFile(folder / "response.bin");
  testing::writeFile(folder / "half.bin", bytes.substr(0, bytes.size() / 2));
  EXPECT_FALSE(load(folder / "half.bin", "abc", sizes));
}

// A response as three solutions: two groups of candidates, one condition.
struct Cut {
  ResponseSizes sizes;
  std::vector<ResponseItem> items;
};
Cut cut(const SmallProblem& p) {
  const Response& r = p.response;
  const size_t n = p.candidates.candidates.size(), half = n / 2;
  Cut out{{n, p.meters.elements.size(), 1, 1, p.meters.points()}, {}};
  for (const auto& [first, end] : {std::pair{size_t{0}, half}, {half, n}}) {
    out.items.push_back({first,
                         end - first,
                         {r.of(first), r.of(first) + (end - first) * r.elements},
                         std::vector<float>((end - first) * out.sizes.points, 0.01f),
                         {r.glareOf(first), r.glareOf(first) + (end - first)}});
  }
  out.items.push_back({0, 0, r.base[0].lux, {}, r.base[0].glare});
  return out;
}

TEST(Store, ItemsOfSeveralFoldersMakeTheResponse) {
  const SmallProblem p;
  const testing::TemporaryFolder folder;
  const Cut parts = cut(p);
  std::vector<std::filesystem::path> files;
  for (size_t i = 0; i < parts.items.size(); ++i) {
    const std::filesystem::path at = folder / (i == 1 ? "a" : "b");
    std::filesystem::create_directories(at);
    ASSERT_TRUE(saveItem(at, hashOf("abc"), parts.sizes, {i, 3}, parts.items[i]));
    files.push_back(at / itemFileName({i, 3}));
    EXPECT_EQ(loadItem(at, hashOf("abc"), parts.sizes, {i, 3}).value(), parts.items[i]);
    EXPECT_FALSE(loadItem(at, hashOf("abd"), parts.sizes, {i, 3}).value()) << "of other inputs";
    EXPECT_FALSE(loadItem(at, hashOf("abc"), parts.sizes, {i, 4}).value()) << "cut otherwise";
  }
  files.push_back(folder / "b" / "part_01_of_02.json");
  const auto joined = joinItems(files, folder / "response.bin");
  ASSERT_TRUE(joined) << joined.error();
  EXPECT_EQ(joined.value(), 3u);
  const auto back = load(folder / "response.bin", hashOf("abc"), parts.sizes);
  ASSERT_TRUE(back);
  EXPECT_EQ(back->lux, p.response.lux);
  EXPECT_EQ(back->glare, p.response.glare);
  EXPECT_EQ(back->base[0].lux, p.response.base[0].lux);
  EXPECT_GT(back->worstErrorPercent, 0);
}

TEST(Store, ItemsThatDoNotFitAreNotJoined) {
  const SmallProblem p;
  const testing::TemporaryFolder folder;
  const Cut parts = cut(p);
  std::vector<std::filesystem::path> files;
  for (size_t i = 0; i < 2; ++i) {
    ASSERT_TRUE(saveItem(folder.path(), hashOf("abc"), parts.sizes, {i, 3}, parts.items[i]));
    files.push_back(folder / itemFileName({i, 3}));
  }
  const auto refused = [&](const std::string& with) {
    const auto joined = joinItems(files, folder / "response.bin");
    EXPECT_FALSE(std::filesystem::exists(folder / "response.bin"));
    return !joined && joined.error().find(with) != std::string::npos;
  };
  EXPECT_TRUE(refused("2 of 3 parts"));
  ASSERT_TRUE(saveItem(folder.path(), hashOf("abd"), parts.sizes, {2, 3}, parts.items[2]));
  files.push_back(folder / itemFileName({2, 3}));
  EXPECT_TRUE(refused("is of another study"));
  std::string bytes = testing::readFile(files.back());
  bytes[bytes.size() / 2] ^= 1;
  testing::writeFile(files.back(), bytes);
  EXPECT_TRUE(refused("is damaged"));
}

TEST(Store, ADamagedResponseIsRefusedWithOneLine) {
  const testing::TemporaryFolder folder;
  const std::filesystem::path file = folder / "response.bin";
  Response r;
  r.elements = 2, r.eyes = 1;
  r.lux = {{1, 2, 3}, {4, 5, 6}}, r.glare = {{7, 8}};
  r.base = {{{{1, 1, 1}, {2, 2, 2}}, {{3, 4}}}};
  ASSERT_TRUE(saveResponse(file, hashOf("abc"), r));
  const ResponseSizes sizes{1, 2, 1, 1};
  ASSERT_TRUE(load(file, hashOf("abc"), sizes));
  const std::string bytes = testing::readFile(file);
  const auto expectRefused = [&](const std::string& damaged, const std::string& how) {
    testing::writeFile(file, damaged);
    std::string refused;
    EXPECT_FALSE(load(file, hashOf("abc"), sizes, &refused)) << how;
    EXPECT_NE(refused.find("response.bin: is damaged"), std::string::npos) << how << ": " << refused;
    EXPECT_EQ(refused.find('\n'), std::string::npos) << how;
  };
  // Small enough for every bit: of the head, the hash of the inputs, sizes, numbers and the check itself.
  for (size_t i = 0; i < bytes.size(); ++i) {
    for (int bit = 0; bit < 8; ++bit) {
      std::string damaged = bytes;
      damaged[i] = static_cast<char>(damaged[i] ^ (1 << bit));
      expectRefused(damaged, fmt::format("bit {} of byte {}", bit, i));
    }
    expectRefused(bytes.substr(0, i), fmt::format("cut to {} bytes", i));
  }
  expectRefused(bytes + '\0', "a byte more");
  // Two that cancel each other out where changes are only added up.
  const size_t middle = bytes.size() / 2;
  std::string damaged = bytes;
  damaged[middle] = static_cast<char>(damaged[middle] ^ 0x80);
  damaged[middle + 8] = static_cast<char>(damaged[middle + 8] ^ 0x80);
  expectRefused(damaged, "two bits");
  testing::writeFile(file, bytes);
  EXPECT_TRUE(load(file, hashOf("abc"), sizes));
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
  const std::filesystem::path file = folder / "search.json";
  ASSERT_TRUE(saveSearch(file, "abc", part));
  const auto other = loadSearch(file, "other", problem);
  ASSERT_TRUE(other) << other.error();
  EXPECT_FALSE(other.value());
  const auto known = loadSearch(file, "abc", problem);
  ASSERT_TRUE(known) << known.error();
  ASSERT_TRUE(known.value());
  search::State again = *known.value();
  search::run(problem, again);
  EXPECT_EQ(again.archive.objectives, whole.archive.objectives);
  EXPECT_EQ(again.evaluations, whole.evaluations);
  // A digit of a design is another one.
  std::string text = testing::readFile(file);
  const size_t digit = text.find_first_of("12345678", text.size() / 2);
  ASSERT_NE(digit, std::string::npos);
  ++text[digit];
  testing::writeFile(file, text);
  const auto damaged = loadSearch(file, "abc", problem);
  ASSERT_FALSE(damaged);
  EXPECT_NE(damaged.error().find("search.json: is damaged"), std::string::npos) << damaged.error();
}

std::string hashOfInputs(const Scene& home, const StudyFile& study, const std::string& settings = "x") {
  const Result<std::string> hash = inputHash(home, study, settings);
  EXPECT_TRUE(hash) << hash.error();
  return hash ? hash.value() : "";
}

TEST(Store, TheHashOfInputsFollowsEveryFile) {
  testing::SmallStudy s;
  const std::string before = hashOfInputs(s.home, s.study());
  EXPECT_EQ(hashOfInputs(s.home, s.study()), before);
  EXPECT_NE(hashOfInputs(s.home, s.study(), "y"), before);
  testing::writeFile(s.folder() / "catalogue.toml", std::string(testing::kCatalogue) + "# a word\n");
  EXPECT_NE(hashOfInputs(s.home, s.study()), before);
  testing::writeFile(s.folder() / "catalogue.toml", testing::kCatalogue);
  EXPECT_EQ(hashOfInputs(s.home, s.study()), before);
  testing::writeFile(s.folder() / "study.toml", std::string(testing::kStudy) + "# a word\n");
  EXPECT_NE(hashOfInputs(s.home, s.study()), before);
}

TEST(Store, TheHashOfInputsFollowsFilesThatOtherFilesName) {
  const testing::TemporaryFolder files;
  const auto weather = [](int diffuse) {
    return fmt::format(
        "LOCATION,Town,-,DEU,IWEC,1,48.14,11.58,1.0,500\nDATA PERIODS,1,1,Data,Sunday,1/1,12/31\n"
        "2005,6,10,16,60,?9?9?9,20.0,8.0,50,101300,0,1300,300,500,700,{},50000,0,0,9999,180,3.0,5,5\n",
        diffuse);
  };
  testing::IesText ies;
  testing::LdtText ldt;
  ies.tilt = "TILT=lamp.tlt\n";
  const std::string lighting = R"({"lamps": [{"type": "photometric", "position": [1, 2, 1], "file": "strip.ldt"}]})";
  const std::map<std::string, std::string> whole = {{"town.epw", weather(120)},
                                                    {"spot.ies", ies.text()},
                                                    {"lamp.tlt", "1 2 0 90 1 0.5"},
                                                    {"strip.ldt", ldt.text()},
                                                    {"fixed.json", lighting}};
  for (const auto& [name, text] : whole) testing::writeFile(files / name, text);
  const std::string study = testing::replaced(
      testing::replaced(testing::kStudy, "daylight = \"none\"",
                        fmt::format("daylight = {{ weather = \"{}\", time = \"2026-06-10T16:30+02:00\" }}",
                                    (files / "town.epw").string())),
      "catalogue =", fmt::format("lighting = \"{}\"\ncatalogue =", (files / "fixed.json").string()));
  const std::string catalogue =
      testing::replaced(testing::kCatalogue, "type = \"point\"\nflux = \"800 lm\"",
                        fmt::format("type = \"photometric\"\nfile = \"{}\"", (files / "spot.ies").string()));
  const testing::SmallStudy s(study, catalogue);
  ASSERT_TRUE(s.read) << s.read.error();
  const std::string before = hashOfInputs(s.home, s.study());
  EXPECT_EQ(hashOfInputs(s.home, s.study()), before);
  ies.candela = [](double, double g) { return 1000 * std::pow(std::cos(testing::radians(g)), 2); };
  ldt.candelaPerKlm = [](double, double g) { return g < 45 ? 500.0 : 0.0; };
  const std::pair<std::string, std::string> changes[] = {
      {"town.epw", weather(130)},
      {"spot.ies", ies.text()},
      {"lamp.tlt", "1 2 0 90 1 0.7"},
      {"strip.ldt", ldt.text()},
      {"fixed.json", testing::replaced(lighting, "[1, 2, 1]", "[1, 2, 1.5]")}};
  for (const auto& [name, text] : changes) {
    testing::writeFile(files / name, text);
    EXPECT_NE(hashOfInputs(s.home, s.study()), before) << name;
    testing::writeFile(files / name, whole.at(name));
    EXPECT_EQ(hashOfInputs(s.home, s.study()), before) << name;
  }
  std::filesystem::remove(files / "town.epw");
  const Result<std::string> none = inputHash(s.home, s.study(), "x");
  ASSERT_FALSE(none);
  EXPECT_NE(none.error().find("town.epw"), std::string::npos) << none.error();
}

TEST(Store, TheHashOfInputsFollowsTheHome) {
  const testing::SmallStudy s;
  const std::string before = hashOfInputs(testing::smallRoom(), s.study());
  EXPECT_EQ(hashOfInputs(testing::smallRoom(), s.study()), before);
  const auto expectNoticed = [&](void (*change)(Scene&), const char* what) {
    Scene home = testing::smallRoom();
    change(home);
    EXPECT_NE(hashOfInputs(home, s.study()), before) << what;
  };
  expectNoticed([](Scene& h) { h.materials[0].baseColor.x *= 0.9f; }, "colour");
  expectNoticed([](Scene& h) { h.materials[0].alphaMode = AlphaMode::Blend; }, "alpha mode");
  expectNoticed([](Scene& h) { h.materials[0].baseColorTexture.texture = 0; }, "reference to a texture");
  expectNoticed([](Scene& h) { h.meshes[0].positions[0].y += 0.1f; }, "shape");
  expectNoticed([](Scene& h) { h.instances[0].worldFromObject.x *= 1.1f; }, "size, as --metres-per-unit changes it");
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
  const auto lamps = lampsOf({p.file.study(), p.candidates, p.model, designs[0]}, 0);
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
  report.designs.resize(1), report.designs[0].index = 3;
  report.designs[0].result = resultOf(p.model, std::as_const(state.archive.designs)[3]);
  const auto html = reportHtml(report, p.file.home, "<script>plots</script>");
  ASSERT_TRUE(html) << html.error();
  EXPECT_NE(html.value().find("<script>plots</script>"), std::string::npos);
  const std::string begin = "<script type=\"application/json\">";
  const size_t from = html.value().find(begin) + begin.size();
  const auto data = nlohmann::json::parse(html.value().substr(from, html.value().find("</script>", from) - from));
  ASSERT_EQ(data["points"].size(), state.archive.size());
  EXPECT_EQ(data["axes"].size(), p.model.objectives.size());
  EXPECT_EQ(data["points"][3]["design"], 1);
  EXPECT_FALSE(data["points"][0].contains("design"));
  EXPECT_EQ(data["points"][0]["v"].size(), data["axes"].size());
  EXPECT_NE(html.value().find("All designs of the front"), std::string::npos) << "for who has no scripts";
  EXPECT_NE(html.value().find("A &lt;b&gt; &amp;"), std::string::npos);
  EXPECT_EQ(html.value().find("<b> &"), std::string::npos);
  const std::string csv = frontCsv(report);
  EXPECT_EQ(static_cast<size_t>(std::count(csv.begin(), csv.end(), '\n')), state.archive.size() + 1);
}

}  // namespace
}  // namespace roomlight::optimise
