// `roomlight measure` from outside.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "unit/cli/program.h"

namespace roomlight {
namespace {

using testing::ProgramRun;
using testing::readFile;
using testing::runProgram;
using testing::TemporaryFolder;
using testing::writeFile;

TEST(MeasureCommand, findsTheRoomAndWritesEveryReport) {
  const TemporaryFolder folder;
  const ProgramRun run = runProgram({"measure", testing::writeRoom(folder), "--quality", "draft", "--tolerance", "5%",
                                     "--json", folder / "m.json", "--csv", folder / "m.csv"});
  ASSERT_EQ(run.exitStatus, 0) << run.err;
  for (const char* word : {"mean lx", "Room 1, work plane", "U0"})
    EXPECT_NE(run.out.find(word), std::string::npos) << word << "\n" << run.out;
  const auto j = nlohmann::json::parse(readFile(folder / "m.json"));
  ASSERT_EQ(j["grids"].size(), 1u);
  EXPECT_NEAR(j["rooms"][0]["areaM2"].get<double>(), 16, 0.5);
  const auto& lux = j["grids"][0]["illuminanceLux"];
  EXPECT_GT(lux["min"].get<double>(), 0);  // no point is in the pillar
  EXPECT_GT(lux["mean"].get<double>(), lux["min"].get<double>());
  EXPECT_EQ(j["technique"], "hybrid");
  const std::string csv = readFile(folder / "m.csv");
  EXPECT_EQ(static_cast<size_t>(std::count(csv.begin(), csv.end(), '\n')),
            1 + lux["points"].get<size_t>() + j["grids"][0]["leftOut"].size());
  EXPECT_EQ(j["luminaires"][0]["name"], "Bulb");
  EXPECT_EQ(j["luminaires"][0]["room"], "Room 1");
  EXPECT_DOUBLE_EQ(j["home"]["meanOfAreaLux"].get<double>(), lux["mean"].get<double>());
  EXPECT_EQ(j["roomTargets"][0]["useFrom"], "assumed");
}

// The bulb of 200 cd is 2.5 m up: direct light alone is 200 / 2.5² = 32 lx on the floor below it.
TEST(MeasureCommand, pointMetersShowLuxAndExposure) {
  const TemporaryFolder folder;
  const ProgramRun run = runProgram({"measure", testing::writeRoom(folder), "--technique", "path", "--point",
                                     "0,0.001,0", "--point", "0,2.999,0", "--json", folder / "m.json", "--quiet"});
  ASSERT_EQ(run.exitStatus, 0) << run.err;
  EXPECT_TRUE(run.err.empty()) << run.err;
  const auto j = nlohmann::json::parse(readFile(folder / "m.json"));
  ASSERT_EQ(j["points"].size(), 2u);
  const double below = j["points"][0]["illuminanceLux"].get<double>(),
               onTop = j["points"][1]["illuminanceLux"].get<double>();
  EXPECT_GT(below, 32);
  EXPECT_LT(below, 100);
  // It looks at the ceiling a millimetre above: its albedo, 0.614, times 200 / 0.5² lx from the bulb, and a little more
  // from the room.
  EXPECT_GT(onTop, 0.99 * 0.614 * 800);
  EXPECT_LT(onTop, 1.1 * 0.614 * 800);
  EXPECT_NEAR(j["points"][0]["ev100"].get<double>(), std::log2(below / 2.5), 1e-6);
}

TEST(MeasureCommand, meterFileNamesRoomsAndTargets) {
  const TemporaryFolder folder;
  writeFile(
      folder / "meters.json",
      R"({"rooms": [{"name": "Hall", "floor": [[-2, -2], [-2, 2], [2, 2], [2, -2]], "height": 3, "watts": 20, "target": "1 lx", "uniformity": 1, "powerDensity": 6}],
    "spots": [{"name": "Wall", "position": [0, 1.5, 1], "direction": [-1, 0, 0], "angle": 5}], "glare": [{"name": "Chair", "position": [0, 1.2, 1.9], "direction": [0, 0, -1]}]})");
  const ProgramRun run = runProgram({"measure", testing::writeRoom(folder), "--meters", folder / "meters.json",
                                     "--quality", "draft", "--tolerance", "2%"});
  ASSERT_EQ(run.exitStatus, 0) << run.err;
  for (const char* word :
       {"Hall, work plane", "met", "MISSED", "<= 6.00 W/m²", "1.25 W/m²", "Wall", "cd/m²", "Chair", "UGR"})
    EXPECT_NE(run.out.find(word), std::string::npos) << word << "\n" << run.out;
}

TEST(MeasureCommand, htmlReportStandsAloneWithDaylight) {
  const TemporaryFolder folder;
  const ProgramRun run = runProgram({"measure", testing::writeRoom(folder), "--quality", "draft", "--tolerance", "10%",
                                     "--daylight-factor", "--html", folder / "m.html"});
  ASSERT_EQ(run.exitStatus, 0) << run.err;
  EXPECT_NE(run.out.find("mean DF %"), std::string::npos) << run.out;
  const std::string html = readFile(folder / "m.html");
  for (const char* part :
       {"<!doctype html>", "Room 1, work plane", "class=\"map\"", "class=\"contour\"", "class=\"lamp\"",
        "class=\"legend\"", "class=\"plan\"", "src=\"data:image/jpeg;base64,/9j/", "Luminaire schedule", "</html>"})
    EXPECT_NE(html.find(part), std::string::npos) << part;
  for (const char* part : {"<script", "src=\"http", "href=", ">nan", ">inf", "-2147483648"})
    EXPECT_EQ(html.find(part), std::string::npos) << part;
  EXPECT_LT(html.size(), size_t{2'000'000});
}

TEST(MeasureCommand, theReportIsWithoutAPictureWhereThatIsAsked) {
  const TemporaryFolder folder;
  const ProgramRun run = runProgram({"measure", testing::writeRoom(folder), "--quality", "draft", "--tolerance", "10%",
                                     "--no-picture", "--html", folder / "m.html"});
  ASSERT_EQ(run.exitStatus, 0) << run.err;
  EXPECT_EQ(run.err.find("picture"), std::string::npos) << run.err;
  EXPECT_EQ(readFile(folder / "m.html").find("<img"), std::string::npos);
}

// The pillar of the room is 0.4 m wide, at x = 0.8.
TEST(MeasureCommand, metersInFurnitureAreToldInOneLine) {
  const TemporaryFolder folder;
  const ProgramRun run = runProgram({"measure", testing::writeRoom(folder), "--quality", "draft", "--tolerance", "10%",
                                     "--point", "0.8,1,0", "--point", "0,1,1", "--json", folder / "m.json"});
  ASSERT_EQ(run.exitStatus, 0) << run.err;
  EXPECT_NE(run.err.find("warning: in furniture: 1 meter, read but not judged ('point 1')\n"), std::string::npos)
      << run.err;
  EXPECT_NE(run.out.find("point 1 (furniture)"), std::string::npos) << run.out;
  const auto j = nlohmann::json::parse(readFile(folder / "m.json"));
  EXPECT_EQ(j["points"][0]["place"], "furniture");
  EXPECT_EQ(j["points"][1]["place"], "free");
}

TEST(MeasureCommand, renderShowsLuminance) {
  const TemporaryFolder folder;
  const std::string room = testing::writeRoom(folder);
  EXPECT_EQ(runProgram({"render", room, "--size", "64x48", "--quality", "draft", "--quiet", "--output-kind",
                        "falsecolour", "-o", folder / "f.png"})
                .exitStatus,
            0);
  EXPECT_EQ(runProgram({"render", room, "--size", "64x48", "--quality", "draft", "--quiet", "--output-kind",
                        "luminance", "-o", folder / "l.png", "-o", folder / "l.exr"})
                .exitStatus,
            0);
  const ProgramRun wrong = runProgram({"render", room, "--output-kind", "falsecolour", "-o", folder / "f.exr"});
  EXPECT_EQ(wrong.exitStatus, 2);
  EXPECT_NE(wrong.err.find("use .png"), std::string::npos) << wrong.err;
  EXPECT_EQ(runProgram({"render", room, "--output-kind", "x", "-o", folder / "f.png"}).exitStatus, 2);
}

TEST(MeasureCommand, whatIsWrongIsOneLineAndExitStatusTwo) {
  const TemporaryFolder folder;
  const std::string room = testing::writeRoom(folder);
  writeFile(folder / "bad.json", R"({"points": [{"name": "A"}]})");
  const std::pair<std::vector<std::string>, const char*> cases[] = {
      {{"--point", "1,2"}, "--point 1,2: write x,y,z"},
      {{"--point", "1,2,3,0,0,0"}, "the normal must not be zero"},
      {{"--eye", "1,2,3"}, "--eye and --view: give both"},
      {{"--tolerance", "0"}, "--tolerance 0"},
      {{"--technique", "magic"}, "unknown technique 'magic'"},
      {{"--meters", folder / "bad.json"}, "points[0]: 'position' is missing"},
      {{"--meters", folder / "none.json"}, "none.json"},
      {{"--json", folder / "a.json", "--csv", folder / "a.json"}, "is named twice"},
      {{"--json", folder / "no/a.json"}, "cannot be written"},
  };
  for (const auto& [arguments, expected] : cases) {
    std::vector<std::string> all = {"measure", room, "--quiet"};
    all.insert(all.end(), arguments.begin(), arguments.end());
    const ProgramRun run = runProgram(all);
    EXPECT_EQ(run.exitStatus, 2) << expected;
    EXPECT_EQ(std::count(run.err.begin(), run.err.end(), '\n'), 1) << run.err;
    EXPECT_NE(run.err.find(expected), std::string::npos) << run.err;
  }
}

}  // namespace
}  // namespace roomlight
