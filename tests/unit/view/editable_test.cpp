// Lamps and things are found, changed one by one, and come back.
#include "view/editable.h"

#include <gtest/gtest.h>

#include "scene/validate.h"
#include "support/rooms.h"
#include "view/apply_edit.h"
#include "view/describe.h"
#include "view/home.h"

namespace roomlight::view {
namespace {

// Two boxes of one material and one mesh each, two panels that share a material, a spot, an area lamp.
ViewHome smallHome() {
  Scene scene;
  const int white = test::addMaterial(scene, test::lambertian(0.7f)),
            wood = test::addMaterial(scene, test::lambertian(0.4f)),
            shining = test::addMaterial(scene, test::lambertian(0, 100));
  test::addRoom(scene, {0, 0, 0}, {6, 2.6f, 5}, std::vector<int>(6, white));
  for (const float x : {1.0f, 3.0f}) {
    const auto first = static_cast<uint32_t>(scene.instances.size());
    test::addBox(scene, {x, 0, 1}, {x + 1, 0.7f, 2}, wood);
    for (uint32_t i = first; i < scene.instances.size(); ++i)
      scene.instances[i].object = scene.instances[first].object, scene.instances[i].name = "Box";
  }
  for (const float x : {1.0f, 3.0f}) {
    test::addRectangle(scene, {x, 2.55f, 2}, {0.5f, 0, 0}, {0, 0, 0.5f}, shining);
    scene.instances.back().name = "Panel";
  }
  Lamp spot;
  spot.name = "Spot", spot.kind = LampKind::Spot, spot.position = {2, 2.4f, 2}, spot.intensityCd = Vec3(100);
  Lamp area;
  area.name = "Area", area.kind = LampKind::Area, area.position = {4, 2.4f, 2}, area.direction = {0, -1, 0},
  area.up = {0, 0, -1};
  area.widthM = 1, area.heightM = 0.5f, area.luminanceCdM2 = Vec3(500);
  scene.lamps = {spot, area};
  addAreaLampMeshes(scene);
  return ViewHome("small", std::move(scene));
}

// A door that shuts the wall at z = 2: its frame, a leaf at its left half that turns by a right angle to +z, one at its
// right half that slides to the right.
ViewHome homeWithDoor(float firstAtRest = 0) {
  Scene scene;
  const int white = test::addMaterial(scene, test::lambertian(0.7f)),
            wood = test::addMaterial(scene, test::lambertian(0.4f));
  test::addRoom(scene, {0, 0, 0}, {6, 2.6f, 5}, std::vector<int>(6, white));
  scene.leaves.resize(2);
  scene.leaves[0].hinge = {2, 0, 2}, scene.leaves[0].turnRad = -kPi / 2, scene.leaves[0].atRest = firstAtRest;
  scene.leaves[1].slideM = {0.5f, 0, 0};
  for (const int leaf : {-1, 0, 1}) {
    test::addRectangle(scene, {leaf == 1 ? 2.5f : 2, 0, 2}, {leaf < 0 ? 1.0f : 0.5f, 0, 0}, {0, 2, 0}, wood);
    Instance& i = scene.instances.back();
    i.name = "Door", i.object = 1000, i.leaf = leaf;
  }
  return ViewHome("door", std::move(scene));
}

size_t lampNamed(const ViewHome& home, const std::string& name, size_t number = 0) {
  for (size_t i = 0; i < home.editable.lamps.size(); ++i) {
    if (home.editable.lamps[i].name == name && number-- == 0) return i;
  }
  ADD_FAILURE() << name;
  return 0;
}
size_t objectNamed(const ViewHome& home, const std::string& name) {
  for (size_t i = 0; i < home.editable.objects.size(); ++i) {
    if (home.editable.objects[i].name == name) return i;
  }
  ADD_FAILURE() << name;
  return 0;
}

void expectSame(const Scene& a, const Scene& b) {
  for (size_t i = 0; i < a.instances.size(); ++i) {
    EXPECT_EQ(a.instances[i].mesh, b.instances[i].mesh);
    EXPECT_TRUE(a.instances[i].worldFromObject == b.instances[i].worldFromObject) << i;
  }
  for (size_t i = 0; i < a.materials.size(); ++i) {
    EXPECT_EQ(a.materials[i].emission, b.materials[i].emission);
    EXPECT_EQ(a.materials[i].baseColor, b.materials[i].baseColor);
  }
  for (size_t i = 0; i < a.lamps.size(); ++i) {
    EXPECT_EQ(a.lamps[i].intensityCd, b.lamps[i].intensityCd);
    EXPECT_EQ(a.lamps[i].position, b.lamps[i].position);
    EXPECT_EQ(a.lamps[i].direction, b.lamps[i].direction);
  }
}

TEST(Editable, findsLampsAndThings) {
  const ViewHome home = smallHome();
  ASSERT_EQ(home.editable.lamps.size(), 4u);
  const EditableLamp& area = home.editable.lamps[lampNamed(home, "Area")];
  EXPECT_EQ(area.kind, "area");
  EXPECT_NEAR(area.fluxLm, 500 * 0.5 * 3.14159265, 0.1);
  EXPECT_EQ(area.instances.size(), 1u);
  EXPECT_TRUE(home.editable.objects[objectNamed(home, "Area")].lampBody);
  const EditableLamp& panel = home.editable.lamps[lampNamed(home, "Panel", 1)];
  EXPECT_NEAR(panel.fluxLm, 100 * 0.25 * 3.14159265, 0.01);
  EXPECT_NEAR(panel.position.x, 3.25f, 1e-5f);
  EXPECT_TRUE(home.editable.objects[objectNamed(home, "Box")].movable);
  EXPECT_TRUE(validate(home.scene).ok());
}

TEST(Editable, eachIsChangedAlone) {
  const ViewHome home = smallHome();
  HomeState next = home.atStart();
  next.objects[objectNamed(home, "Box")].colors[0] = {0.9f, 0, 0};
  next.lamps[lampNamed(home, "Panel", 1)].dim = 0.5f;
  Scene scene = home.scene;
  const SceneChange change = stage(home.editable, home.atStart(), next, scene);
  EXPECT_EQ(change.glow.size(), 1u);
  EXPECT_EQ(change.moved.size(), home.editable.objects[objectNamed(home, "Box")].parts.size());
  int red = 0, dimmed = 0;
  for (const Instance& i : scene.instances) {
    const Material& m = scene.materials[static_cast<size_t>(scene.meshes[static_cast<size_t>(i.mesh)].material)];
    red += m.baseColor == Vec3(0.9f, 0, 0) ? 1 : 0;
    dimmed += m.emission == Vec3(50) ? 1 : 0;
  }
  EXPECT_EQ(red, 6);
  EXPECT_EQ(dimmed, 1);
  stage(home.editable, next, home.atStart(), scene);
  expectSame(scene, home.scene);
}

TEST(Editable, thingsTurnAboutTheirMiddle) {
  const ViewHome home = smallHome();
  const size_t box = objectNamed(home, "Box");
  HomeState next = home.atStart();
  next.objects[box].move = {0, 0, 1}, next.objects[box].turnDeg = 45;
  const Bounds3 b = boundsOf(home.editable.objects[box], next.objects[box]);
  EXPECT_NEAR(b.centre().x, 1.5f, 1e-4f);
  EXPECT_NEAR(b.centre().z, 2.5f, 1e-4f);
  EXPECT_NEAR(b.size().x, std::sqrt(2.0f), 1e-4f);
  EXPECT_NEAR(b.size().y, 0.7f, 1e-4f);
}

TEST(Editable, areaLampsTakeTheirRectangleAlong) {
  const ViewHome home = smallHome();
  const size_t lamp = lampNamed(home, "Area");
  HomeState next = home.atStart();
  next.lamps[lamp].position = {4, 1, 2}, next.lamps[lamp].direction = {1, 0, 0};
  Scene scene = home.scene;
  const SceneChange change = stage(home.editable, home.atStart(), next, scene);
  ASSERT_EQ(change.moved.size(), 1u);
  const Bounds3 b = instanceBounds(scene, scene.instances[change.moved[0]]);
  EXPECT_NEAR(b.size().x, 0, 1e-5f);
  EXPECT_NEAR(length(b.centre() - Vec3{4, 1, 2}), 0, 1e-5f);
  const Lamp& moved = scene.lamps[home.editable.lamps[lamp].sources[0].lamp];
  EXPECT_NEAR(dot(moved.up, moved.direction), 0, 1e-6f);
}

TEST(Editable, hiddenThingsGiveNoLight) {
  const ViewHome home = smallHome();
  HomeState next = home.atStart();
  const size_t lamp = lampNamed(home, "Panel");
  next.objects[static_cast<size_t>(home.editable.lamps[lamp].object)].hidden = true;
  Scene scene = home.scene;
  stage(home.editable, home.atStart(), next, scene);
  EXPECT_EQ(scene.instances[home.editable.lamps[lamp].instances[0]].mesh, home.editable.hiddenMesh);
  EXPECT_TRUE(isBlack(scene.materials[home.editable.lamps[lamp].glows[0].material].emission));
}

TEST(Editable, leavesOpenAndTheirFrameStays) {
  const ViewHome home = homeWithDoor();
  ASSERT_TRUE(validate(home.scene).ok());
  const size_t door = objectNamed(home, "Door");
  const EditableObject& object = home.editable.objects[door];
  ASSERT_TRUE(object.opens);
  HomeState next = home.atStart();
  EXPECT_EQ(next.objects[door].open, 0);
  next.objects[door].open = 1;
  Scene scene = home.scene;
  const SceneChange change = stage(home.editable, home.atStart(), next, scene);
  EXPECT_EQ(change.moved, (std::vector<uint32_t>{object.parts[1].instance, object.parts[2].instance}));
  EXPECT_FALSE(change.lamps);
  const Bounds3 turned = instanceBounds(scene, scene.instances[object.parts[1].instance]),
                slid = instanceBounds(scene, scene.instances[object.parts[2].instance]);
  EXPECT_NEAR(length(turned.lo - Vec3{2, 0, 2}), 0, 1e-5f);
  EXPECT_NEAR(length(turned.hi - Vec3{2, 2, 2.5f}), 0, 1e-5f);
  EXPECT_NEAR(length(slid.hi - Vec3{3.5f, 2, 2}), 0, 1e-5f);
  const Bounds3 all = boundsOf(object, next.objects[door]);
  EXPECT_NEAR(length(all.lo - Vec3{2, 0, 2}), 0, 1e-5f);
  EXPECT_NEAR(length(all.hi - Vec3{3.5f, 2, 2.5f}), 0, 1e-5f);
  stage(home.editable, next, home.atStart(), scene);
  expectSame(scene, home.scene);
}

TEST(Editable, leavesTurnWithTheirThing) {
  const ViewHome home = homeWithDoor();
  const size_t door = objectNamed(home, "Door");
  HomeState next = home.atStart();
  next.objects[door].open = 1, next.objects[door].turnDeg = 180, next.objects[door].move = {0, 0, 1};
  Scene scene = home.scene;
  stage(home.editable, home.atStart(), next, scene);
  const Bounds3 turned = instanceBounds(scene, scene.instances[home.editable.objects[door].parts[1].instance]);
  EXPECT_NEAR(length(turned.lo - Vec3{3, 0, 2.5f}), 0, 1e-5f);  // to the other side of the other end
  EXPECT_NEAR(length(turned.hi - Vec3{3, 2, 3}), 0, 1e-5f);
}

// One leaf is wide open, the other shut: that stays when the door is painted, and from there both can be shut and both
// opened.
TEST(Editable, leavesThatTheFileHasOpen) {
  const ViewHome home = homeWithDoor(1);
  const size_t door = objectNamed(home, "Door");
  const EditableObject& object = home.editable.objects[door];
  HomeState next = home.atStart();
  EXPECT_EQ(next.objects[door].open, 0.5f);
  next.objects[door].colors[0] = {0.9f, 0, 0};
  Scene scene = home.scene;
  EXPECT_EQ(stage(home.editable, home.atStart(), next, scene).moved.size(), 3u);
  for (const EditableObject::Part& part : object.parts)
    EXPECT_TRUE(scene.instances[part.instance].worldFromObject == part.atRest);
  HomeState shut = next, wide = next;
  shut.objects[door].open = 0, wide.objects[door].open = 1;
  EXPECT_EQ(stage(home.editable, next, shut, scene).moved, std::vector<uint32_t>{object.parts[1].instance});
  EXPECT_EQ(stage(home.editable, shut, wide, scene).moved.size(), 2u);
  EXPECT_TRUE(scene.instances[object.parts[1].instance].worldFromObject == object.parts[1].atRest);
  EXPECT_NEAR(scene.instances[object.parts[2].instance].worldFromObject.w.x - object.parts[2].atRest.w.x, 0.5f, 1e-6f);
}

TEST(ApplyEdit, opensWhatHasLeaves) {
  const ViewHome home = homeWithDoor();
  const size_t door = objectNamed(home, "Door");
  Edited out;
  Edit edit;
  edit.id = 7, edit.target = "object:" + std::to_string(door), edit.set.open = 0.25f;
  EXPECT_FALSE(applyEdit(home.editable, home.scene, edit, home.atStart(), out));
  EXPECT_EQ(out.state.objects[door].open, 0.25f);
  EXPECT_EQ(out.label, "Open Door");
}

TEST(ApplyEdit, refusesAsAWhole) {
  const ViewHome home = smallHome();
  const HomeState now = home.atStart();
  Edited out;
  Edit edit;
  edit.id = 7;
  const auto refused = [&](const std::string& target, auto set) {
    edit.target = target, edit.set = {};
    set(edit.set);
    const auto e = applyEdit(home.editable, home.scene, edit, now, out);
    return e ? e->field : "taken";
  };
  const std::string spot = "lamp:" + std::to_string(lampNamed(home, "Spot")),
                    panel = "lamp:" + std::to_string(lampNamed(home, "Panel")),
                    box = "object:" + std::to_string(objectNamed(home, "Box"));
  EXPECT_EQ(refused(spot, [](EditFields& s) { s.direction = Vec3(1, 0, 0); }), "taken");
  EXPECT_EQ(refused(spot, [](EditFields& s) { s.move = Vec3(1, 0, 0); }), "move");
  EXPECT_EQ(refused(panel, [](EditFields& s) { s.position = Vec3(1, 0, 0); }), "position");
  EXPECT_EQ(refused(panel, [](EditFields& s) { s.color = Vec3(0); }), "color");
  EXPECT_EQ(refused(box, [](EditFields& s) { s.color = Vec3(2); }), "color");
  EXPECT_EQ(refused(box, [](EditFields& s) { s.dim = 0; }), "dim");
  EXPECT_EQ(refused(box, [](EditFields& s) { s.open = 1; }), "open");
  EXPECT_EQ(refused(panel, [](EditFields& s) { s.dim = 0, s.alone = true; }), "alone");
  EXPECT_EQ(refused(box, [](EditFields&) {}), "target");
  EXPECT_EQ(refused("object:0", [](EditFields& s) { s.move = Vec3(1); }), "move");  // a wall
  EXPECT_EQ(refused("object:" + std::to_string(objectNamed(home, "Area")), [](EditFields& s) { s.hidden = true; }),
            "target");
  for (const char* target : {"lamp:", "lamp:-1", "lamp:99", "lamp:1x", "object", "sky", ""})
    EXPECT_EQ(refused(target, [](EditFields& s) { s.dim = 0; }), "target") << target;
  EXPECT_EQ(refused("sun", [](EditFields& s) { s.hour = 3; }), "target");
}

// Names of files stay what lighting files go by; people see others.
TEST(Editable, thingsLampsAndMaterialsAreCalledAsPeopleDo) {
  Scene scene = smallHome().scene;
  for (Instance& i : scene.instances) {
    if (i.name == "Box" && i.object == scene.instances[6].object) i.label = "Wall, Kitchen, north";
  }
  for (Material& m : scene.materials) m.name = "Material.001";
  scene.lamps[0].name = "Spot.004";
  const ViewHome home("small", std::move(scene));
  const auto wall = std::find_if(home.editable.objects.begin(), home.editable.objects.end(),
                                 [](const EditableObject& o) { return o.label == "Wall, Kitchen, north"; });
  ASSERT_NE(wall, home.editable.objects.end());
  EXPECT_EQ(wall->name, "Box");
  const EditableLamp& spot = home.editable.lamps.at(lampNamed(home, "Spot.004"));
  EXPECT_EQ(spot.label, "Spot");
  const auto k = static_cast<size_t>(wall - home.editable.objects.begin());
  const Json object = objectJson(home.editable, home.scene, k, home.editable.atStart);
  EXPECT_EQ(object["name"], "Wall, Kitchen, north");
  EXPECT_EQ(object["colors"][0]["material"], "Material.001");
  const std::string grey = object["colors"][0]["label"];
  EXPECT_EQ(grey, "grey");
  Edit edit;
  edit.target = objectId(k);
  edit.set.color = Vec3(0.5f, 0.02f, 0.02f), edit.set.material = grey;
  Edited red;
  ASSERT_FALSE(applyEdit(home.editable, home.scene, edit, home.editable.atStart, red));
  EXPECT_EQ(red.label, "Colour Wall, Kitchen, north");
  EXPECT_EQ(objectJson(home.editable, home.scene, k, red.state)["colors"][0]["label"], "red");
}

}  // namespace
}  // namespace roomlight::view
