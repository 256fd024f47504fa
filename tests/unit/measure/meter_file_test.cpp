#include "measure/meter_plan.h"

#include <gtest/gtest.h>

#include "unit/temporary_folder.h"

namespace roomlight {
namespace {

using testing::TemporaryFolder;
using testing::writeFile;

Result<MeterPlan> read(const std::string& text, const std::vector<Room>& rooms = {}) {
  const TemporaryFolder folder;
  writeFile(folder / "meters.json", text);
  return readMeterFile(folder / "meters.json", rooms);
}

TEST(MeterFile, readsEveryKind) {
  const Result<MeterPlan> plan = read(R"({
    "version": 1, "spacing": 0.5, "maintenanceFactor": 0.8,
    "rooms": [{"name": "Study", "use": "office", "floor": [[0, 0], [4, 0], [4, 3], [0, 3]], "elevation": 2.8, "height": 2.5, "surfaces": ["workPlane", "walls"], "watts": 60, "target": "300 lx"}],
    "grids": [{"name": "Worktop", "corner": [0, 0.9, 0], "u": [0, 0, 0.6], "v": [2, 0, 0], "target": "150 lx"}],
    "points": [{"name": "Pillow", "position": [1, 0.5, 1]}],
    "spots": [{"name": "Screen", "position": [2, 1.2, 2], "lookAt": [2, 1.2, 0]}],
    "glare": [{"name": "Sofa", "position": [1, 1.2, 3], "direction": [0, 0, -2], "ugr": 19}]})");
  ASSERT_TRUE(plan) << plan.error();
  const MeterPlan& p = plan.value();
  ASSERT_EQ(p.rooms.size(), 1u);
  EXPECT_EQ(p.rooms[0].targets.lux->value, 300);
  EXPECT_EQ(p.rooms[0].targets.uniformity->value, 0.6);  // of the use
  EXPECT_EQ(p.rooms[0].targets.lux->source, "meter file");
  EXPECT_EQ(p.rooms[0].targets.uniformity->source, "EN 12464-1");
  EXPECT_EQ(p.rooms[0].workPlaneM, 0.75);
  EXPECT_TRUE(p.rooms[0].onWalls && p.rooms[0].onWorkPlane && !p.rooms[0].onFloor);
  EXPECT_EQ(p.rooms[0].room.floor[1].y, 3);  // turned counter-clockwise seen from above
  EXPECT_EQ(p.grids[0].targets.lux->value, 150);
  EXPECT_TRUE(p.points[0].place.normal == Vec3(0, 1, 0));
  EXPECT_TRUE(p.spots[0].direction == Vec3(0, 0, -1));
  EXPECT_TRUE(p.glares[0].direction == Vec3(0, 0, -1));
  EXPECT_EQ(p.glares[0].targets.ugr->value, 19);
}

TEST(MeterFile, takesRoomsOfTheScene) {
  Room kitchen;
  kitchen.name = "Kitchen", kitchen.floor = {{0, 0}, {0, 3}, {3, 3}, {3, 0}}, kitchen.elevationM = 3;
  const Result<MeterPlan> plan = read(R"({"rooms": [{"name": "Kitchen", "use": "kitchen"}]})", {kitchen});
  ASSERT_TRUE(plan) << plan.error();
  EXPECT_EQ(plan.value().rooms[0].room.elevationM, 3);
  EXPECT_EQ(plan.value().rooms[0].targets.lux->value, 100);
  EXPECT_EQ(plan.value().rooms[0].targets.wattsPerM2->value, 6);
}

TEST(MeterFile, errorsNameThePlace) {
  const std::pair<const char*, const char*> cases[] = {
      {R"({"rooms": [{"name": "A"}]})", "rooms[0]: the scene knows no room 'A'"},
      {R"({"rooms": [{"name": "A", "floor": [[0, 0], [1, 0]]}]})", "rooms[0].floor: must have from 3"},
      {R"({"rooms": [{"name": "A", "floor": [[0, 0], [1, 0], [2, 0]]}]})", "rooms[0].floor: has no area"},
      {R"({"rooms": [{"name": "A", "floor": [[0, 0], [4, 0], [0, 3], [2, 5]]}]})", "rooms[0].floor: crosses itself"},
      {R"({"rooms": [{"name": "A", "floor": [[0, 0], [1, 0], [1, 1]]}, {"name": "A", "floor": [[2, 0], [3, 0], [3, 1]]}]})",
       "rooms[1]: is the second room named 'A'"},
      {R"({"version": 2, "spacing": 0.5})", "version: must be"},
      {R"({"rooms": [{"name": "A", "floor": [[0, 0], [1, 0], [1]]}]})", "rooms[0].floor[2]: must be [x, z]"},
      {R"({"rooms": [{"name": "A", "use": "garage", "floor": [[0, 0], [1, 0], [1, 1]]}]})",
       "rooms[0].use: unknown 'garage'"},
      {R"({"points": [{"name": "A", "position": [0, 0, 0], "target": 150}]})", "points[0].target: has no unit"},
      {R"({"points": [{"name": "A", "position": [0, 0, 0], "normal": [0, 0, 0]}]})",
       "points[0].normal: must not be zero"},
      {R"({"spots": [{"name": "A", "position": [0, 0, 0]}]})", "spots[0]: give exactly one of direction, lookAt"},
      {R"({"grids": [{"name": "A", "corner": [0, 0, 0], "u": [1, 0, 0], "v": [1, 0, 1]}]})",
       "grids[0]: 'u' and 'v' must be the sides of a rectangle"},
      {R"({"lamps": []})", "unknown key 'lamps'"},
      {R"({"points": []})", "asks for nothing"},
  };
  for (const auto& [text, expected] : cases) {
    const Result<MeterPlan> plan = read(text);
    ASSERT_FALSE(plan) << text;
    EXPECT_NE(plan.error().find(expected), std::string::npos) << plan.error();
    EXPECT_NE(plan.error().find("meters.json"), std::string::npos) << plan.error();
  }
}

}  // namespace
}  // namespace roomlight
