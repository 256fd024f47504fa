#include "optimise/study_file.h"

#include "unit/optimise/small_study.h"

namespace roomlight::optimise {
namespace {

using testing::kCatalogue;
using testing::kStudy;
using testing::replaced;
using testing::SmallStudy;

TEST(StudyFile, IsReadWithDefaults) {
  const SmallStudy s;
  ASSERT_TRUE(s.read) << s.read.error();
  const StudyFile& f = s.study();
  EXPECT_EQ(f.title, "study");
  ASSERT_EQ(f.zones.size(), 1u);
  EXPECT_DOUBLE_EQ(f.zones[0].meanLux, 100);
  EXPECT_EQ(f.zones[0].conditions, std::vector<size_t>{0});
  EXPECT_NEAR(f.eyes[0].direction.x, 1, 1e-6);
  ASSERT_EQ(f.places.size(), 2u);
  EXPECT_EQ(f.places[0].aimWords, std::vector<std::string>{"down"});
  EXPECT_EQ(f.catalogue.luminaires[1].kelvin, (std::vector<double>{3000, 4000}));
  EXPECT_EQ(f.dimming, Dimming::ByCondition);
  EXPECT_EQ(f.population % 4, 0u);
}

TEST(StudyFile, EveryObjectiveHasItsWordAndItsPlaceInTheDocumentation) {
  for (const ObjectiveInfo& o : objectiveTable()) {
    EXPECT_EQ(&infoOf(o.objective), &o);
    const std::string other = o.objective == Objective::TargetMiss ? "cost" : "targetMiss";
    const SmallStudy s(
        replaced(kStudy, "[\"targetMiss\", \"energy\", \"cost\"]", fmt::format("[\"{}\", \"{}\"]", o.name, other)));
    ASSERT_TRUE(s.read) << s.read.error();
    EXPECT_EQ(s.study().objectives.front(), o.objective);
    for (const char* page : {"reference/optimise.md", "methods/optimise.md", "use/proposals.md"})
      EXPECT_NE(testing::readFile(ROOMLIGHT_SOURCE_DIR "/docs/" + std::string(page)).find(fmt::format("`{}`", o.name)),
                std::string::npos)
          << o.name << " is not in " << page;
  }
}

TEST(StudyFile, HoursOfNightAndDayAreShared) {
  const SmallStudy s(replaced(kStudy, "hours = 1000\n",
                              "hours = 680\n[[condition]]\nname = \"late\"\ndaylight = \"none\"\n[[condition]]\nname = "
                              "\"day\"\ndaylight = { sky = \"overcast\", horizontalIlluminance = \"8 klx\" }\n"));
  ASSERT_TRUE(s.read) << s.read.error();
  EXPECT_DOUBLE_EQ(s.study().conditions[0].hoursPerYear, 680);
  EXPECT_DOUBLE_EQ(s.study().conditions[1].hoursPerYear, 1000);  // 1680 of the dark less 680
  EXPECT_DOUBLE_EQ(s.study().conditions[2].hoursPerYear, 1820);
  EXPECT_EQ(s.study().conditions[2].daylight["sky"], "overcast");
}

TEST(StudyFile, ATunableLuminaireHasStepsBetweenItsEnds) {
  const SmallStudy s(kStudy, replaced(kCatalogue, "kelvin = \"3000 K\"", "tunable = [\"2500 K\", \"3600 K\"]"));
  ASSERT_TRUE(s.read) << s.read.error();
  EXPECT_EQ(s.study().catalogue.luminaires[0].kelvin, (std::vector<double>{2500, 2700, 3000, 3500, 3600}));
}

TEST(StudyFile, AWeatherFileIsFoundFromAnywhere) {
  const SmallStudy s(replaced(kStudy, "daylight = \"none\"",
                              "daylight = { weather = \"year.epw\", time = \"2026-01-20T12:00+01:00\" }"));
  ASSERT_TRUE(s.read) << s.read.error();
  EXPECT_EQ(s.study().conditions[0].daylight["weather"], (s.folder() / "year.epw").string());
}

struct Wrong {
  const char* what;
  const char* by;
  int line;
  const char* says;
};

TEST(StudyFile, SaysInWhichLineWhatIsWrong) {
  const Wrong wrong[] = {
      {"uniformity = 0.4", "uniformness = 0.4", 12, "unknown key 'uniformness'"},
      {"mean = \"100 lx\"", "mean = 100", 11, "has no unit; write \"100 lx\""},
      {"mean = \"100 lx\"", "mean = \"100 lm\"", 11, "lx"},
      {"room = \"Room\"", "room = \"Attic\"", 10, "there is no room 'Attic'; there are 'Room'"},
      {"\"Bulb\", \"Spot\"", "\"Bulb\", \"Sopt\"", 23,
       "there is no 'Sopt' in the catalogue; there are 'Bulb', 'Spot', 'Wall light'"},
      {"\"Bulb\", \"Spot\"", "\"Wall light\"", 23, "'Wall light' is not for mounting on a ceiling"},
      {"aims = [\"up\", \"out\"]", "aims = [\"sideways\"]", 32, "aims[0]: must be one of"},
      {"\"cost\"]", "\"cost\", \"beauty\"]", 3, "must be one of"},
      {"catalogue = \"catalogue.toml\"", "catalogue = \"gone.toml\"", 2, "gone.toml: no such file"},
      {"lookAt = [4, 1.2, 2]\n", "", 14, "needs one of 'lookAt' and 'direction'"},
      {"spacing = 1.5", "spacing = -1.5", 24, "must be from"},
      {"spacing = 1.5", "spacing = ", 24, "is no TOML"},
      {"hours = 1000", "hours = 10000", 7, "must be from 0 to 8784"},
      {"hours = 1000", "weight = 0", 4, "all have weight 0"},
      {"spacing = 1.5", "at = [[1, 0, 1], [7, 0, 1]]", 24, "at[1]: lies outside of 'Room'"},
      {"height = 1.8", "at = [[0.1, 3, 1]]", 34, "its height must be between floor and ceiling"},
  };
  for (const Wrong& w : wrong) {
    const SmallStudy s(replaced(kStudy, w.what, w.by));
    ASSERT_FALSE(s.read) << w.by;
    EXPECT_NE(s.read.error().find(fmt::format("study.toml:{}: ", w.line)), std::string::npos)
        << w.by << " gave: " << s.read.error();
    EXPECT_NE(s.read.error().find(w.says), std::string::npos) << s.read.error();
    EXPECT_EQ(s.read.error().find('\n'), std::string::npos);
  }
}

TEST(Catalogue, SaysInWhichLineWhatIsWrong) {
  const Wrong wrong[] = {
      {"watts = 8\n", "", 3, "has no 'watts'"},
      {"flux = \"800 lm\"", "flux = \"800 cd\"", 6, "luminaire[0].flux"},
      {"beam = 60", "beam = 600", 17, "must be from 2 to 90"},
      {"name = \"Spot\"", "name = \"Bulb\"", 13, "the name 'Bulb' is there twice"},
      {"mounting = [\"wall\"]", "mounting = [\"roof\"]", 31, "'roof'"},
      {"type = \"point\"", "type = \"photometric\"\nfile = \"gone.ies\"", 6, "gone.ies"},
  };
  for (const Wrong& w : wrong) {
    const SmallStudy s(kStudy, replaced(kCatalogue, w.what, w.by));
    ASSERT_FALSE(s.read) << w.by;
    EXPECT_NE(s.read.error().find(fmt::format("catalogue.toml:{}: ", w.line)), std::string::npos)
        << w.by << " gave: " << s.read.error();
    EXPECT_NE(s.read.error().find(w.says), std::string::npos) << s.read.error();
  }
}

}  // namespace
}  // namespace roomlight::optimise
