// Walls and rooms of Sweet Home 3D's homes: what they measure.
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <numbers>
#include <set>

#include "scene/shown_names.h"
#include "unit/import/sh3d_file.h"

namespace roomlight {
namespace {

using namespace testing;

TEST(Sh3dWalls, aLoneWallIsABoxOfItsMeasures) {
  const Scene scene = homeScene(wallXml("w0", 100, 200, 500, 200, 20, "height='240'"));
  EXPECT_NEAR(volumeM3(scene, "w0"), 4 * 0.2 * 2.4, 1e-5);
  const Bounds3 b = boundsOf(scene, "w0");
  EXPECT_EQ(b.lo, Vec3(1, 0, 1.9f));
  EXPECT_EQ(b.hi, Vec3(5, 2.4f, 2.1f));
}

// The plan is not mirrored: north is -z, east +x, and the wall's left side, walking east, is its northern one.
TEST(Sh3dWalls, sidesHaveTheirOwnColours) {
  const Scene scene = homeScene(wallXml("w0", 0, 0, 400, 0, 20, "leftSideColor='FFFF0000' rightSideColor='FF0000FF'"));
  for (const Face& f : facesOf(scene, "w0")) {
    if (std::abs(f.normal.z) < 0.99f) continue;
    const Vec3 c = scene.materials[static_cast<size_t>(f.material)].baseColor;
    EXPECT_EQ(f.normal.z<0, c.x> 0.5f);
    EXPECT_EQ(f.normal.z > 0, c.z > 0.5f);
    EXPECT_NEAR(f.centre.z, f.normal.z * 0.1f, 1e-6);
  }
}

std::map<std::string, std::string> labelsOf(const Scene& scene) {
  std::map<std::string, std::string> labels;
  for (const Instance& i : scene.instances) labels[i.name] = i.label;
  return labels;
}

// Two rooms side by side, a wall between them, one in the left room and one in the garden.
std::string labelledHome(const std::string& compass) {
  return boxWalls(800, 400, 20) + wallXml("wall-0-15", 400, 0, 400, 400, 10) + wallXml("stub", 100, 200, 300, 200, 10) +
         wallXml("garden", 0, 900, 500, 900, 20) + wallXml("hedge", 0, 950, 500, 950, 20) +
         roomXml({{0, 0}, {400, 0}, {400, 400}, {0, 400}}, "name='Living room'") +
         roomXml({{400, 0}, {800, 0}, {800, 400}, {400, 400}}, "name='Kitchen'") + compass;
}

TEST(Sh3dWalls, areCalledByTheirRoomsAndBearings) {
  auto labels = labelsOf(homeScene(labelledHome("<compass northDirection='0'/>")));
  EXPECT_EQ(labels["wall-0-15"], "Wall between Living room and Kitchen");
  EXPECT_EQ(labels["w1"], "Wall, Kitchen, east");
  EXPECT_EQ(labels["w3"], "Wall, Living room, west");
  EXPECT_EQ(labels["stub"], "Wall in Living room");
  EXPECT_EQ(labels["garden"], "Wall");
  EXPECT_EQ(labels["hedge"], "Wall (2)");
  EXPECT_TRUE(labels["w0"].ends_with(", north")) << labels["w0"];
  EXPECT_TRUE(labels["w2"].ends_with(", south")) << labels["w2"];
}

// North a quarter turn clockwise from up on the plan: what is at the right is in the north.
TEST(Sh3dWalls, bearingsFollowTheCompass) {
  auto labels = labelsOf(homeScene(labelledHome("<compass northDirection='1.5707963'/>")));
  EXPECT_EQ(labels["w1"], "Wall, Kitchen, north");
  EXPECT_EQ(labels["w3"], "Wall, Living room, south");
  labels = labelsOf(homeScene(labelledHome("")));
  EXPECT_EQ(labels["w3"], "Wall, Living room") << "nobody knows where north is";
}

TEST(Sh3dWalls, materialsAreCalledByTheirPaint) {
  const Scene scene = homeScene(wallXml("w0", 0, 0, 400, 0, 20, "leftSideColor='FFFF0000'"));
  std::set<std::string> shown;
  for (const Mesh& mesh : scene.meshes)
    shown.insert(shownMaterialName(scene.materials[static_cast<size_t>(mesh.material)]));
  EXPECT_TRUE(shown.contains("red wall paint"));
  EXPECT_TRUE(shown.contains("white wall paint"));
}

TEST(Sh3dWalls, slopedWallsAreTrapezoids) {
  const Scene scene = homeScene(wallXml("w0", 0, 0, 300, 400, 10, "height='200' heightAtEnd='300'"));
  EXPECT_NEAR(volumeM3(scene, "w0"), 5 * 0.1 * 2.5, 1e-5);
}

// The top is a plane that rises along the axis: at a mitre the longer side goes on rising.
TEST(Sh3dWalls, slopesGoOnInMitres) {
  const Scene scene = homeScene(wallXml("w0", 0, 0, 300, 0, 20, "height='200' heightAtEnd='300' wallAtEnd='w1'") +
                                wallXml("w1", 300, 0, 300, 300, 20, "height='300' wallAtStart='w0'"));
  EXPECT_NEAR(boundsOf(scene, "w0").hi.y, 2 + 3.1 / 3, 1e-5);
  EXPECT_NEAR(volumeM3(scene, "w0"), 3 * 0.2 * 2.5 + 0.2 * 0.1 * 0.1 / 3 / 6, 1e-5);
}

TEST(Sh3dWalls, joinedCornersAreMitred) {
  const Scene scene = homeScene(boxWalls(400, 300, 20));
  const double ring = (4.2 * 3.2 - 3.8 * 2.8) * 2.5;
  double sum = 0;
  for (const char* id : {"w0", "w1", "w2", "w3"}) sum += volumeM3(scene, id);
  EXPECT_NEAR(sum, ring, 1e-4);
  EXPECT_NEAR(volumeM3(scene, "w0"), 4 * 0.2 * 2.5, 1e-5);  // a trapezoid around its axis
}

TEST(Sh3dWalls, thickAndThinWallsMeetAtTheirSides) {
  const Scene scene = homeScene(wallXml("a", 0, 0, 400, 0, 40, "wallAtEnd='b'") +
                                wallXml("b", 400, 0, 400, 300, 10, "wallAtStart='a'"));
  // The thick wall ends between (4.05, -0.2) and (3.95, 0.2); the thin one begins there.
  EXPECT_NEAR(volumeM3(scene, "a"), 0.4 * 4.0 * 2.5, 1e-4);
  EXPECT_NEAR(volumeM3(scene, "b"), 0.1 * 3.0 * 2.5, 1e-4);
  const Bounds3 a = boundsOf(scene, "a"), b = boundsOf(scene, "b");
  EXPECT_NEAR(a.hi.x, 4.05, 1e-6);
  EXPECT_NEAR(b.lo.z, -0.2, 1e-6);
}

// The direction in which a wall was drawn changes nothing.
TEST(Sh3dWalls, jointsOfEveryDirectionFillTheSameSpace) {
  for (const bool turnA : {false, true}) {
    for (const bool turnB : {false, true}) {
      const std::string a =
          turnA ? wallXml("a", 400, 0, 0, 0, 20, "wallAtStart='b'") : wallXml("a", 0, 0, 400, 0, 20, "wallAtEnd='b'");
      const std::string b = turnB ? wallXml("b", 400, 300, 400, 0, 20, "wallAtEnd='a'")
                                  : wallXml("b", 400, 0, 400, 300, 20, "wallAtStart='a'");
      const Scene scene = homeScene(a + b);
      EXPECT_NEAR(volumeM3(scene, "a"), 4 * 0.2 * 2.5, 1e-4);
      EXPECT_NEAR(volumeM3(scene, "b"), 3 * 0.2 * 2.5, 1e-4);
      EXPECT_NEAR(boundsOf(scene, "a").hi.x, 4.1, 1e-6);
      EXPECT_NEAR(boundsOf(scene, "b").lo.z, -0.1, 1e-6);
    }
  }
}

TEST(Sh3dWalls, sharpCornersDoNotGrowSpikes) {
  const Scene scene =
      homeScene(wallXml("a", 0, 0, 400, 0, 20, "wallAtEnd='b'") + wallXml("b", 400, 0, 0, 20, 20, "wallAtStart='a'"));
  EXPECT_LT(boundsOf(scene, "a").hi.x, 4.41f);
}

TEST(Sh3dWalls, roundWallsAreRingSectors) {
  // A quarter ring and a half one; positive extents bulge to the left, here towards -z.
  const double r = 2 * std::numbers::sqrt2, sector = std::numbers::pi / 2;
  const Scene scene = homeScene(wallXml("a", 0, 0, 400, 0, 20, "arcExtent='" + std::to_string(sector) + "'") +
                                wallXml("b", 0, 900, 400, 900, 20, "arcExtent='-3.14159265'"));
  // Chords leave the arc by at most 1 mm.
  EXPECT_NEAR(volumeM3(scene, "a"), sector * r * 0.2 * 2.5, 1e-3 * sector * r * 0.2 * 2.5);
  EXPECT_NEAR(volumeM3(scene, "b"), std::numbers::pi * 2 * 0.2 * 2.5, 1e-3 * std::numbers::pi);
  EXPECT_NEAR(boundsOf(scene, "a").lo.z, 2 - r - 0.1, 2e-3);
  EXPECT_NEAR(boundsOf(scene, "b").hi.z, 9 + 2.1, 2e-3);
}

TEST(Sh3dWalls, levelsStandOnEachOtherAndReachThroughTheSlab) {
  const std::string levels =
      "<level id='l0' name='0' elevation='0' floorThickness='12' height='250'/>"
      "<level id='l1' name='1' elevation='262' floorThickness='12' height='250'/>"
      "<level id='l2' name='2' elevation='524' floorThickness='12' height='250' viewable='false'/>";
  const Scene scene = homeScene(levels + wallXml("a", 0, 0, 400, 0, 20, "level='l0'") +
                                wallXml("b", 0, 0, 400, 0, 20, "level='l1' height='200'") +
                                wallXml("c", 0, 0, 400, 0, 20, "level='l2'"));
  EXPECT_EQ(boundsOf(scene, "a").hi.y, 2.5f);
  EXPECT_EQ(boundsOf(scene, "b").lo.y, 2.5f);
  EXPECT_NEAR(boundsOf(scene, "b").hi.y, 4.62, 1e-6);
  EXPECT_TRUE(boundsOf(scene, "c").empty());
}

TEST(Sh3dRooms, floorsAndCeilingsHaveTheirAreas) {
  const Scene scene = homeScene(roomXml({{0, 0}, {500, 0}, {500, 300}, {200, 300}, {200, 400}, {0, 400}}, "name='L'"));
  EXPECT_NEAR(areaFacing(scene, "L", {0, 1, 0}), 17, 1e-5);
  EXPECT_NEAR(areaFacing(scene, "L", {0, -1, 0}), 17, 1e-5);
  ASSERT_EQ(scene.rooms.size(), 1u);
  EXPECT_EQ(scene.rooms[0].name, "L");
  EXPECT_EQ(scene.rooms[0].floor.size(), 6u);
  EXPECT_FLOAT_EQ(scene.rooms[0].heightM, 2.5f);
}

// Sweet Home 3D draws a floor's slab where stairs and edges show it, and from below where no room's ceiling hides it.
TEST(Sh3dRooms, slabsOfUpperLevelsAreSeenWhereNoCeilingHidesThem) {
  const auto room = [](double width, const std::string& more) {
    return roomXml({{0, 0}, {width, 0}, {width, 300}, {0, 300}}, more);
  };
  const std::string levels =
      "<level id='l0' name='0' elevation='0' floorThickness='12' height='250'/>"
      "<level id='l1' name='1' elevation='262' floorThickness='12' height='250'/>";
  const std::string upper = room(400, "name='R' level='l1' ceilingVisible='false'");
  const Scene open = homeScene(levels + upper);
  double edges = 0;
  for (const Face& f : facesOf(open, "R")) edges += std::abs(f.normal.y) < 0.5f ? static_cast<double>(f.areaM2) : 0.0;
  EXPECT_NEAR(edges, 14 * 0.12, 1e-5);
  EXPECT_NEAR(areaFacing(open, "R", {0, -1, 0}), 12, 1e-5);
  EXPECT_NEAR(volumeM3(open, "R"), 12 * 0.12, 1e-5);  // looks outwards all around
  // A terrace over half a room: what juts out is seen from below, of the rest the room's ceiling.
  EXPECT_NEAR(areaFacing(homeScene(levels + upper + room(300, "level='l0'")), "R", {0, -1, 0}), 3, 1e-5);
  EXPECT_NEAR(areaFacing(homeScene(levels + upper + room(400, "level='l0'")), "R", {0, -1, 0}), 0, 1e-9);
  EXPECT_NEAR(areaFacing(homeScene(levels + upper + room(400, "level='l0' ceilingVisible='false'")), "R", {0, -1, 0}),
              12, 1e-5);
}

TEST(Sh3dRooms, laterRoomsLieOnTop) {
  const Scene scene =
      homeScene(roomXml({{0, 0}, {500, 0}, {500, 400}, {0, 400}}, "name='A' ceilingVisible='false'") +
                roomXml({{100, 100}, {300, 100}, {300, 200}, {100, 200}}, "name='B' ceilingVisible='false'"));
  EXPECT_NEAR(areaFacing(scene, "A", {0, 1, 0}), 18, 1e-5);
  EXPECT_NEAR(areaFacing(scene, "B", {0, 1, 0}), 2, 1e-5);
  EXPECT_NEAR(areaFacing(scene, "A", {0, -1, 0}), 0, 1e-9);
}

TEST(Sh3dRooms, ceilingsFollowTheWallsOfTheHighestLevel) {
  const std::string walls =
      wallXml("a", 0, 0, 400, 0, 10, "height='200'") + wallXml("b", 0, 300, 400, 300, 10, "height='350'");
  const Scene scene =
      homeScene(walls + roomXml({{0, 0}, {400, 0}, {400, 300}, {0, 300}}, "name='R' floorVisible='false'"));
  EXPECT_NEAR(boundsOf(scene, "R").lo.y, 2, 1e-6);
  EXPECT_NEAR(boundsOf(scene, "R").hi.y, 3.5, 1e-6);
  EXPECT_FLOAT_EQ(scene.rooms[0].heightM, 3.5f);
  const Scene flat = homeScene(
      walls + roomXml({{0, 0}, {400, 0}, {400, 300}, {0, 300}}, "name='R' floorVisible='false' ceilingFlat='true'"));
  EXPECT_EQ(boundsOf(flat, "R").lo.y, boundsOf(flat, "R").hi.y);
}

// As Sweet Home 3D has it: a ceiling is as high as walls are at the room's corners; what stands beside its edges in
// between pulls it nowhere.
TEST(Sh3dRooms, lowScreensWithinARoomLeaveItsCeilingLevel) {
  const std::string room =
      roomXml({{0, 0}, {400, 0}, {400, 300}, {200, 300}, {200, 250}, {0, 250}}, "name='R' floorVisible='false'");
  const Scene scene = homeScene(boxWalls(400, 300, 10) + wallXml("screen", 200, 10, 200, 40, 1, "height='135'") + room);
  EXPECT_NEAR(boundsOf(scene, "R").lo.y, 2.5, 1e-6);
}

TEST(Sh3dRooms, staircasesCutTheFloorThatTheyComeUpThrough) {
  const std::string levels =
      "<level id='l0' name='0' elevation='0' floorThickness='12' height='250'/>"
      "<level id='l1' name='1' elevation='262' floorThickness='12' height='250'/>";
  const std::string stairs =
      "<pieceOfFurniture name='stairs' level='l0' x='200' y='200' width='100' depth='200' height='262' "
      "angle='1.5707963' "
      "staircaseCutOutShape='M0,0 v1 h1 v-1 z'/>";
  const auto square = [](const char* level, const char* name) {
    return roomXml({{0, 0}, {500, 0}, {500, 400}, {0, 400}}, std::string("level='") + level + "' name='" + name + "'");
  };
  const Scene scene = homeScene(levels + stairs + square("l0", "down") + square("l1", "up"));
  EXPECT_NEAR(areaFacing(scene, "down", {0, 1, 0}), 20, 1e-4);
  EXPECT_NEAR(areaFacing(scene, "down", {0, -1, 0}), 18, 1e-4);
  EXPECT_NEAR(areaFacing(scene, "up", {0, 1, 0}), 18, 1e-4);
  EXPECT_NEAR(areaFacing(scene, "up", {0, -1, 0}), 20, 1e-4);
}

TEST(Sh3dCameras, wideLensesBecomePinholes) {
  const Result<Imported> r = importHome(
      wallXml("w", 0, 0, 100, 0, 10) +
      "<camera attribute='storedCamera' lens='SPHERICAL' x='0' y='0' z='0' yaw='0' pitch='0' fieldOfView='6.28'/>");
  ASSERT_TRUE(r.ok()) << r.error();
  EXPECT_LT(r.value().scene.cameras[0].yFovRad, 3.1f);
}

TEST(Sh3dCameras, lookWhereTheyAreTurned) {
  const Scene scene = homeScene(
      wallXml("w", 0, 0, 100, 0, 10) +
          "<environment photoWidth='800' photoHeight='400'/>"
          "<observerCamera attribute='observerCamera' x='100' y='200' z='170' yaw='0' pitch='0' fieldOfView='1.1'/>"
          "<camera attribute='topCamera' x='0' y='0' z='1000' yaw='3.14159265' pitch='0.7853982' fieldOfView='1.1'/>"
          "<observerCamera name='west' attribute='storedCamera' x='0' y='0' z='0' yaw='1.5707963' pitch='0' "
          "fieldOfView='1.1'/>",
      "camera='observerCamera'");
  ASSERT_EQ(scene.cameras.size(), 3u);
  const auto forward = [&](size_t i) { return -scene.cameras[i].worldFromCamera.z; };
  EXPECT_NEAR(length(forward(0) - Vec3(0, 0, 1)), 0, 1e-6);
  EXPECT_EQ(scene.cameras[0].worldFromCamera.w, Vec3(1, 1.7f, 2));
  EXPECT_NEAR(length(forward(1) - normalize(Vec3(0, -1, -1))), 0, 1e-6);
  EXPECT_NEAR(length(forward(2) - Vec3(-1, 0, 0)), 0, 1e-6);
  EXPECT_EQ(scene.cameras[2].name, "west");
  for (const Camera& c : scene.cameras) {
    EXPECT_NEAR(length(cross(c.worldFromCamera.x, c.worldFromCamera.y) - c.worldFromCamera.z), 0, 1e-6);
    EXPECT_GT(c.worldFromCamera.y.y, 0);
    EXPECT_NEAR(std::tan(c.yFovRad / 2) * 2, std::tan(1.1 / 2),
                1e-6);  // 1.1 rad across the width, which is twice the height
  }
}

TEST(Sh3dPhoto, sizeAndQualityAreToldWhereSomebodyChoseThem) {
  const auto photo = [](const std::string& attributes) {
    return importHome(wallXml("w", 0, 0, 100, 0, 10) + "<environment " + attributes + "/>").value().photo;
  };
  EXPECT_FALSE(photo(""));
  EXPECT_FALSE(photo("photoWidth='400' photoHeight='300' photoQuality='0'")) << "as a new home has it";
  const auto wide = photo("photoWidth='800' photoHeight='300' photoAspectRatio='RATIO_16_9' photoQuality='2'");
  ASSERT_TRUE(wide);
  EXPECT_EQ(wide->widthPx, 800);
  EXPECT_EQ(wide->heightPx, 450) << "a fixed ratio rules over the height";
  EXPECT_EQ(wide->quality, 2);
  const auto free = photo("photoWidth='400' photoHeight='300' photoAspectRatio='FREE_RATIO' photoQuality='1'");
  ASSERT_TRUE(free);
  EXPECT_EQ(free->heightPx, 300);
}

}  // namespace
}  // namespace roomlight
