// Damaged and malicious homes: one line of error, or a warning and the rest of the home.
#include <gtest/gtest.h>

#include "import/sh3d_archive.h"
#include "import/sh3d_openings.h"
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
