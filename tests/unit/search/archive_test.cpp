#include "search/archive.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/random.h"
#include "search/front.h"

namespace roomlight::search {
namespace {

Archive emptyArchive(size_t objectives, size_t limit) {
  Archive archive;
  archive.limit = limit;
  archive.objectivesEach = objectives;
  archive.designs.integersEach = 1;
  return archive;
}

// Designs whose one integer says which point they are.
Genomes numbered(size_t count) {
  Genomes designs;
  designs.integersEach = 1;
  designs.resize(count);
  for (size_t i = 0; i < count; ++i) designs.integers[i] = static_cast<int32_t>(i);
  return designs;
}

std::vector<double> randomPoints(size_t count, size_t objectives, int steps) {
  Rng rng(0, count, objectives);
  std::vector<double> points(count * objectives);
  // Few steps, so that some are equal.
  for (double& p : points) p = std::floor(static_cast<double>(rng.uniform()) * steps) / steps;
  return points;
}

TEST(Archive, keepsExactlyWhatIsNotDominated) {
  for (size_t m : {2, 3, 4}) {
    const size_t count = 300;
    const std::vector<double> points = randomPoints(count, m, 12);
    Archive archive = emptyArchive(m, 10'000);
    add(archive, numbered(count), points);
    const auto point = [&](size_t i) { return std::span(points).subspan(i * m, m); };
    std::vector<int32_t> expected;
    for (size_t i = 0; i < count; ++i) {
      bool stays = true;
      for (size_t j = 0; j < count; ++j)
        stays &= !dominates(point(j), point(i)) &&
                 !(j < i && std::equal(point(j).begin(), point(j).end(), point(i).begin()));
      if (stays) expected.push_back(static_cast<int32_t>(i));
    }
    EXPECT_EQ(archive.designs.integers, expected) << m;
    for (size_t i = 0; i < archive.size(); ++i)
      EXPECT_TRUE(std::equal(archive.objectivesOf(i).begin(), archive.objectivesOf(i).end(),
                             point(static_cast<size_t>(expected[i])).begin()));
  }
}

TEST(Archive, thinsEvenlyAndKeepsTheEnds) {
  // A line with a crowd of points at one end.
  std::vector<double> points;
  for (int i = 0; i <= 100; ++i) {
    const double x = i <= 90 ? i * 0.001 : 0.09 + (i - 90) * 0.091;
    points.insert(points.end(), {x, 1 - x});
  }
  Archive archive = emptyArchive(2, 1000);
  add(archive, numbered(101), points);
  ASSERT_EQ(archive.size(), 101u);
  thin(archive, 12);
  ASSERT_EQ(archive.size(), 12u);
  const auto order = sorted(archive);
  EXPECT_EQ(archive.objectivesOf(order.front())[0], 0);
  EXPECT_NEAR(archive.objectivesOf(order.back())[0], 1, 1e-12);
  for (size_t i = 1; i < 12; ++i) {
    const double gap = archive.objectivesOf(order[i])[0] - archive.objectivesOf(order[i - 1])[0];
    EXPECT_GT(gap, 0.04);
    EXPECT_LT(gap, 0.1);
  }
}

TEST(Archive, isThinnedOnceAFifthOverItsLimit) {
  Archive archive = emptyArchive(2, 50);
  std::vector<double> points;
  for (int i = 0; i < 61; ++i) points.insert(points.end(), {i * 1.0, -i * 1.0});
  add(archive, numbered(60), std::span(points).first(120));
  EXPECT_EQ(archive.size(), 60u);
  Genomes last = numbered(61);
  add(archive, last, points);  // one of them is new
  EXPECT_EQ(archive.size(), 50u);
}

TEST(Ranking, agreesWithPeelingFrontsOff) {
  for (size_t m : {2, 3}) {
    const size_t count = 200;
    const std::vector<double> points = randomPoints(count, m, 15);
    const auto point = [&](size_t i) { return std::span(points).subspan(i * m, m); };
    const Ranking ranking = rankPoints(points, m);
    std::vector<char> gone(count, 0);
    for (uint32_t rank = 0, left = count; left > 0; ++rank) {
      std::vector<size_t> front;
      for (size_t i = 0; i < count; ++i) {
        bool beaten = gone[i];
        for (size_t j = 0; j < count && !beaten; ++j) beaten = !gone[j] && dominates(point(j), point(i));
        if (!beaten) front.push_back(i);
      }
      ASSERT_FALSE(front.empty());
      for (size_t i : front) {
        EXPECT_EQ(ranking.rank[i], rank);
        gone[i] = 1, --left;
      }
    }
  }
}

TEST(Ranking, crowdingIsFiniteWhereAnObjectiveIsConstant) {
  const std::vector<double> points{0, 5, 1, 5, 2, 5, 0, 5};
  for (double c : rankPoints(points, 2).crowding) EXPECT_FALSE(std::isnan(c));
  // Three on one front: the middle one's neighbours span the whole range in both objectives.
  const Ranking three = rankPoints(std::vector<double>{0, 2, 1, 1, 2, 0}, 2);
  EXPECT_EQ(three.crowding[1], 2);
  EXPECT_TRUE(std::isinf(three.crowding[0]) && std::isinf(three.crowding[2]));
}

}  // namespace
}  // namespace roomlight::search
