#include "optimise/candidates.h"

#include <set>

#include "scene/outline.h"
#include "unit/optimise/small_study.h"

namespace roomlight::optimise {
namespace {

using testing::kStudy;
using testing::replaced;
using testing::SmallProblem;
using testing::SmallStudy;

TEST(Candidates, HangBelowTheCeilingAndKeepFromWalls) {
  const SmallProblem p;
  size_t ceiling = 0;
  for (const Candidate& c : p.candidates.candidates) {
    const Place& place = p.candidates.places[c.place];
    if (p.file.study().places[place.rule].on != Mounting::Ceiling) continue;
    ++ceiling;
    const Luminaire& l = p.file.study().catalogue.luminaires[c.luminaire];
    EXPECT_NEAR(c.position.y, 2.6 - l.dropM, 1e-4);
    EXPECT_GE(distanceToEdgeM(p.file.home.rooms[0].floor, {c.position.x, c.position.z}), 0.8 - 1e-4);
    EXPECT_NEAR(c.direction.y, -1, 1e-6);
  }
  EXPECT_EQ(ceiling, 2 * 3 * 2u);  // 5 - 1.6 = 3.4 m: three places; 2.4 m: two; two luminaires
}

TEST(Candidates, OnWallsFaceTheRoom) {
  const SmallProblem p;
  std::set<std::string> aims;
  for (const Candidate& c : p.candidates.candidates) {
    const Place& place = p.candidates.places[c.place];
    if (p.file.study().places[place.rule].on != Mounting::Wall) continue;
    aims.insert(c.aim);
    EXPECT_NEAR(c.position.y, 1.8, 1e-5);
    EXPECT_NEAR(distanceToEdgeM(p.file.home.rooms[0].floor, {c.position.x, c.position.z}), 0.1, 1e-3);
    EXPECT_TRUE(contains(p.file.home.rooms[0].floor, {c.position.x, c.position.z}));
    if (c.aim == "out") {
      EXPECT_GT(dot(c.direction, Vec3{2.5f, 1.8f, 2} - c.position), 0);
    }
  }
  EXPECT_EQ(aims, (std::set<std::string>{"out", "up"}));
}

TEST(Candidates, StandOnTheTableAndNowhereElse) {
  const SmallProblem p(replaced(
      kStudy, "on = \"ceiling\"\nroom = \"Room\"\nluminaires = [\"Bulb\", \"Spot\"]\nspacing = 1.5\nfromWalls = 0.8",
      "on = \"table\"\nroom = \"Room\"\nluminaires = [\"Bulb\"]\nspacing = 0.2\nfromWalls = 0.1"));
  size_t onTable = 0;
  for (const Candidate& c : p.candidates.candidates) {
    const Place& place = p.candidates.places[c.place];
    if (p.file.study().places[place.rule].on != Mounting::Table) continue;
    ++onTable;
    EXPECT_NEAR(place.mount.y, 0.7, 1e-3);
    EXPECT_TRUE(c.position.x > 3.8f && c.position.x < 4.8f && c.position.z > 0.1f && c.position.z < 0.9f);
  }
  EXPECT_GT(onTable, 3u);
}

TEST(Candidates, AreLeftOutInsideThings) {
  SmallStudy s(
      replaced(kStudy, "luminaires = [\"Bulb\", \"Spot\"]", "luminaires = [\"Bulb\"]\nat = [[1, 0, 1], [2.5, 0, 2]]"));
  ASSERT_TRUE(s.read) << s.read.error();
  // A cupboard up to the ceiling around the first place.
  addBox(s.home, {0.6f, 0, 0.6f}, {1.4f, 2.55f, 1.4f}, 0);
  const RayScene rays(s.home);
  const auto c = findCandidates(s.study(), rays);
  ASSERT_TRUE(c) << c.error();
  size_t bulbs = 0;
  for (const Candidate& x : c.value().candidates) {
    if (x.luminaire != 0) continue;
    ++bulbs;
    EXPECT_NEAR(x.position.x, 2.5, 1e-4);
  }
  EXPECT_EQ(bulbs, 1u);
  EXPECT_EQ(c.value().inThings + c.value().tooNear, 1u);
}

TEST(Candidates, TooNearPlacesAreInConflict) {
  const SmallProblem p(replaced(kStudy, "spacing = 1.5", "spacing = 0.4"));
  size_t pairs = 0;
  for (size_t a = 0; a < p.candidates.places.size(); ++a) {
    for (const uint32_t b : p.candidates.conflicts[a]) {
      ++pairs;
      EXPECT_LT(length(p.candidates.places[a].mount - p.candidates.places[b].mount), 0.5f);
      const auto& back = p.candidates.conflicts[b];
      EXPECT_NE(std::find(back.begin(), back.end(), a), back.end());
    }
  }
  EXPECT_GT(pairs, 0u);
}

TEST(Candidates, HangFromALoweredCeilingButNotFromWhatHangsThere) {
  SmallStudy s(replaced(kStudy, "spacing = 1.5", "at = [[1, 0, 1], [2.5, 0, 2]]"));
  ASSERT_TRUE(s.read) << s.read.error();
  addBox(s.home, {0, 2.2f, 0}, {2, 2.59f, 2}, 0);          // a lowered part, 40 cm
  addBox(s.home, {2.4f, 2.2f, 1.9f}, {2.6f, 2.59f, 2.1f}, 0);  // a lamp of the home
  const RayScene rays(s.home);
  const auto c = findCandidates(s.study(), rays);
  ASSERT_TRUE(c) << c.error();
  size_t ceiling = 0;
  for (const Place& place : c.value().places) {
    if (s.study().places[place.rule].on != Mounting::Ceiling) continue;
    ++ceiling;
    EXPECT_NEAR(place.mount.x, 1, 1e-4);
    EXPECT_NEAR(place.mount.y, 2.2, 1e-3);
  }
  EXPECT_EQ(ceiling, 1u);
}

TEST(Candidates, HangOnWallsAsHighAsTheyWereAskedFor) {
  const SmallProblem p(replaced(kStudy, "height = 1.8", "at = [[0.1, 1.4, 1.5], [2, 2, 3.9]]"));
  std::vector<Vec3> mounts;
  for (const Place& place : p.candidates.places) {
    if (p.file.study().places[place.rule].on == Mounting::Wall) mounts.push_back(place.mount);
  }
  ASSERT_EQ(mounts.size(), 2u);
  EXPECT_NEAR(length(mounts[0] - Vec3{0, 1.4f, 1.5f}), 0, 1e-3);
  EXPECT_NEAR(length(mounts[1] - Vec3{2, 2, 4}), 0, 1e-3);
}

TEST(Candidates, AnEndlessGridIsRefusedWithItsLine) {
  const SmallStudy s(replaced(kStudy, "room = \"Room\"\nluminaires = [\"Bulb\", \"Spot\"]\nspacing = 1.5",
                              "room = \"Hall\"\nfloor = [[0, 0], [900, 0], [900, 900], [0, 900]]\nluminaires = "
                              "[\"Bulb\", \"Spot\"]\nspacing = 0.1"));
  ASSERT_TRUE(s.read) << s.read.error();
  const RayScene rays(s.home);
  const auto c = findCandidates(s.study(), rays);
  ASSERT_FALSE(c);
  EXPECT_NE(c.error().find("study.toml:19: place 'Ceiling': its grid has more than 100000 places"), std::string::npos)
      << c.error();
}

TEST(Meters, TooManyPointsAreRefusedWithTheirLine) {
  const SmallStudy s(replaced(kStudy, "room = \"Room\"\nmean",
                              "room = \"Hall\"\nfloor = [[0, 0], [900, 0], [900, 900], [0, 900]]\nmean"));
  ASSERT_TRUE(s.read) << s.read.error();
  const RayScene rays(s.home);
  const auto m = placeMeters(s.study(), rays);
  ASSERT_FALSE(m);
  EXPECT_NE(m.error().find("study.toml:8: zone 'Room': there are more than 20000 points"), std::string::npos)
      << m.error();
}

TEST(Candidates, AnErrorNamesTheRuleThatHasNoPlace) {
  const SmallStudy s(replaced(kStudy, "fromWalls = 0.8", "fromWalls = 3"));
  ASSERT_TRUE(s.read) << s.read.error();
  const RayScene rays(s.home);
  const auto c = findCandidates(s.study(), rays);
  ASSERT_FALSE(c);
  EXPECT_NE(c.error().find("study.toml:19: place 'Ceiling'"), std::string::npos) << c.error();
}

}  // namespace
}  // namespace roomlight::optimise
