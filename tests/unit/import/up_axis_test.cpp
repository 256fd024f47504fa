#include "import/up_axis.h"

#include <gtest/gtest.h>

#include <array>

#include "scene/primitives.h"

namespace roomlight::importers {
namespace {

// A scene made with y up, and the same as a program with z up writes it.
Scene withZUp(Scene scene) {
  for (Instance& i : scene.instances)
    i.worldFromObject = Affine{{1, 0, 0}, {0, 0, 1}, {0, -1, 0}, {}} * i.worldFromObject;
  return scene;
}

void expectFound(const Scene& yUp, const char* what) {
  EXPECT_EQ(guessUpAxis(yUp, 1, UpAxis::Y), UpAxis::Y) << what;
  EXPECT_EQ(guessUpAxis(withZUp(yUp), 1, UpAxis::Y), UpAxis::Z) << what;
}

Scene room(Vec3 size) {
  Scene s;
  const int grey = addMaterial(s, lambertian(0.5f));
  addRoom(s, {0, 0, 0}, size, std::vector<int>(6, grey));
  return s;
}

TEST(UpAxis, roomsByTheirStoreys) {
  expectFound(room({5, 2.6f, 4}), "closed room");
  Scene house = room({8, 2.5f, 9});
  addRoom(house, {0, 2.8f, 0}, {8, 5.3f, 9}, std::vector<int>(6, 0));
  addBox(house, {1, 0, 1}, {2, 0.8f, 3}, 0);
  expectFound(house, "two storeys");
}

TEST(UpAxis, aTableByItsLegs) {
  Scene s;
  const int grey = addMaterial(s, lambertian(0.5f));
  addBox(s, {-1, 0.75f, -0.5f}, {1, 0.8f, 0.5f}, grey);
  for (const float x : {-0.95f, 0.85f}) {
    for (const float z : {-0.45f, 0.35f}) addBox(s, {x, 0, z}, {x + 0.1f, 0.75f, z + 0.1f}, grey);
  }
  expectFound(s, "table");
}

TEST(UpAxis, aStandingLampByItsRoundness) {
  Scene s;
  const int grey = addMaterial(s, lambertian(0.5f));
  addTube(s, {0, 0, 0}, 0.15f, 0.02f, grey);
  addTube(s, {0, 0, 0}, 0.02f, 1.5f, grey);
  addTube(s, {0, 1.5f, 0}, 0.2f, 0.3f, grey);
  expectFound(s, "lamp");
}

// What may be either stays what the format usually is.
TEST(UpAxis, doubtStaysWithTheUsual) {
  Scene picture;
  const int grey = addMaterial(picture, lambertian(0.5f));
  addBox(picture, {-0.5f, -0.4f, 0}, {0.5f, 0.4f, 0.02f}, grey);
  const Scene cube = room({2, 2, 2}), tall = room({5, 3.5f, 2.6f});
  Scene openFront = room({2, 2, 2});
  openFront.instances.pop_back(), openFront.meshes.pop_back();
  for (const Scene* s : std::array<const Scene*, 4>{&picture, &cube, &tall, &openFront})
    EXPECT_EQ(guessUpAxis(*s, 1, UpAxis::Y), UpAxis::Y);
  EXPECT_EQ(guessUpAxis(cube, 1, UpAxis::Z), UpAxis::Z);
}

TEST(UpAxis, turnsAllThatHasADirection) {
  Scene s = room({5, 2.6f, 4});
  s.suns.push_back({"sun", {0, 0, 1}, Vec3(1), 0});
  s.cameras.emplace_back();
  s.cameras[0].worldFromCamera = looking({1, 2, 3}, {0, 1, 0});
  s.lamps.emplace_back();
  s.lamps[0].position = {1, 2, 3}, s.lamps[0].direction = {0, 0, -1};
  turnUpright(s, UpAxis::Z);
  EXPECT_EQ(s.suns[0].toLight, Vec3(0, 1, 0));
  EXPECT_EQ(s.lamps[0].position, Vec3(1, 3, -2));
  EXPECT_EQ(s.lamps[0].direction, Vec3(0, -1, 0));
  EXPECT_EQ(s.cameras[0].worldFromCamera.w, Vec3(1, 3, -2));
  EXPECT_FLOAT_EQ(s.bounds().hi.y, 4);
}

}  // namespace
}  // namespace roomlight::importers
