// Damaged and malicious homes: one line of error, or a warning and the rest of the home.
#include <gtest/gtest.h>

#include <cmath>

#include "import/sh3d_archive.h"
#include "import/sh3d_wall_parts.h"
#include "unit/import/sh3d_file.h"

namespace roomlight {
namespace {

using namespace testing;
using namespace importers;

void expectRefused(const std::string& bytes, const std::string& because) {
  const Result<Imported> r = importBytes(bytes);
  ASSERT_FALSE(r.ok()) << because;
  EXPECT_NE(r.error().find(because), std::string::npos) << r.error();
  EXPECT_EQ(r.error().find('\n'), std::string::npos);
  EXPECT_LT(r.error().size(), 700u);
}
void expectXmlRefused(const std::string& xml, const std::string& because) {
  expectRefused(zipped({{"Home.xml", xml}}), because);
}

const std::string kWall = wallXml("w", 0, 0, 400, 0, 10);

TEST(HostileSh3d, whatIsNoHomeSaysSo) {
  expectRefused("", "holds no Home.xml");
  expectRefused("hello", "no zip file");
  expectRefused(zipped({{"readme.txt", "x"}}), "holds no Home.xml");
  expectRefused(zipped({{"Home", "\xac\xed"}}), "open it in Sweet Home 3D 5.3 or newer and save it again");
}

TEST(HostileSh3d, everyPrefixAndFlippedByteIsAnswered) {
  const std::string whole = zipped({{"Home.xml", homeXml(kWall)}, {"1", std::string(300, 'x')}});
  for (size_t n = 0; n < whole.size(); n += 7) {
    const Result<Imported> r = importBytes(whole.substr(0, n));
    EXPECT_TRUE(r.ok() || r.error().find('\n') == std::string::npos);
    std::string flipped = whole;
    flipped[n] = static_cast<char>(flipped[n] ^ 0x41);
    const Result<Imported> f = importBytes(flipped);
    EXPECT_TRUE(f.ok() || f.error().find('\n') == std::string::npos);
  }
}

TEST(HostileSh3d, bombsAreNotUnpacked) {
  const std::string bomb = zipped({{"Home.xml", std::string(100 << 20, ' ')}});
  EXPECT_LT(bomb.size(), 200'000u);
  expectRefused(bomb, "which no home does");
  // As a model it costs only that model.
  const Result<Imported> r =
      importHome(kWall + "<pieceOfFurniture name='p' x='0' y='0' width='10' depth='10' height='10' model='9'/>",
                 {{"9", std::string(100 << 20, '\0')}});
  ASSERT_TRUE(r.ok()) << r.error();
  EXPECT_NE(r.value().warnings[0].find("which no home does"), std::string::npos);
}

TEST(HostileSh3d, limitsOfArchivesCountTogether) {
  const std::string bytes = zipped({{"a", std::string(600, 'x')}, {"b", std::string(600, 'y')}});
  const std::span<const uint8_t> view(reinterpret_cast<const uint8_t*>(bytes.data()), bytes.size());
  const Archive few(view, "", {.entries = 2, .entryBytes = 1000, .totalBytes = 1000});
  EXPECT_TRUE(few.read("a").has_value());
  EXPECT_THROW(few.read("b"), std::runtime_error);
  EXPECT_THROW(Archive(view, "", {.entries = 1}), std::runtime_error);
  EXPECT_THROW(Archive(view, "", {.entryBytes = 100}).read("a"), std::runtime_error);
  EXPECT_FALSE(few.read("c").has_value());
}

TEST(HostileSh3d, namesThatClimbOutAreLeftOut) {
  EXPECT_EQ(normalisedEntryName("a//./b\\c"), "a/b/c");
  for (const char* name : {"../a", "a/../../b", "/etc/passwd", "\\a", "C:\\a", "", ".", "a/.."})
    EXPECT_EQ(normalisedEntryName(name), std::nullopt) << name;
  const Result<Imported> r = importHome(kWall, {{"../evil", "x"}, {"/abs", "x"}});
  ASSERT_TRUE(r.ok()) << r.error();
  EXPECT_NE(r.value().warnings[0].find("lead out of the file are left out (2 times)"), std::string::npos);
  // A model's companions cannot climb either: they are missing.
  const Result<Imported> climbing =
      importHome("<pieceOfFurniture name='p' x='0' y='0' width='10' depth='10' height='10' model='1/a.obj'/>",
                 {{"1/a.obj", "mtllib ../../x.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"}});
  ASSERT_TRUE(climbing.ok()) << climbing.error();
  EXPECT_NE(climbing.value().warnings[0].find("is missing, its materials are grey"), std::string::npos);
}

TEST(HostileSh3d, brokenXmlNamesItsLine) {
  expectXmlRefused("", "Home.xml");
  expectXmlRefused("<home>\n<wall\n</home>", "Home.xml: line 3");
  expectXmlRefused("<?xml version='1.0'?><house/>", "is not a home");
  expectXmlRefused(homeXml("\n" + wallXml("w7", 0, 0, 1, 1, 5, "height='tall'")),
                   "line 4: wall 'w7': height is 'tall'");
  expectXmlRefused(homeXml("<wall id='w'/>"), "xStart is missing");
  expectXmlRefused(homeXml(kWall + kWall), "is that of another wall");
  expectXmlRefused(homeXml(wallXml("w", 0, 0, 1, 1, 5, "level='nope'")), "names 'nope'");
  expectXmlRefused(homeXml(wallXml("w", 0, 0, 1, 1, 5, "leftSideColor='pink'")), "no colour");
  expectXmlRefused(homeXml("<room floorVisible='maybe'/>"), "neither true nor false");
  expectXmlRefused(
      homeXml("<pieceOfFurniture name='p' x='0' y='0' width='1' depth='1' height='1' modelRotation='1 0 0'/>"),
      "3 numbers instead of 9");
}

TEST(HostileSh3d, absurdNumbersAreRefused) {
  for (const char* v : {"NaN", "Infinity", "-Infinity", "1e30", "-1e30", "1e400", "0x10", "", "1 2", "1,5"}) {
    expectXmlRefused(
        homeXml("<wall id='w' xStart='" + std::string(v) + "' yStart='0' xEnd='1' yEnd='1' thickness='5'/>"),
        "xStart is ");
    expectXmlRefused(homeXml("<room><point x='0' y='" + std::string(v) + "'/></room>"), "y is ");
  }
  expectXmlRefused(homeXml(wallXml("w", 0, 0, 1, 1, -5)), "thickness is ");
  expectXmlRefused(
      homeXml(kWall +
              "<observerCamera attribute='observerCamera' x='0' y='0' z='0' yaw='0' pitch='0' fieldOfView='9'/>"),
      "fieldOfView is ");
}

TEST(HostileSh3d, deepNestingIsAnswered) {
  const auto nested = [](const std::string& name, size_t depth) {
    std::string out;
    for (size_t i = 0; i < depth; ++i) out += "<" + name + ">";
    for (size_t i = 0; i < depth; ++i) out += "</" + name + ">";
    return out;
  };
  expectXmlRefused(homeXml(nested("furnitureGroup", 1'000'000)), "nested more than 64 deep");
  EXPECT_TRUE(importHome(kWall + nested("x", 1'000'000)).ok());
}

// Small files whose things all cut each other: answered within seconds, and homes of many things are not refused.
TEST(HostileSh3d, workThatGrowsWithProductsEnds) {
  const auto many = [](int count, const auto& make) {
    std::string out;
    for (int i = 0; i < count; ++i) out += make(i);
    return out;
  };
  const auto walls = [](int i) {
    return wallXml("w" + std::to_string(i), 0, i % 7, 400, i % 7, 30, "arcExtent='0.5'");
  };
  const auto doors = [](int i) {
    return "<doorOrWindow name='d' x='" + std::to_string(i % 300) + "' y='5' width='90' depth='90' height='90'/>";
  };
  expectXmlRefused(homeXml(many(3000, doors) + many(3000, walls)), "more often than those of any home");
  const auto rooms = [](int i) { return roomXml({{0.01 * i, 0}, {400, 0}, {400, 300 - 0.01 * i}, {0, 300}}); };
  expectXmlRefused(homeXml(many(20000, rooms)), "more often than those of any home");
  const auto houses = [](int i) {
    const double x = i % 30 * 1000, y = i / 30 * 1000;
    const std::string n = std::to_string(i);
    return "<doorOrWindow name='d' x='" + std::to_string(x + 200) + "' y='" + std::to_string(y) +
           "' width='90' depth='20' height='90'/>" + wallXml("a" + n, x, y, x + 400, y, 10) +
           wallXml("b" + n, x, y, x, y + 300, 10) + roomXml({{x, y}, {x + 400, y}, {x + 400, y + 300}, {x, y + 300}});
  };
  EXPECT_TRUE(importHome(many(900, houses)).ok());
}

size_t drawnTriangles(const std::string& elements) { return homeScene(elements).triangleCount(); }

std::string refusal(const std::string& elements, size_t maxTriangles) {
  const Result<Imported> r = importBytes(zipped({{"Home.xml", homeXml(elements)}}), {.maxTriangles = maxTriangles});
  return r.ok() ? "none" : r.error();
}

std::string roundWalls(size_t count, const std::string& inside = "") {
  std::string out;
  for (size_t i = 0; i < count; ++i) {
    const std::string at = std::to_string(i % 1000 * 5000);
    out += "<wall id='w" + std::to_string(i) + "' xStart='0' yStart='" + at + "' xEnd='4000' yEnd='" + at +
           "' thickness='10' arcExtent='3'>" + inside + "</wall>";
  }
  return out;
}

// Walls are rounder than anybody sees: what they come to is told before any is made.
TEST(HostileSh3d, roundWallsHaveABudget) {
  const std::string boards = "<baseboard attribute='leftSideBaseboard' thickness='1' height='7'/>";
  constexpr size_t kGround = 2;
  for (const std::string& inside : {std::string(), boards}) {
    const size_t one = drawnTriangles(roundWalls(1, inside)) - kGround;
    EXPECT_GT(one, 500u);
    EXPECT_EQ(drawnTriangles(roundWalls(3, inside)), 3 * one + kGround);
    EXPECT_EQ(refusal(roundWalls(3, inside), 3 * one + kGround), "none");
    const std::string why = refusal(roundWalls(4, inside), 3 * one + kGround);
    EXPECT_NE(why.find("wall 'w3': would make " + std::to_string(one) + " triangles, " + std::to_string(4 * one) +
                       " with all before it; a home of more than"),
              std::string::npos)
        << why;
  }
  expectXmlRefused(homeXml(roundWalls(8000)), "is too fine");
}

TEST(HostileSh3d, whateverIsDrawnHasABudget) {
  const std::string light =
      "<light name='l' x='0' y='0' width='10' depth='10' height='10'>"
      "<lightSource x='0.5' y='0.5' z='0.5' color='FFFFFFFF' diameter='0.5'/></light>";
  const std::string line =
      "<polyline elevation='0' thickness='1' color='FF000000'><point x='0' y='0'/><point x='9' y='0'/><point x='9' "
      "y='9'/></polyline>";
  const std::string box = "<pieceOfFurniture name='p' x='0' y='0' width='10' depth='10' height='10'/>";
  const std::string room = roomXml({{0, 0}, {400, 0}, {400, 300}, {0, 300}});
  const std::pair<std::string, size_t> cases[] = {
      {light + light, 200}, {line, 14}, {box, 20}, {room, 14}};  // a wall has 12
  for (const auto& [what, most] : cases)
    EXPECT_NE(refusal(kWall + what, most).find("is too fine"), std::string::npos) << what;
}

// What takes no place takes no instance, but is worked out all the same.
TEST(HostileSh3d, piecesWithoutPlaceCountToo) {
  std::string model = "v 0 0 0\nv 1 0 0\nv 0 1 1\n", pieces;
  for (int i = 0; i < 100; ++i) model += "f 1 2 3\n";
  for (int i = 0; i < 50; ++i)
    pieces += "<pieceOfFurniture name='p' x='0' y='0' width='0' depth='10' height='10' model='1.obj'/>";
  const std::string bytes = zipped({{"Home.xml", homeXml(kWall + pieces)}, {"1.obj", model}});
  EXPECT_TRUE(importBytes(bytes, {.maxTriangles = 5000}).ok());
  const Result<Imported> r = importBytes(bytes, {.maxTriangles = 4999});
  ASSERT_FALSE(r.ok());
  EXPECT_NE(r.error().find("the home has more than 4999 triangles"), std::string::npos) << r.error();
}

std::string starRoom(size_t corners, size_t step, const std::string& more = "") {
  std::vector<std::pair<double, double>> points;
  for (size_t i = 0; i < corners; ++i) {
    const double angle = 2 * kPi * static_cast<double>(i * step % corners) / static_cast<double>(corners);
    points.emplace_back(500 + 400 * std::cos(angle), 500 + 400 * std::sin(angle));
  }
  return roomXml(points, more);
}

// Two million crossings, as many floors between them.
TEST(HostileSh3d, tanglesAreLeftOut) {
  const Result<Imported> r = importHome("<level id='c' name='c' elevation='-300' floorThickness='12' height='250'/>" +
                                        kWall + starRoom(2000, 999, "name='tangle'") +
                                        starRoom(2000, 997, "name='cellar' level='c'") + starRoom(5, 2, "name='star'"));
  ASSERT_TRUE(r.ok()) << r.error();
  EXPECT_TRUE(facesOf(r.value().scene, "tangle").empty());
  EXPECT_NEAR(areaFacing(r.value().scene, "star", {0, 1, 0}), 12.41, 0.01);  // without its middle
  ASSERT_EQ(r.value().scene.rooms.size(), 1u);
  bool told = false;
  for (const std::string& w : r.value().warnings)
    told = told || (w.find("crosses itself more than 1000 times are left out") != std::string::npos &&
                    w.find("room 'tangle'") != std::string::npos && w.find("room 'cellar'") != std::string::npos);
  EXPECT_TRUE(told);
}

TEST(HostileSh3d, tanglesOfDoorsAreRectangles) {
  std::string path = "M";
  for (size_t i = 0; i < 1999; ++i) {
    const double angle = 2 * kPi * static_cast<double>(i * 998 % 1999) / 1999;
    path += " " + std::to_string(0.5 + 0.5 * std::cos(angle)) + "," + std::to_string(0.5 + 0.5 * std::sin(angle));
  }
  const Result<Imported> r =
      importHome(kWall +
                 "<doorOrWindow name='d' x='200' y='0' width='90' depth='20' height='90' elevation='50' "
                 "cutOutShape='" +
                 path + "z'/>" +
                 "<pieceOfFurniture name='stairs' x='0' y='0' width='90' depth='90' height='300' "
                 "staircaseCutOutShape='" +
                 path + "z'/>" + roomXml({{0, 0}, {400, 0}, {400, 300}, {0, 300}}));
  ASSERT_TRUE(r.ok()) << r.error();
  EXPECT_NEAR(volumeM3(r.value().scene, "w"), (4 * 2.5 - 0.9 * 0.9) * 0.1, 1e-4);
  EXPECT_NE(r.value().warnings[0].find("cross themselves more than 1000 times are taken as rectangles"),
            std::string::npos);
}

TEST(HostileSh3d, namesAreNotCopiedWithoutEnd) {
  const Result<Imported> r = importHome("<pieceOfFurniture name='" + std::string(100'000, 'x') +
                                        "' x='0' y='0' width='10' depth='10' height='10'/>");
  ASSERT_TRUE(r.ok()) << r.error();
  for (const Instance& i : r.value().scene.instances) EXPECT_LT(i.name.size(), 300u);
}

TEST(HostileSh3d, degenerateThingsDoNoHarm) {
  const std::string flat = "<pieceOfFurniture name='p' x='0' y='0' width='0' depth='0' height='0'/>";
  const std::string nothing =
      "<doorOrWindow name='d' x='0' y='0' width='0' depth='0' height='100'/>" +
      std::string("<doorOrWindow name='d' x='200' y='0' width='90' depth='9' height='90' cutOutShape='M0,0 L9e9'/>");
  const Result<Imported> r = importHome(
      kWall + wallXml("z", 5, 5, 5, 5, 10) + wallXml("self", 0, 50, 90, 50, 10, "wallAtEnd='self' wallAtStart='gone'") +
      wallXml("thin", 0, 90, 90, 90, 0) + wallXml("whole", 0, 200, 1, 200, 10, "arcExtent='6.2831'") + flat + nothing +
      roomXml({{0, 0}, {1, 1}}) + roomXml({{0, 0}, {100, 100}, {100, 0}, {0, 100}}));
  EXPECT_TRUE(r.ok()) << r.error();
}

TEST(HostileSh3d, svgPathsAreReadOrEmpty) {
  using sh3d::svgPath;
  for (const char* path :
       {"", "x", "M", "M0,0 L", "0 0", "M0 0 L1e300 0", "M0,0 h1 v1 q", "Z Z 1", "M0,0 C1 1 1 1", "M0 0 h1e"})
    EXPECT_TRUE(svgPath(path).empty()) << path;
  EXPECT_NEAR(areaOf(svgPath("M0,0 v1 h1 v-1 z")), 1, 1e-12);
  EXPECT_NEAR(areaOf(svgPath("M0,0 v1 h1 v-1 z M.25.25h.5v.5h-.5z")), 0.75, 1e-12);
  EXPECT_NEAR(areaOf(svgPath("M0,1 C0,0.4477 0.4477,0 1,0 L1,1 Z")), 0.7854, 2e-3);
  EXPECT_NEAR(areaOf(svgPath("m0,1 q0.5-2 1 0 z")), 2.0 / 3, 2e-3);
}

}  // namespace
}  // namespace roomlight
