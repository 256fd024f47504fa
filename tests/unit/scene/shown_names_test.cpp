// What people call things, beside the names that files give them for programs.
#include "scene/shown_names.h"

#include <gtest/gtest.h>

#include "support/rooms.h"

namespace roomlight {
namespace {

using Names = std::vector<std::string>;

TEST(ShownNames, numbersOfCopiesGoWhereNothingElseIsCalledSo) {
  EXPECT_EQ(withoutCopyNumbers({"Chair.001", "Table", "Lamp.01", "Mesh.001_12", ".001", "v1.2000"}),
            (Names{"Chair", "Table", "Lamp.01", "Mesh.001_12", ".001", "v1"}));
  EXPECT_EQ(withoutCopyNumbers({"Chair", "Chair.001"}), (Names{"Chair", "Chair.001"}));
  EXPECT_EQ(withoutCopyNumbers({"Chair.001", "Chair.002"}), (Names{"Chair.001", "Chair.002"}));
}

TEST(ShownNames, objectsGoByTheirLabels) {
  Scene scene;
  const int grey = test::addMaterial(scene, test::lambertian(0.5f));
  for (const char* name : {"wall-0-15", "Shelf.003"}) {
    test::addRectangle(scene, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}, grey);
    scene.instances.back().name = name;
  }
  scene.instances[0].label = "Wall, Kitchen, north";
  const std::map<int, std::string> shown = shownObjectNames(scene);
  EXPECT_EQ(shown.at(scene.instances[0].object), "Wall, Kitchen, north");
  EXPECT_EQ(shown.at(scene.instances[1].object), "Shelf");
}

TEST(ShownNames, lampsGoByTheThingsThatTheyAre) {
  Scene scene;
  const int shining = test::addMaterial(scene, test::lambertian(0, 100));
  test::addRectangle(scene, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}, shining);
  scene.instances.back().name = "lamp17", scene.instances.back().label = "Floor lamp";
  scene.lamps = {test::pointLamp({5, 2, 5}, 10)};
  scene.lamps[0].name = "Point.001";
  EXPECT_EQ(shownLampNames(scene, findLamps(scene)), (Names{"Point", "Floor lamp"}));
}

Material called(const std::string& name, Vec3 colour = Vec3(0.8f)) {
  Material m = test::lambertian(0.5f);
  m.name = name, m.baseColor = colour;
  return m;
}

TEST(ShownNames, materialsGoByWordsAndNotByCodes) {
  EXPECT_EQ(shownMaterialName(called("Oak veneer")), "Oak veneer");
  EXPECT_EQ(shownMaterialName(called("Stoff_07")), "Stoff_07");
  EXPECT_EQ(shownMaterialName(called("wire_204204204", Vec3(0.6f))), "light grey");
  EXPECT_EQ(shownMaterialName(called("Material.001", Vec3(0.85f))), "white");
  EXPECT_EQ(shownMaterialName(called("lambert2SG", {0.5f, 0.02f, 0.02f})), "red");
  EXPECT_EQ(shownMaterialName(called("FrontColor", {0.2f, 0.1f, 0.04f})), "brown");
  EXPECT_EQ(shownMaterialName(called("")), "white");
  Material glass = called("mat_3");
  glass.transmission = 1;
  EXPECT_EQ(shownMaterialName(glass), "glass");
  Material metal = called("mat_4", Vec3(0.3f));
  metal.metallic = 1;
  EXPECT_EQ(shownMaterialName(metal), "grey metal");
  Material picture = called("mat_5");
  picture.baseColorTexture.texture = 0;
  EXPECT_EQ(shownMaterialName(picture), "mat_5") << "nothing better is known";
}

TEST(ShownNames, labelsSayWhatColourAnEvenMaterialHasNow) {
  Material paint = called("wall", Vec3(0.85f));
  paint.label = "wall paint";
  EXPECT_EQ(shownMaterialName(paint), "white wall paint");
  EXPECT_EQ(shownMaterialName(paint, {0.02f, 0.05f, 0.4f}), "dark blue wall paint");
  Material oak = called("floor");
  oak.label = "Oak floor", oak.baseColorTexture.texture = 0;
  EXPECT_EQ(shownMaterialName(oak), "Oak floor");
}

TEST(ShownNames, coloursAreSaidAsPeopleDo) {
  EXPECT_EQ(colourInWords(Vec3(0)), "black");
  EXPECT_EQ(colourInWords(Vec3(0.85f)), "white");
  EXPECT_EQ(colourInWords(Vec3(0.2f)), "grey");
  EXPECT_EQ(colourInWords(Vec3(0.05f)), "dark grey");
  EXPECT_EQ(colourInWords({0.02f, 0.2f, 0.03f}), "green");
  EXPECT_EQ(colourInWords({0.8f, 0.6f, 0.02f}), "yellow");
  EXPECT_EQ(colourInWords({0.65f, 0.55f, 0.4f}), "beige");
}

}  // namespace
}  // namespace roomlight
