// Doors and windows of Sweet Home 3D's homes: open where they are and nowhere else. And closed rooms let nothing out.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "trace/ray_scene.h"
#include "unit/import/sh3d_file.h"

namespace roomlight {
namespace {

using namespace testing;

// How many of `count` rays from within hit nothing.
int escapes(const Scene& scene, Vec3 from, int count) {
  const RayScene rays(scene);
  std::mt19937 random(7);
  std::normal_distribution<float> normal;
  int out = 0;
  for (int i = 0; i < count; ++i)
    out += !rays.intersect({from, normalize(Vec3(normal(random), normal(random), normal(random)))}).valid();
  return out;
}

// Without the ground, which would stop rays too.
Scene indoors(const std::string& elements) {
  Scene scene = homeScene(elements);
  std::erase_if(scene.instances, [](const Instance& i) { return i.name == "ground"; });
  return scene;
}

std::string doorXml(double x, double y, double width, double height, double angle, const std::string& more = "") {
  const auto n = [](double v) { return std::to_string(v); };
  return "<doorOrWindow name='door' x='" + n(x) + "' y='" + n(y) + "' width='" + n(width) + "' depth='20' height='" +
         n(height) + "' angle='" + n(angle) + "' " + more + "/>";
}

const std::string kRoom = roomXml({{0, 0}, {400, 0}, {400, 300}, {0, 300}});

TEST(Sh3dOpenings, closedRoomsLetNothingOut) {
  EXPECT_EQ(escapes(indoors(boxWalls(400, 300, 20) + kRoom), {2, 1.2f, 1.5f}, 200'000), 0);
  // Thick and thin walls, round ones, sloped ones, a wall that ends on another, in a plan turned by no round angle.
  const std::string walls =
      wallXml("a", 10, 20, 413, 77, 35, "wallAtStart='d' wallAtEnd='b' height='300' heightAtEnd='260'") +
      wallXml("b", 413, 77, 390, 470, 8,
              "wallAtStart='a' wallAtEnd='c' arcExtent='-1.2' height='260' heightAtEnd='260'") +
      wallXml("c", 390, 470, -30, 430, 20, "wallAtStart='b' wallAtEnd='d' height='260' heightAtEnd='280'") +
      wallXml("d", -30, 430, 10, 20, 12, "wallAtStart='c' wallAtEnd='a' height='280' heightAtEnd='300'") +
      wallXml("t", 200, 47, 200, 250, 10);
  const std::string room = roomXml({{-100, -100}, {600, -100}, {600, 600}, {-100, 600}}, "ceilingFlat='true'");
  EXPECT_EQ(escapes(indoors(walls + room), {1, 1.2f, 2}, 200'000), 0);
}

TEST(Sh3dOpenings, doorsAreOpenWhereTheyAreAndNowhereElse) {
  const Scene scene = indoors(boxWalls(400, 300, 20) + kRoom + doorXml(400, 120, 90, 210, std::numbers::pi / 2));
  const RayScene rays(scene);
  for (int i = 0; i < 300; ++i) {
    for (int k = 0; k < 250; ++k) {
      const float z = 0.005f + 0.01f * static_cast<float>(i), y = 0.0045f + 0.01f * static_cast<float>(k);
      const bool open = std::abs(z - 1.2f) < 0.45f && y < 2.1f;
      EXPECT_EQ(rays.intersect({{2, y, z}, {1, 0, 0}}).valid(), !open) << y << ' ' << z;
    }
  }
  // The reveals are 20 cm deep: jambs and lintel; the floor goes on.
  const double hole = 0.9 * 2.1 * 0.2;
  EXPECT_NEAR(volumeM3(scene, "w1"), 3 * 0.2 * 2.5 - hole, 1e-4);
}

TEST(Sh3dOpenings, windowsOfAnyShapeCutBothSides) {
  // A round window of 1 m in a slanted wall, mirrored or not; the wall in either direction.
  const double c = std::cos(0.5), s = std::sin(0.5);
  for (const bool turned : {false, true}) {
    const std::string wall =
        turned ? wallXml("w", 400 * c, 400 * s, 0, 0, 30) : wallXml("w", 0, 0, 400 * c, 400 * s, 30);
    const std::string window = "<doorOrWindow name='window' x='" + std::to_string(200 * c) + "' y='" +
                               std::to_string(200 * s) +
                               "' width='100' depth='30' height='100' elevation='80' angle='0.5' cutOutShape='M0,0.5 "
                               "A.5,.5 0 0 1 1,.5 a0.5 0.5 0 1 1 -1 0z'/>";
    const Scene scene = indoors(wall + window);
    EXPECT_NEAR(volumeM3(scene, "w"), 0.3 * (4 * 2.5 - std::numbers::pi / 4), 0.3 * 0.005);
    const RayScene rays(scene);
    const Vec3 across{-static_cast<float>(s), 0, static_cast<float>(c)},
        middle{static_cast<float>(2 * c), 1.3f, static_cast<float>(2 * s)};
    for (const float r : {0.0f, 0.3f, 0.49f, 0.51f, 0.7f}) {
      for (int i = 0; i < 24; ++i) {
        const float a = 0.26f * static_cast<float>(i);
        const Vec3 p = middle + Vec3(static_cast<float>(c), 0, static_cast<float>(s)) * (r * std::cos(a)) +
                       Vec3(0, 1, 0) * (r * std::sin(a));
        EXPECT_EQ(rays.intersect({p - across * 2, across}).valid(), r > 0.5f);
      }
    }
  }
}

TEST(Sh3dOpenings, neighboursAndOverlappingOnesAreOneHole) {
  const Scene scene =
      indoors(wallXml("w", 0, 0, 400, 0, 20) + doorXml(150, 0, 100, 200, 0) +
              doorXml(200, 0, 100, 220, std::numbers::pi) + doorXml(300, 0, 100, 100, 0, "elevation='50'"));
  EXPECT_NEAR(volumeM3(scene, "w"), 0.2 * (10 - (1 * 2 + 1 * 2.2 - 0.5 * 2) - 1 * 1 + 0.0), 1e-4);
  const RayScene rays(scene);
  EXPECT_FALSE(rays.intersect({{1.76f, 1, -2}, {0, 0, 1}}).valid());
  EXPECT_FALSE(rays.intersect({{2.49f, 1, -2}, {0.005f, 0, 1}}).valid());  // from one into the other
}

TEST(Sh3dOpenings, roundWallsAreCutToo) {
  const Scene scene = indoors(wallXml("w", 0, 0, 400, 0, 20, "arcExtent='1.6'") +
                              doorXml(200, -83, 120, 200, 0, "wallCutOutOnBothSides='true'"));
  const RayScene rays(scene);
  for (float x = 0.3f; x < 3.7f; x += 0.02f)
    EXPECT_EQ(rays.intersect({{x, 1, -3}, {0, 0, 1}}).valid(), std::abs(x - 2) > 0.6f) << x;
  // No ray from inside the opening's jambs gets into the wall's body: whatever is hit looks at the ray.
  for (float x = 1.45f; x < 2.55f; x += 0.01f) {
    const Vec3 d = normalize(Vec3(x < 2 ? -1.0f : 1.0f, 0.02f, 0));
    const Hit hit = rays.intersect({{x, 1, -0.83f}, d});
    EXPECT_TRUE(!hit.valid() || dot(hit.ng, d) < 0) << x;
  }
}

// What is said of the part in the wall, and whether the piece is bound to it, is for the plan: Sweet Home 3D cuts all
// of the piece in 3D.
TEST(Sh3dOpenings, theWholePieceCuts) {
  for (const char* more : {"wallWidth='0.5' wallLeft='0.1' wallHeight='0.5' wallTop='0.2'", "boundToWall='false'"}) {
    EXPECT_NEAR(volumeM3(indoors(wallXml("w", 0, 0, 400, 0, 20) + doorXml(200, 0, 200, 200, 0, more)), "w"),
                0.2 * (10 - 2 * 2), 1e-4);
  }
}

TEST(Sh3dOpenings, wallsFarAwayStayWhole) {
  const Scene scene =
      indoors(wallXml("far", 0, 100, 400, 100, 20) + doorXml(200, 0, 100, 200, 0, "wallCutOutOnBothSides='true'"));
  EXPECT_NEAR(volumeM3(scene, "far"), 4 * 0.2 * 2.5, 1e-5);
}

// A wall across loses what stands in the piece, also where it begins there; what the piece only touches stays.
TEST(Sh3dOpenings, wallsAcrossLoseWhatStandsInThePiece) {
  const Scene scene = indoors(wallXml("w", 0, 0, 400, 0, 20) + wallXml("across", 180, -100, 180, 100, 20) +
                              wallXml("stem", 220, 0, 220, 200, 10) + wallXml("beside", 255, -100, 255, 100, 10) +
                              doorXml(200, 0, 100, 200, 0, "wallCutOutOnBothSides='true'"));
  EXPECT_NEAR(volumeM3(scene, "across"), 0.2 * (2 * 2.5 - 0.2 * 2), 1e-4);
  EXPECT_NEAR(volumeM3(scene, "stem"), 0.1 * (2 * 2.5 - 0.1 * 2), 1e-4);
  EXPECT_NEAR(volumeM3(scene, "beside"), 0.1 * 2 * 2.5, 1e-4);
  const RayScene rays(scene);
  EXPECT_FALSE(rays.intersect({{2.2f, 1, -2}, {0, 0, 1}, 0, 2.09f}).valid());  // to where the stem goes on
  EXPECT_NEAR(rays.intersect({{2.2f, 1, -2}, {0, 0, 1}}).t, 2.1, 1e-4);
  EXPECT_FALSE(
      rays.intersect({{1.55f, 1, 0.05f}, {1, 0, 0}, 0, 0.94f}).valid());  // along the opening, from jamb to jamb
}

TEST(Sh3dOpenings, aNicheInACornerOfTheWallLeavesItClosed) {
  // A wall of 12 cm runs up to another one, whose door stands 4 cm in its corner: to the left or the right, at its
// start or end.
  for (const bool left : {false, true}) {
    for (const bool atStart : {false, true}) {
      const double x = left ? 50 : -50, inWall = 15.9;
      const std::string wall = atStart ? wallXml("w", 0, 0, 0, -300, 12) : wallXml("w", 0, -300, 0, 0, 12);
      const Scene scene = homeScene(wall + doorXml(x, -5.9, 96, 210, 0));
      const double whole = 0.12 * 3 * 2.5, taken = 0.04 * inWall / 100 * 2.1;
      EXPECT_NEAR(volumeM3(scene, "w"), whole - taken, 1e-4) << left << atStart;
      // One jamb looks at the end, which is open there: no face plugs it.
      for (const float z : {-1.0f, 1.0f})
        EXPECT_NEAR(areaFacing(scene, "w", {0, 0, z}), 0.12 * 2.5, 1e-4) << left << atStart << z;
    }
  }
}

// Doors that reach beyond the end of a wall take it away, also where that end is slanted: by the wall's own turn or by
// a mitre of any angle.
TEST(Sh3dOpenings, nothingIsLeftOfAWallsEndInADoor) {
  for (const double turn : {0.0, 1e-4, 0.002, 0.045, 0.08}) {
    // A wall of 12 cm of which the last 60 cm stand in a door of 2 m that is not turned with it.
    const double c = std::cos(turn), s = std::sin(turn);
    const Scene lone = homeScene(wallXml("w", 0, 0, -300 * c, -300 * s, 12) +
                                 doorXml(40, 0, 200, 200, 0, "wallCutOutOnBothSides='true'"));
    // Up to the door's edge at x = -60, which cuts the wall askew.
    EXPECT_NEAR(volumeM3(lone, "w"), 0.12 * (3 * 2.5 - 0.6 / c * 2), 1e-4) << turn;
    EXPECT_NEAR(areaFacing(lone, "w", {1, 0, 0}), 0.12 * 0.5 + 0.12 / c * 2, 1e-4)
        << turn;  // the end above the door, and the jamb
  }
  for (const double degrees : {10.0, 45.0, 80.0, 100.0, 135.0}) {
    // The next wall leaves by that angle: the mitre lies in the door.
    const double a = degrees * std::numbers::pi / 180, x = 300 * std::cos(a), y = 300 * std::sin(a);
    const Scene corner = homeScene(wallXml("w", -300, 0, 0, 0, 12, "wallAtEnd='v'") +
                                   wallXml("v", 0, 0, x, y, 12, "wallAtStart='w'") + doorXml(0, 0, 120, 200, 0));
    EXPECT_NEAR(volumeM3(corner, "w"), 0.12 * (3 * 2.5 - 0.6 * 2), 1e-4)
        << degrees;  // a mitre takes on one side what it adds on the other
  }
}

// A door that reaches into the mitre of a corner leaves no post of it.
TEST(Sh3dOpenings, doorsInCornersCutTheMitre) {
  const Scene scene = indoors(boxWalls(400, 300, 20) + doorXml(355, 0, 90, 200, 0));
  EXPECT_NEAR(volumeM3(scene, "w0"), 0.2 * 4 * 2.5 - (0.9 * 0.2 - 0.1 * 0.1 / 2) * 2, 1e-4);
  EXPECT_NEAR(volumeM3(scene, "w1"), 0.2 * 3 * 2.5 - 0.1 * 0.1 / 2 * 2, 1e-4);
  const RayScene rays(scene);
  for (float x = 3.11f; x < 4; x += 0.02f) EXPECT_FALSE(rays.intersect({{x, 1, -2}, {0, 0, 1}, 0, 2.09f}).valid()) << x;
}

// Two walls in one line with a window over their joint: nothing stands in it.
TEST(Sh3dOpenings, jointsInAnOpeningAreOpen) {
  const Scene scene =
      indoors(wallXml("a", 0, 0, 200, 0, 20, "wallAtEnd='b'") + wallXml("b", 200, 0, 400, 0, 20, "wallAtStart='a'") +
              doorXml(200, 0, 100, 100, 0, "elevation='80'"));
  EXPECT_NEAR(volumeM3(scene, "a"), 0.2 * (2 * 2.5 - 0.5), 1e-4);
  const RayScene rays(scene);
  EXPECT_FALSE(rays.intersect({{1.55f, 1.3f, 0.02f}, {1, 0, 0}, 0, 0.9f}).valid());
}

// The floor of a doorway is no wall: what the rooms' floors leave open there shows the ground.
TEST(Sh3dOpenings, doorsLeaveNoThreshold) {
  const Scene scene = indoors(wallXml("w", 0, 0, 400, 0, 20) + doorXml(200, 0, 100, 200, 0));
  EXPECT_NEAR(areaFacing(scene, "w", {0, -1, 0}), 0.2 * 4, 1e-4);  // without 0.2 of the bottom, with the lintel
  EXPECT_FALSE(RayScene(scene).intersect({{2, 1, 0}, {0, -1, 0}}).valid());
}

TEST(Sh3dOpenings, aNicheBesideAHoleStaysANiche) {
  const Scene scene = indoors(wallXml("w", 0, 0, 400, 0, 30) + doorXml(100, 13, 100, 100, 0, "elevation='50'") +
                              doorXml(300, 13, 100, 100, 0, "elevation='50' wallCutOutOnBothSides='true'"));
  EXPECT_NEAR(volumeM3(scene, "w"), 0.3 * (10 - 1) - 0.12, 1e-4);
}

// A piece 20 cm deep that stands 12 cm into a wall of 30 cm: a niche, or a hole where it cuts both sides.
TEST(Sh3dOpenings, piecesThatEndInTheWallMakeNiches) {
  for (const double side : {-1.0, 1.0}) {
    const Scene niche =
        indoors(wallXml("w", 0, 0, 400, 0, 30) + doorXml(200, side * 13, 100, 100, 0, "elevation='50'"));
    EXPECT_NEAR(volumeM3(niche, "w"), 0.3 * 10 - 0.12, 1e-4);
    const RayScene rays(niche);
    const float s = static_cast<float>(side);
    EXPECT_NEAR(rays.intersect({{2, 1, 2 * s}, {0, 0, -s}}).t, 2 - 0.03f, 1e-5);
    EXPECT_NEAR(rays.intersect({{2, 1, -2 * s}, {0, 0, s}}).t, 2 - 0.15f, 1e-5);
    const Scene hole = indoors(wallXml("w", 0, 0, 400, 0, 30) +
                               doorXml(200, side * 13, 100, 100, 0, "elevation='50' wallCutOutOnBothSides='true'"));
    EXPECT_NEAR(volumeM3(hole, "w"), 0.3 * (10 - 1), 1e-4);
  }
  const Scene beside = indoors(wallXml("w", 0, 0, 400, 0, 30) + doorXml(200, 25.1, 100, 100, 0, "elevation='50'"));
  EXPECT_NEAR(volumeM3(beside, "w"), 0.3 * 10, 1e-5);
}

// Inside a room of 3.8 x 2.8 m, 2 cm thick and 10 cm high, without the door's 90 cm.
TEST(Sh3dOpenings, baseboardsRunAroundTheRoomAndStopAtDoors) {
  std::string walls = boxWalls(400, 300, 20);
  for (size_t at = walls.find("/>"); at != std::string::npos; at = walls.find("/>", at + 90)) {
    walls.replace(at, 2,
                  "><baseboard attribute='rightSideBaseboard' thickness='2' height='10' color='FF804020'/></wall>");
  }
  const Scene scene = indoors(walls + doorXml(400, 120, 90, 210, std::numbers::pi / 2));
  double front = 0, top = 0;
  for (const char* id : {"w0", "w1", "w2", "w3"}) {
    for (const Face& f : facesOf(scene, id)) {
      if (scene.materials[static_cast<size_t>(f.material)].name != "baseboard") continue;
      if (f.normal.y > 0.5f) top += static_cast<double>(f.areaM2);
      if (std::abs(f.normal.y) < 0.5f && dot(f.normal, Vec3(2, 0.05f, 1.5f) - f.centre) > 0 && f.areaM2 > 0.003f)
        front += static_cast<double>(f.areaM2);
    }
  }
  EXPECT_NEAR(front, 0.1 * (2 * (3.76 + 2.76) - 0.9), 1e-4);
  EXPECT_NEAR(top, 3.8 * 2.8 - 3.76 * 2.76 - 0.9 * 0.02, 1e-4);
  const RayScene rays(scene);
  EXPECT_FALSE(rays.intersect({{2, 0.05f, 1.2f}, {1, 0, 0}}).valid());
  EXPECT_NEAR(rays.intersect({{2, 0.05f, 2.2f}, {1, 0, 0}}).t, 1.88, 1e-5);
}

}  // namespace
}  // namespace roomlight
