// Homes by the library: of arrays and of files, and what is said of bad ones.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "unit/library/arrays.h"

namespace roomlight::test {
namespace {

TEST(LibraryHome, FurnaceOfArraysHasTheIlluminanceOfItsClosedForm) {
  const BoxRoom room = smallRoom();
  MaterialValues material;
  material.baseColour = {0.5f, 0.5f, 0.5f};
  material.specular = 0;
  material.emissionCdM2 = {10, 10, 10};
  const auto home = Home::fromArrays(room.arrays(material));
  ASSERT_TRUE(home) << home.error().message;
  for (const char* technique : {"path", "hybrid"}) {
    MeterOptions options;
    options.technique = technique, options.tolerance = 0.002;
    const auto meters = Meters::of(*home, options);
    ASSERT_TRUE(meters) << meters.error().message;
    const float positions[] = {2, 1, 1.5f, 1, 0.8f, 1}, normals[] = {0, 1, 0, 0, 2, 0};
    const auto readings = meters->illuminance(positions, normals);
    ASSERT_TRUE(readings) << readings.error().message;
    ASSERT_EQ(readings->size(), 2u);
    // Radiance is L / (1 - albedo) everywhere.
    const double expected = std::numbers::pi * 10 / (1 - 0.5);
    for (const Reading& r : *readings) EXPECT_NEAR(r.lux, expected, 0.01 * expected) << technique;
  }
}

TEST(LibraryHome, TellsWhatItHas) {
  const BoxRoom room = smallRoom();
  const auto home = Home::fromArrays(room.arrays(), twoLamps());
  ASSERT_TRUE(home) << home.error().message;
  EXPECT_EQ(home->triangleCount(), 12u);
  EXPECT_FLOAT_EQ(home->bounds().second.y, 2.5f);
  EXPECT_EQ(home->metresPerUnit(), 1);
  ASSERT_EQ(home->cameras().size(), 2u);
  EXPECT_EQ(home->cameras()[1].name, "door");
  EXPECT_FALSE(home->cameras()[1].isProposed);
  EXPECT_EQ(home->defaultCamera(), "corner");
  ASSERT_EQ(home->lamps().size(), 2u);
  EXPECT_EQ(home->lamps()[1].name, "Right");
  EXPECT_NEAR(home->lamps()[1].fluxLm, 900, 1);
  EXPECT_TRUE(home->addedLighting().empty());
}

TEST(LibraryHome, LightIsAddedToArraysWithoutAny) {
  const BoxRoom room = smallRoom();
  const auto home = Home::fromArrays(room.arrays());
  ASSERT_TRUE(home) << home.error().message;
  EXPECT_NE(home->addedLighting().find("lamps"), std::string::npos);
  EXPECT_FALSE(home->notes().empty());
}

TEST(LibraryHome, UnitScalesArrays) {
  const BoxRoom room({0, 0, 0}, {400, 250, 300});
  OpenOptions options;
  options.metresPerUnit = 0.01;
  const auto home = Home::fromArrays(room.arrays(), options);
  ASSERT_TRUE(home) << home.error().message;
  EXPECT_NEAR(home->bounds().second.x, 4, 1e-5);
}

TEST(LibraryHome, ArraysAreCopied) {
  BoxRoom room = smallRoom();
  const auto home = Home::fromArrays(room.arrays(), twoLamps());
  room.positions.assign(room.positions.size(), std::numeric_limits<float>::quiet_NaN());
  EXPECT_FLOAT_EQ(home->bounds().second.x, 4);
}

std::string errorOf(const HomeArrays& arrays, const OpenOptions& options = {}) {
  const auto home = Home::fromArrays(arrays, options);
  if (home) return "no error";
  EXPECT_EQ(home.error().kind, ErrorKind::BadInput);
  EXPECT_EQ(home.error().message.find('\n'), std::string::npos);
  return home.error().message;
}

TEST(LibraryHome, BadArraysAreNamed) {
  const BoxRoom room = smallRoom();
  HomeArrays arrays = room.arrays();
  EXPECT_NE(errorOf({}), "no error");

  const std::vector<uint32_t> wrong = {0, 1, 800};
  arrays.meshes[0].triangles = wrong;
  EXPECT_NE(errorOf(arrays).find("room"), std::string::npos);
  arrays = room.arrays();
  arrays.meshes[0].positions = arrays.meshes[0].positions.first(5);
  EXPECT_EQ(errorOf(arrays), "mesh 0 'room': positions and triangles have three numbers each");
  arrays = room.arrays();
  arrays.meshes[0].normals = arrays.meshes[0].positions.first(3);
  EXPECT_EQ(errorOf(arrays), "mesh 0 'room': normals: has 3 numbers, 8 vertices need 24");
  arrays = room.arrays();
  arrays.meshes[0].material = 1;
  EXPECT_EQ(errorOf(arrays), "mesh 0 'room': there is no material 1");
  arrays = room.arrays();
  arrays.cameras[0].target = arrays.cameras[0].eye;
  EXPECT_EQ(errorOf(arrays), "camera 'corner': target is where its eye is");
  arrays = room.arrays();
  arrays.materials[0].baseColourTexture = 0;
  EXPECT_NE(errorOf(arrays), "no error");
  BoxRoom broken = room;
  broken.positions[4] = std::numeric_limits<float>::infinity();
  EXPECT_NE(errorOf(broken.arrays()), "no error");
}

TEST(LibraryHome, WhatNoHomeIsIsRefused) {
  const BoxRoom room = smallRoom();
  HomeArrays arrays = room.arrays();
  arrays.cameras[0].eye.x = 1e30f;
  EXPECT_EQ(errorOf(arrays), "camera 'corner': eye and target must be within 1000 km");
  EXPECT_EQ(errorOf(BoxRoom({0, 0, 0}, {1e6f, 2.5f, 3}).arrays()),
            "the scene is 1e+06 m large, which no home is; is metresPerUnit right?");
  arrays = room.arrays();
  arrays.materials[0].specular = -3;
  EXPECT_EQ(errorOf(arrays), "material 0: specular: must be from 0 to 1");
  arrays = room.arrays();
  arrays.materials[0].emissionCdM2.y = std::numeric_limits<float>::quiet_NaN();
  EXPECT_EQ(errorOf(arrays), "material 0: emissionCdM2: must be from 0 to 1e9");
}

TEST(LibraryHome, BadOptionsAreNamedWithoutDashes) {
  const BoxRoom room = smallRoom();
  OpenOptions options;
  options.lighting = "{broken";
  EXPECT_EQ(errorOf(room.arrays(), options), "lighting: is not valid JSON");
  options.lighting = R"({"lamps": [{"name": "a", "type": "point", "kind": 3}]})";
  EXPECT_NE(errorOf(room.arrays(), options).find("unknown key 'kind'"), std::string::npos);
  options = {};
  options.light = "noon";
  EXPECT_TRUE(errorOf(room.arrays(), options).starts_with("light noon: no such light"));
  const auto none = Home::open("/nowhere/home.glb");
  ASSERT_FALSE(none);
  EXPECT_NE(none.error().message.find("/nowhere/home.glb"), std::string::npos);
}

}  // namespace
}  // namespace roomlight::test
