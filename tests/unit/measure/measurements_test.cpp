#include "measure/measurements.h"

#include <gtest/gtest.h>

#include <cmath>

namespace roomlight {
namespace {

void addRoom(Measurements& m, const std::string& name, const std::string& use, double areaM2, float lux) {
  RoomReading r;
  r.room.name = name, r.room.use = use, r.areaM2 = areaM2;
  m.rooms.push_back(r);
  GridReading g;
  g.name = name + ", work plane", g.room = name, g.areaM2 = areaM2;
  g.points.lattice.columns = 1, g.points.lattice.rows = 1, g.points.lattice.used = {1};
  g.points.lux = {lux};
  m.grids.push_back(g);
}

TEST(RoomTargets, useIsStatedOrTakenFromTheNameOrAssumed) {
  Measurements m;
  addRoom(m, "Room 1", "kitchen", 10, 120);
  addRoom(m, "Master bedroom", "", 10, 60);
  addRoom(m, "Area 3", "", 10, 99);
  const std::vector<RoomTarget> t = roomTargets(m);
  ASSERT_EQ(t.size(), 3u);
  EXPECT_EQ(t[0].use, "kitchen");
  EXPECT_EQ(t[0].origin, "stated");
  EXPECT_TRUE(t[0].met());
  EXPECT_EQ(t[1].use, "bedroom");
  EXPECT_EQ(t[1].origin, "name");
  EXPECT_EQ(t[1].wantedLux, 75);
  EXPECT_FALSE(t[1].met());
  EXPECT_EQ(t[2].use, kAssumedUse);
  EXPECT_EQ(t[2].origin, "assumed");
  EXPECT_FALSE(t[2].met());
  EXPECT_EQ(t[2].source, "GB 50034");
}

TEST(RoomTargets, areThoseOfTheMeterFileAndAgeWithTheLamps) {
  Measurements m;
  addRoom(m, "Workshop", "", 10, 300);
  m.rooms[0].targets.lux = Target{250, "meter file"};
  EXPECT_TRUE(roomTargets(m)[0].met());
  EXPECT_EQ(roomTargets(m)[0].origin, "target");
  m.maintenanceFactor = 0.8;
  EXPECT_FALSE(roomTargets(m)[0].met());
  m.grids[0].outdoors = true;
  EXPECT_TRUE(roomTargets(m).empty());
}

TEST(RoomTargets, namesOfRoomsInSeveralLanguages) {
  const auto use = [](const char* name) { return useByName(name) ? useByName(name)->name : std::string(); };
  EXPECT_EQ(use("Küche"), "kitchen");
  EXPECT_EQ(use("KITCHEN 2"), "kitchen");
  EXPECT_EQ(use("Salle de bain"), "bathroom");
  EXPECT_EQ(use("Bad"), "bathroom");
  EXPECT_EQ(use("WC/2"), "bathroom");
  EXPECT_EQ(use("Badminton court"), "");
  EXPECT_EQ(use("Schlafzimmer"), "bedroom");
  EXPECT_EQ(use("Guest room"), "bedroom");
  EXPECT_EQ(use("Hallway"), "hall");
  EXPECT_EQ(use("Marshall's den"), "");
  EXPECT_EQ(use("Area 1"), "");
}

TEST(HomeMeans, areByRoomAndByArea) {
  Measurements m;
  addRoom(m, "Large", "", 30, 100);
  addRoom(m, "Small", "", 10, 300);
  const auto means = homeMeans(m);
  ASSERT_TRUE(means);
  EXPECT_EQ(means->rooms, 2u);
  EXPECT_DOUBLE_EQ(means->areaM2, 40);
  EXPECT_DOUBLE_EQ(means->ofRoomsLux, 200);
  EXPECT_DOUBLE_EQ(means->ofAreaLux, 150);
  EXPECT_FALSE(homeMeans({}));
}

TEST(Exposure, isThatOfALightMeter) {
  EXPECT_NEAR(incidentEv100(300), 6.91, 0.005);
  EXPECT_NEAR(reflectedEv100(17.19), 7.10, 0.005);
}

}  // namespace
}  // namespace roomlight
