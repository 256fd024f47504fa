#include "measure/meter_place.h"

#include <gtest/gtest.h>

#include "engine/lit_scene.h"
#include "measure/measure.h"
#include "support/rooms.h"

namespace roomlight {
namespace {

// A house of four walls of 0.26 m, 6 x 5 m inside, with a roof, in a garden of 40 x 40 m; a wardrobe in it.
struct House {
  Scene scene;
  int white;

  explicit House(bool roof = true) : white(test::addMaterial(scene, test::lambertian(0.7f))) {
    test::addRectangle(scene, {-20, -0.01f, -20}, {0, 0, 40}, {40, 0, 0}, white);
    test::addBox(scene, {-0.26f, 0, -0.26f}, {6.26f, 2.6f, 0}, white);
    test::addBox(scene, {-0.26f, 0, 5}, {6.26f, 2.6f, 5.26f}, white);
    test::addBox(scene, {-0.26f, 0, 0}, {0, 2.6f, 5}, white);
    test::addBox(scene, {6, 0, 0}, {6.26f, 2.6f, 5}, white);
    if (roof) test::addBox(scene, {-0.26f, 2.6f, -0.26f}, {6.26f, 2.8f, 5.26f}, white);
    test::addBox(scene, {4.02f, 0, 0.05f}, {5.48f, 2, 0.72f}, white);
    scene.lamps.push_back(test::pointLamp({3, 2.2f, 2.5f}, 200));
  }
};

Room room(const std::string& name, float x0, float z0, float x1, float z1) {
  Room r;
  r.name = name, r.floor = {{x0, z0}, {x0, z1}, {x1, z1}, {x1, z0}}, r.heightM = 2.6f;
  return r;
}

Measurements measured(const Scene& scene, const MeterPlan& plan) {
  const RenderProgress quiet;
  RenderStats stats;
  Stages stages(quiet, stats);
  RenderSettings settings;
  settings.technique = "path";
  MeasureSettings measure;
  measure.meters.tolerance = 0.1;
  return roomlight::measure(*lightScene(scene, settings, stages).value(), plan, measure, stages);
}

TEST(MeterPlace, isToldByWhatIsAround) {
  const House house;
  const RayScene rays(house.scene);
  EXPECT_EQ(placeOf(rays, {3, 0.85f, 2.5f}), MeterPlace::Free);
  EXPECT_EQ(placeOf(rays, {0.02f, 0.85f, 0.02f}), MeterPlace::Free) << "in a corner, close to walls";
  EXPECT_EQ(placeOf(rays, {3, 0, 2.5f}), MeterPlace::Free) << "on the floor";
  EXPECT_EQ(placeOf(rays, {3, 2.6f, 2.5f}), MeterPlace::Free) << "on the ceiling";
  EXPECT_EQ(placeOf(rays, {5, 2, 0.4f}), MeterPlace::Free) << "on top of the wardrobe";
  EXPECT_EQ(placeOf(rays, {5, 1, 0.4f}), MeterPlace::Furniture);
  EXPECT_EQ(placeOf(rays, {3, 1, -0.15f}), MeterPlace::Wall);
  EXPECT_EQ(placeOf(rays, {-0.1f, 1, 3}), MeterPlace::Wall);
  EXPECT_EQ(placeOf(rays, {3, 2.7f, 2.5f}), MeterPlace::Wall) << "in the roof";
  EXPECT_EQ(placeOf(rays, {-6, 1, 2}), MeterPlace::Outdoors);
  EXPECT_EQ(placeOf(rays, {3, 5, 2}), MeterPlace::Outdoors) << "above the roof";
}

TEST(MeterPlace, aRoomOfFacesThatLookOutwardsIsNoWall) {
  Scene scene;
  test::addBox(scene, {0, 0, 0}, {4, 3, 4}, test::addMaterial(scene, test::lambertian(0.7f)));
  const RayScene rays(scene);
  for (const Vec3 p : {Vec3{2, 1, 2}, {0.1f, 0.1f, 0.1f}, {2, 2.9f, 3.9f}})
    EXPECT_EQ(placeOf(rays, p), MeterPlace::Free);
}

// A fridge of two boxes, one inside the other and turned inside out, as models of opened furniture are.
TEST(MeterPlace, aThingWithSurfacesInsideIsFurniture) {
  House house;
  const int number = static_cast<int>(house.scene.instances.size());
  test::addBox(house.scene, {1, 0, 3}, {1.7f, 1.8f, 3.7f}, house.white);
  test::addRoom(house.scene, {1.05f, 0.05f, 3.05f}, {1.65f, 1.75f, 3.65f}, std::vector<int>(6, house.white));
  for (size_t i = static_cast<size_t>(number); i < house.scene.instances.size(); ++i) {
    house.scene.instances[i].object = 77;
  }
  const RayScene rays(house.scene);
  EXPECT_EQ(placeOf(rays, {1.4f, 0.85f, 3.4f}), MeterPlace::Furniture);
  EXPECT_EQ(placeOf(rays, {1.4f, 1.85f, 3.4f}), MeterPlace::Free) << "on top of it";
}

TEST(MeterPlace, pointsOfAGridInWallsAndOutdoorsAreNotItsMinimum) {
  const House house;
  MeterPlan plan;
  plan.grid = {0.2, 0, 0};
  // Drawn too large: half of it lies in the wall and in the garden.
  plan.rooms = {planRoom(room("Room", 0, 0, 6, 8))};
  const Measurements m = measured(house.scene, plan);
  const GridReading& g = m.grids.at(0);
  EXPECT_FALSE(g.outdoors);
  size_t ofPlace[4] = {};
  for (const LeftOutCell& c : g.leftOut) {
    ++ofPlace[static_cast<size_t>(c.place)];
    EXPECT_FALSE(g.points.lattice.used[c.cell]);
    EXPECT_TRUE(std::isnan(g.points.lux[c.cell]));
  }
  // Cells of 0.2 m: 14 rows of 30 in the garden, one in the wall, 4 of 7 in the wardrobe.
  EXPECT_EQ(ofPlace[static_cast<size_t>(MeterPlace::Outdoors)], 14u * 30);
  EXPECT_EQ(ofPlace[static_cast<size_t>(MeterPlace::Wall)], 30u);
  EXPECT_EQ(ofPlace[static_cast<size_t>(MeterPlace::Furniture)], 4u * 7);
  EXPECT_GT(g.lux().least, 1) << "it is dark in the wall and in the garden";
  ASSERT_EQ(misplaced(m).size(), 3u);
  for (const char* words : {"in furniture: ", "in a wall, floor or ceiling: ", "outdoors: "}) {
    EXPECT_EQ(std::count_if(m.warnings.begin(), m.warnings.end(),
                            [&](const std::string& w) {
                              return w.starts_with(words) && w.find("'Room, work plane'") != std::string::npos;
                            }),
              1)
        << words;
  }
}

TEST(MeterPlace, aTerraceIsMeasuredButNoPartOfTheHome) {
  const House house;
  MeterPlan plan;
  plan.rooms = {planRoom(room("Room", 0, 0, 6, 5)), planRoom(room("Terrace", 8, 0, 11, 5))};
  const Measurements m = measured(house.scene, plan);
  ASSERT_EQ(m.grids.size(), 2u);
  EXPECT_FALSE(m.grids[0].outdoors);
  EXPECT_TRUE(m.grids[1].outdoors);
  EXPECT_GT(m.grids[1].lux().points, 10u);
  const auto means = homeMeans(m);
  ASSERT_TRUE(means);
  EXPECT_EQ(means->rooms, 1u);
  EXPECT_DOUBLE_EQ(means->ofAreaLux, m.grids[0].lux().mean);
}

TEST(MeterPlace, whereThereIsNoRoofNothingIsOutdoors) {
  const House house(false);
  MeterPlan plan;
  plan.rooms = {planRoom(room("Room", 0, 0, 6, 5)), planRoom(room("Terrace", 8, 0, 11, 5))};
  const Measurements m = measured(house.scene, plan);
  EXPECT_FALSE(m.grids[0].outdoors);
  EXPECT_FALSE(m.grids[1].outdoors);
  EXPECT_EQ(homeMeans(m)->rooms, 2u);
}

TEST(MeterPlace, metersInThingsAreReadAndMarkedButNotJudged) {
  const House house;
  MeterPlan plan;
  Targets targets;
  targets.lux = Target{1, "test"};
  plan.points = {{"free", {{3, 0.85f, 2.5f}, {0, 1, 0}}, targets},
                 {"in the wardrobe", {{5, 1, 0.4f}, {0, 1, 0}}, targets},
                 {"in the wall", {{3, 1, -0.15f}, {0, 1, 0}}, targets}};
  const Measurements m = measured(house.scene, plan);
  ASSERT_EQ(m.points.size(), 3u);
  EXPECT_EQ(m.points[0].place, MeterPlace::Free);
  EXPECT_EQ(m.points[1].place, MeterPlace::Furniture);
  EXPECT_EQ(m.points[2].place, MeterPlace::Wall);
  EXPECT_GT(m.points[0].lux, 10);
  const std::vector<Verdict> verdicts = verdictsOf(m);
  ASSERT_EQ(verdicts.size(), 1u);
  EXPECT_EQ(verdicts[0].where, "free");
  EXPECT_EQ(misplaced(m),
            (std::vector<std::string>{"in furniture: 1 meter, read but not judged ('in the wardrobe')",
                                      "in a wall, floor or ceiling: 1 meter, read but not judged ('in the wall')"}));
}

}  // namespace
}  // namespace roomlight
