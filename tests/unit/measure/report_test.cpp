#include "measure/report.h"

#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

namespace roomlight {
namespace {

Measurements sample() {
  Measurements m;
  GridReading g;
  g.name = "Study, \"work\" plane", g.room = "Study";
  g.targets = {Target{500, "EN 12464-1"}, Target{0.6, "EN 12464-1"}, {}, {}};
  g.points.lattice.columns = 3, g.points.lattice.rows = 1, g.points.lattice.used = {1, 0, 1};
  g.points.lux = {400, std::nanf(""), 800};
  m.grids.push_back(g);
  RoomReading r;
  r.room.name = "Study", r.areaM2 = 10, r.lamps = 1, r.wattsW = 90, r.targets.wattsPerM2 = Target{6, "test"};
  m.rooms.push_back(r);
  return m;
}

TEST(Report, roundsToThreeDigits) {
  EXPECT_EQ(threeDigits(1234.5), "1230");
  EXPECT_EQ(threeDigits(123.45), "123");
  EXPECT_EQ(threeDigits(12.345), "12.3");
  EXPECT_EQ(threeDigits(0.01234), "0.0123");
  EXPECT_EQ(threeDigits(99.96), "100");
  EXPECT_EQ(threeDigits(0), "0");
}

TEST(Report, judgesTargets) {
  const std::vector<Verdict> v = verdictsOf(sample());
  ASSERT_EQ(v.size(), 3u);
  EXPECT_TRUE(v[0].met());  // 600 lx on average
  EXPECT_TRUE(v[1].met());  // U0 = 0.667
  EXPECT_FALSE(v[2].met()); // 9 W/m²
  Measurements old = sample();
  old.maintenanceFactor = 0.8;
  EXPECT_FALSE(verdictsOf(old)[0].met());
  old.rooms[0].lampsWithoutWatts = 1;
  EXPECT_EQ(verdictsOf(old).size(), 2u);  // what is not stated is not judged
}

TEST(Report, jsonHoldsEveryReading) {
  const auto j = nlohmann::json::parse(reportJson({}, sample()));
  EXPECT_EQ(j["grids"][0]["lux"].size(), 3u);
  EXPECT_TRUE(j["grids"][0]["lux"][1].is_null());
  EXPECT_EQ(j["grids"][0]["illuminanceLux"]["mean"], 600);
  EXPECT_EQ(j["targets"][2]["met"], false);
}

TEST(Report, csvQuotesNames) {
  const std::string csv = reportCsv(sample());
  EXPECT_NE(csv.find("grid,\"Study, \"\"work\"\" plane\",Study,0.5000"), std::string::npos) << csv;
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 3);
}

TEST(Report, tableSaysWhatWasMissed) {
  const std::string table = reportTable(sample());
  for (const char* word : {"600", "0.67", "MISSED", "met", "<= 6.00 W/m²"}) EXPECT_NE(table.find(word), std::string::npos) << word << "\n"
                                                                                                                           << table;
}

}  // namespace
}  // namespace roomlight
