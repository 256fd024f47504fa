// Moved things that run into others are told of, those that touch, stand or did so at first are not.
#include "view/overlaps.h"

#include <gtest/gtest.h>

#include <set>

#include "unit/view/furnished_room.h"

namespace roomlight::view {
namespace {

using Names = std::set<std::pair<std::string, std::string>>;

struct Room {
  explicit Room(Scene scene) : home("room", std::move(scene)), shapes(home.editable, home.scene) {}
  ObjectState& thing(const std::string& name) { return next.objects[thingNamed(home.editable, name)]; }
  // In the state that `next` is, to which the home goes.
  Names overlaps() {
    all.follow(now, next);
    now = next;
    Names out;
    for (const Overlap& o : all.list())
      out.emplace(home.editable.objects[o.thing].name, home.editable.objects[o.into].name);
    return out;
  }
  Names moved(const std::string& name, Vec3 move, float turnDeg = 0) {
    thing(name).move = move, thing(name).turnDeg = turnDeg;
    return overlaps();
  }

  ViewHome home;
  ThingShapes shapes;
  HomeState now = home.atStart(), next = now;
  Overlaps all{shapes, now};
};

Scene sofaAndShelf() {
  Scene scene = emptyRoom();
  scene.instances[0].name = "Left wall";
  addThing(scene, "Sofa", {{{1, 0, 1}, {3, 0.8f, 1.9f}}});
  addThing(scene, "Shelf", {{{4, 0, 1}, {5, 1.8f, 1.4f}}});
  return scene;
}

TEST(Overlaps, namesTheTwo) {
  Room room(sofaAndShelf());
  EXPECT_EQ(room.moved("Sofa", {0.5f, 0, 0}), Names{});
  EXPECT_EQ(room.moved("Sofa", {1.1f, 0, 0}), (Names{{"Sofa", "Shelf"}}));
  EXPECT_EQ(room.moved("Sofa", {-1.1f, 0, 0}), (Names{{"Sofa", "Left wall"}}));
  EXPECT_EQ(room.moved("Sofa", {-0.5f, 0, 0}), Names{});
}

TEST(Overlaps, touchingDoesNotCount) {
  Room room(sofaAndShelf());
  EXPECT_EQ(room.moved("Sofa", {1, 0, 0}), Names{});
  EXPECT_EQ(room.moved("Sofa", {1.008f, 0, 0}), Names{});
  EXPECT_EQ(room.moved("Sofa", {1.012f, 0, 0}), (Names{{"Sofa", "Shelf"}}));
  EXPECT_EQ(room.moved("Sofa", {-1.008f, -0.01f, -1.007f}), Names{});  // in a corner, a little into the floor
  EXPECT_EQ(room.moved("Sofa", {0, 0.8f, 0}), Names{});
}

TEST(Overlaps, boxesAloneDoNotTell) {
  Scene scene = emptyRoom();
  addTable(scene, "Table", 1, 1);
  addThing(scene, "Stool", {{{3, 0, 1.2f}, {3.4f, 0.45f, 1.6f}}});
  Room room(std::move(scene));
  EXPECT_EQ(room.moved("Stool", {-1.6f, 0, 0}), Names{});  // under the table
  EXPECT_EQ(room.moved("Stool", {-1.6f, 0.3f, 0}), (Names{{"Stool", "Table"}}));
  // Turned by 45 degrees the box around it reaches into the leg, the stool itself does not.
  EXPECT_EQ(room.moved("Stool", {-1.9f, 0, -0.13f}), Names{});
  EXPECT_EQ(room.moved("Stool", {-0.53f, 0, -0.42f}, 45), Names{});
}

// Room to both sides: what meets on one side by 3 mm, is parted by 5 mm, and by 10 mm meets on the other.
TEST(Overlaps, inARecess) {
  Scene scene = emptyRoom();
  addThing(scene, "Recess", {{{2, 0, 0}, {2.2f, 1, 1}}, {{3, 0, 0}, {3.2f, 1, 1}}});
  addThing(scene, "Fridge", {{{2.203f, 0, 0.1f}, {2.997f, 1.8f, 0.9f}}});
  Room room(std::move(scene));
  EXPECT_EQ(room.moved("Fridge", {0.006f, 0, 0}), Names{});
  EXPECT_EQ(room.moved("Fridge", {0.02f, 0, 0}), (Names{{"Fridge", "Recess"}}));
}

// All but two of their faces lie in common planes.
TEST(Overlaps, alikeThingsInARow) {
  Scene scene = emptyRoom();
  addThing(scene, "Cupboard", {{{1, 0, 0}, {1.6f, 0.9f, 0.6f}}});
  addThing(scene, "Other cupboard", {{{3, 0, 0}, {3.6f, 0.9f, 0.6f}}});
  Room room(std::move(scene));
  EXPECT_EQ(room.moved("Cupboard", {1.4f, 0, 0}), Names{});
  EXPECT_EQ(room.moved("Cupboard", {1.7f, 0, 0}), (Names{{"Cupboard", "Other cupboard"}}));
  EXPECT_EQ(room.moved("Cupboard", {2, 0, 0}), (Names{{"Cupboard", "Other cupboard"}}));
}

TEST(Overlaps, whatIsInsideASolidCounts) {
  Scene scene = emptyRoom();
  addThing(scene, "Chimney", {{{3, 0, 1}, {4, 1.8f, 2}}});
  addThing(scene, "Clock", {{{1, 1, 1}, {1.2f, 1.2f, 1.1f}}});
  Room room(std::move(scene));
  EXPECT_EQ(room.moved("Clock", {2.4f, 0, 0.5f}), (Names{{"Clock", "Chimney"}}));
  EXPECT_EQ(room.moved("Clock", {0.5f, 0, 0}), Names{});  // inside the room is inside nothing
}

TEST(Overlaps, furnitureStandsOnRugs) {
  Scene scene = sofaAndShelf();
  addThing(scene, "Rug", {{{1, 0, 3}, {3, 0.03f, 4.5f}}});
  Room room(std::move(scene));
  EXPECT_EQ(room.moved("Sofa", {0.5f, 0, 1.5f}), Names{});
}

TEST(Overlaps, whatOverlappedAtFirstMayStay) {
  Scene scene = sofaAndShelf();
  addThing(scene, "Chest", {{{2.9f, 0, 1}, {3.5f, 0.5f, 1.8f}}});  // 10 cm in the sofa
  Room room(std::move(scene));
  EXPECT_EQ(room.moved("Chest", {0, 0, 0.3f}), Names{});  // as deep as before
  EXPECT_EQ(room.moved("Chest", {-0.05f, 0, 0}), (Names{{"Chest", "Sofa"}}));
  EXPECT_EQ(room.moved("Chest", {}), Names{});
  EXPECT_EQ(room.moved("Chest", {0.05f, 0, 0}), Names{});
  EXPECT_EQ(room.moved("Chest", {0.3f, 0, 0}), Names{});
  EXPECT_EQ(room.moved("Chest", {0.05f, 0, 0}), (Names{{"Chest", "Sofa"}}));  // anew
  EXPECT_EQ(room.moved("Chest", {}), Names{});                                // as in the file
}

TEST(Overlaps, whatMovesTogetherIsNotToldOf) {
  Scene scene = sofaAndShelf();
  addThing(scene, "Chest", {{{2.9f, 0, 1}, {3.5f, 0.5f, 1.8f}}});
  Room room(std::move(scene));
  room.thing("Sofa").move = {0, 0, 1};
  EXPECT_EQ(room.moved("Chest", {0, 0, 1}), Names{});
}

TEST(Overlaps, lastsUntilOneIsAwayOrHidden) {
  Room room(sofaAndShelf());
  const Names both{{"Sofa", "Shelf"}};
  EXPECT_EQ(room.moved("Sofa", {1.1f, 0, 0}), both);
  room.thing("Shelf").colors[0] = {1, 0, 0};
  EXPECT_EQ(room.overlaps(), both);
  room.thing("Shelf").hidden = true;
  EXPECT_EQ(room.overlaps(), Names{});
  room.thing("Shelf").hidden = false;
  EXPECT_EQ(room.overlaps().size(), 1u);
  EXPECT_EQ(room.moved("Shelf", {0.2f, 0, 0}), Names{});
}

}  // namespace
}  // namespace roomlight::view
