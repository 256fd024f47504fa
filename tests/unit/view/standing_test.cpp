// What stands on a thing goes along with it.
#include "view/standing.h"

#include <gtest/gtest.h>

#include <set>

#include "unit/view/furnished_room.h"

namespace roomlight::view {
namespace {

using Names = std::set<std::string>;

struct Room {
  explicit Room(Scene scene) : home("room", std::move(scene)), shapes(home.editable, home.scene) {}
  size_t thing(const std::string& name) const { return thingNamed(home.editable, name); }
  Names on(const std::string& name) { return on(name, home.atStart()); }
  Names on(const std::string& name, const HomeState& state) {
    const Load load = findLoad(shapes, thing(name), state);
    Names out;
    for (const size_t i : load.things) out.insert(home.editable.objects[i].name);
    for (const size_t i : load.lamps) out.insert("lamp " + home.editable.lamps[i].name);
    return out;
  }
  // With its load.
  HomeState moved(const std::string& name, Vec3 move, float turnDeg, const HomeState& from, bool alone = false) {
    HomeState next = from;
    next.objects[thing(name)].move = move, next.objects[thing(name)].turnDeg = turnDeg;
    carry(home.editable, findLoad(shapes, thing(name), from), thing(name), alone, from, next);
    return next;
  }

  ViewHome home;
  ThingShapes shapes;
};

// A vase on books on a table with a chair under it; another table.
Scene tables() {
  Scene scene = emptyRoom();
  addTable(scene, "Table", 1, 1);
  addTable(scene, "Other table", 4, 1);
  addThing(scene, "Books", {{{1.2f, 0.75f, 1.2f}, {1.5f, 0.85f, 1.4f}}});
  addThing(scene, "Vase", {{{1.3f, 0.86f, 1.25f}, {1.4f, 1.1f, 1.35f}}});  // a centimetre above
  addThing(scene, "Chair", {{{1.4f, 0, 1.5f}, {1.8f, 0.45f, 2}}, {{1.4f, 0.45f, 1.81f}, {1.8f, 0.9f, 1.85f}}});
  return scene;
}

TEST(Standing, chainsGoAlongAndNeighboursStay) {
  Room room(tables());
  EXPECT_EQ(room.on("Table"), (Names{"Books", "Vase"}));
  EXPECT_EQ(room.on("Books"), Names{"Vase"});
  EXPECT_EQ(room.on("Vase"), Names{});
  EXPECT_EQ(room.on("Chair"), Names{});
}

TEST(Standing, followsEdits) {
  Room room(tables());
  HomeState state = room.home.atStart();
  state.objects[room.thing("Vase")].move = {3, -0.11f, 0.2f};
  EXPECT_EQ(room.on("Table", state), Names{"Books"});
  EXPECT_EQ(room.on("Other table", state), Names{"Vase"});
  state.objects[room.thing("Vase")].move.y += 0.1f;  // in mid-air
  EXPECT_EQ(room.on("Other table", state), Names{});
}

TEST(Standing, theMiddleDecidesAtAnEdge) {
  Scene scene = emptyRoom();
  addTable(scene, "Left", 1, 1);
  addTable(scene, "Right", 2.2f, 1);
  addThing(scene, "Tray", {{{1.9f, 0.75f, 1.2f}, {2.3f, 0.8f, 1.5f}}});       // three quarters on the left one
  addThing(scene, "Plate", {{{3.3f, 0.75f, 1.2f}, {3.55f, 0.77f, 1.5f}}});  // its middle beyond the edge, by a hair not
  addThing(scene, "Board", {{{3.35f, 0.75f, 1.55f}, {3.75f, 0.77f, 1.7f}}});  // would fall, if it were not fastened
  Room room(std::move(scene));
  EXPECT_EQ(room.on("Left"), Names{"Tray"});
  EXPECT_EQ(room.on("Right"), (Names{"Plate", "Board"}));
}

TEST(Standing, whatTwoThingsHoldStaysUnlessBothGo) {
  Scene scene = emptyRoom();
  addTable(scene, "Table", 1, 1);
  for (const float x : {1.1f, 1.8f})
    addThing(scene, x < 1.5f ? "Block" : "Other block", {{{x, 0.75f, 1.2f}, {x + 0.1f, 0.85f, 1.4f}}});
  addThing(scene, "Board", {{{1.1f, 0.85f, 1.2f}, {1.9f, 0.87f, 1.4f}}});
  Room room(std::move(scene));
  EXPECT_EQ(room.on("Block"), Names{});
  EXPECT_EQ(room.on("Table"), (Names{"Block", "Other block", "Board"}));
}

TEST(Standing, whatStandsOnARugStandsOnTheFloor) {
  Scene scene = emptyRoom();
  addThing(scene, "Rug", {{{0.5f, 0, 0.5f}, {3, 0.01f, 3}}});
  addTable(scene, "Table", 1, 1);
  for (Instance& i : scene.instances) {
    if (i.name == "Table") i.worldFromObject.w.y = 0.01f;
  }
  Room room(std::move(scene));
  EXPECT_EQ(room.on("Rug"), Names{});
}

TEST(Standing, aLampHasItsShadeAndItsLight) {
  Scene scene = emptyRoom();
  addTable(scene, "Table", 1, 1);
  addThing(scene, "Foot", {{{1.5f, 0.75f, 1.3f}, {1.7f, 0.78f, 1.5f}}});
  addThing(scene, "Stem", {{{1.59f, 0.77f, 1.39f}, {1.61f, 1.1f, 1.41f}}});
  test::addTube(scene, {1.6f, 1, 1.4f}, 0.12f, 0.22f, 0);  // touches nothing
  scene.instances.back().name = "Shade";
  Lamp bulb = test::pointLamp({1.6f, 1.12f, 1.4f}, 100), pendant = test::pointLamp({1.6f, 1.9f, 1.4f}, 100);
  bulb.name = "Bulb", pendant.name = "Pendant";
  scene.lamps = {bulb, pendant};
  Room room(std::move(scene));
  EXPECT_EQ(room.on("Table"), (Names{"Foot", "Stem", "Shade", "lamp Bulb"}));
  EXPECT_EQ(room.on("Shade"), Names{"lamp Bulb"});
}

TEST(Standing, whatIsPressedInGoesAlongWhatHangsOnAWallStays) {
  Scene scene = emptyRoom();
  addThing(scene, "Sofa", {{{1, 0, 0}, {3, 0.45f, 0.9f}}, {{1, 0.45f, 0}, {3, 0.9f, 0.2f}}});
  addThing(scene, "Cushion", {{{1.2f, 0.4f, 0.3f}, {1.6f, 0.6f, 0.6f}}});
  addThing(scene, "Picture", {{{1.5f, 0.8f, 0}, {2.2f, 1.5f, 0.03f}}});
  addThing(scene, "Side table", {{{3, 0, 0.2f}, {3.5f, 0.5f, 0.7f}}});
  Room room(std::move(scene));
  EXPECT_EQ(room.on("Sofa"), Names{"Cushion"});
  EXPECT_EQ(room.on("Side table"), Names{});
}

TEST(Standing, whatHangsBesideATallThingStays) {
  Scene scene = emptyRoom();
  addThing(scene, "Fridge", {{{1, 0, 0}, {1.6f, 2, 0.6f}}});
  addThing(scene, "Wall cupboard", {{{1.6f, 1.4f, 0.03f}, {2.2f, 2, 0.35f}}});
  addThing(scene, "Hook", {{{1.2f, 1.5f, 0.595f}, {1.22f, 1.52f, 0.65f}}});
  Room room(std::move(scene));
  EXPECT_EQ(room.on("Fridge"), Names{"Hook"});
}

TEST(Standing, aTurnCarriesAroundTheThingsAxis) {
  Scene scene = tables();
  Lamp spot;
  spot.name = "Spot", spot.kind = LampKind::Spot, spot.position = {1.3f, 0.8f, 1.3f}, spot.direction = {1, 0, 0};
  spot.up = {0, 1, 0}, spot.intensityCd = Vec3(100);
  scene.lamps = {spot};
  Room room(std::move(scene));
  const HomeState start = room.home.atStart();
  const HomeState turned = room.moved("Table", {0.5f, 0, 0}, 90, start);
  // The table's middle is at (1.6, 1.4), the vase 0.25 m to its left and 0.1 m behind it.
  const size_t vase = room.thing("Vase");
  const Vec3 at = boundsOf(room.home.editable.objects[vase], turned.objects[vase]).centre();
  EXPECT_NEAR(length(at - Vec3{2.1f - 0.1f, 0.98f, 1.4f + 0.25f}), 0, 1e-5f);
  EXPECT_EQ(turned.objects[vase].turnDeg, 90);
  ASSERT_EQ(turned.lamps.size(), 1u);
  EXPECT_NEAR(length(turned.lamps[0].position - Vec3{2.1f - 0.1f, 0.8f, 1.4f + 0.3f}), 0, 1e-5f);
  EXPECT_NEAR(length(turned.lamps[0].direction - Vec3{0, 0, -1}), 0, 1e-5f);
  Scene staged = room.home.scene;
  stage(room.home.editable, start, turned, staged);
  EXPECT_NEAR(length(staged.lamps[0].direction - Vec3{0, 0, -1}), 0, 1e-5f);
  EXPECT_TRUE(room.moved("Table", {}, 0, start) == start);
  EXPECT_EQ(room.moved("Table", {1, 0, 0}, 0, start, true).objects[vase].move, Vec3());
}

// Its rectangle turns too, though its direction stays.
TEST(Standing, lampsThatLookDownTurn) {
  Scene scene = emptyRoom();
  addThing(scene, "Shelf", {{{1, 1, 1}, {2, 1.04f, 1.5f}}});
  Lamp strip;
  strip.name = "Strip", strip.kind = LampKind::Area, strip.position = {1.5f, 0.99f, 1.25f};
  strip.direction = {0, -1, 0}, strip.up = {0, 0, -1}, strip.widthM = 0.8f, strip.heightM = 0.05f;
  strip.luminanceCdM2 = Vec3(500);
  scene.lamps = {strip};
  addAreaLampMeshes(scene);
  Room room(std::move(scene));
  EXPECT_EQ(room.on("Shelf"), Names{"lamp Strip"});
  const HomeState start = room.home.atStart(), turned = room.moved("Shelf", {}, 90, start);
  Scene staged = room.home.scene;
  stage(room.home.editable, start, turned, staged);
  EXPECT_NEAR(length(staged.lamps[0].direction - Vec3{0, -1, 0}), 0, 1e-5f);
  EXPECT_NEAR(length(staged.lamps[0].up - Vec3{-1, 0, 0}), 0, 1e-5f);
  const Bounds3 body = instanceBounds(staged, staged.instances[room.home.editable.lamps[0].instances[0]]);
  EXPECT_NEAR(body.size().z, 0.8f, 1e-4f);
}

}  // namespace
}  // namespace roomlight::view
