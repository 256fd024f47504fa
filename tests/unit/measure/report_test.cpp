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

TEST(Report, whatStandsWhereNoMeterBelongsIsMarked) {
  Measurements m = sample();
  m.grids[0].leftOut = {{1, MeterPlace::Wall}};
  m.points.push_back({{"Drawer", {}, {}}, 3, 0, std::nullopt, MeterPlace::Furniture});
  const std::string csv = reportCsv(m), table = reportTable(m), html = reportHtml({}, m, {});
  EXPECT_NE(csv.find("1.5000,0.0000,0.5000,0.0000,1.0000,0.0000,illuminance,lx,,wall\r\n"), std::string::npos) << csv;
  EXPECT_NE(csv.find("illuminance,lx,400,free\r\n"), std::string::npos) << csv;
  EXPECT_NE(csv.find("illuminance,lx,3,furniture\r\n"), std::string::npos) << csv;
  EXPECT_NE(table.find("Drawer (furniture)"), std::string::npos) << table;
  const auto j = nlohmann::json::parse(reportJson({}, m));
  EXPECT_EQ(j["grids"][0]["leftOut"][0]["cell"], 1);
  EXPECT_EQ(j["grids"][0]["leftOut"][0]["place"], "wall");
  EXPECT_EQ(j["points"][0]["place"], "furniture");
  for (const char* part :
       {"Drawer <span class=\"soft\">(furniture)</span>", "2 <span class=\"soft\">of 3</span>",
        "in a wall, floor or ceiling: 1 point of grids left out of means and minima (1 of &#39;Study"}) {
    EXPECT_NE(html.find(part), std::string::npos) << part;
  }
}

TEST(Report, htmlIsWhatAPlannerHandsOver) {
  Measurements m = sample();
  m.grids[0].areaM2 = 10;
  m.rooms[0].room.floor = {{0, 0}, {0, 2}, {5, 2}, {5, 0}};
  Luminaire l;
  l.name = "Desk <lamp>", l.kind = "photometric", l.room = "Study", l.fluxLm = 900, l.wattsW = 9, l.kelvin = 2990,
  l.position = {1, 1, 1};
  m.luminaires = {l, l};
  m.certainty = {2, 0.02, 0.008};
  ReportHeader h;
  h.scene = "homes/flat.sh3d", h.technique = "hybrid", h.quality = "good", h.version = "9.9", h.date = "3 May 2031",
  h.pictureJpeg = "JPEG", h.pictureOf = "View from 'A & B'";
  const std::string html = reportHtml(h, m, {});
  // Twice 900 lm at 9 W: a hundred lumen a watt.
  for (const char* part :
       {"<p class=\"project\">flat</p>", "3 May 2031", "roomlight 9.9, hybrid, good",
        "src=\"data:image/jpeg;base64,SlBFRw==\"", "A &amp; B", "class=\"plan\"", "Targets by room", "by its name",
        "≥ 500 lx", "Luminaire schedule", "Desk &lt;lamp&gt;", "<td>100</td><td>3000</td>", "1800 lm", "18.0 W",
        "What these figures are worth", "was off by at most 1.5 %", "Not modelled"}) {
    EXPECT_NE(html.find(part), std::string::npos) << part;
  }
  for (const char* part : {"<script", "src=\"http", "href="}) EXPECT_EQ(html.find(part), std::string::npos) << part;
  h.pictureJpeg.clear();
  EXPECT_EQ(reportHtml(h, m, {}).find("<img"), std::string::npos);
}

TEST(Report, tableSaysWhatWasMissed) {
  const std::string table = reportTable(sample());
  for (const char* word : {"600", "0.67", "MISSED", "met", "<= 6.00 W/m²"})
    EXPECT_NE(table.find(word), std::string::npos) << word << "\n" << table;
}

}  // namespace
}  // namespace roomlight
