#include "home/unit.h"

#include <gtest/gtest.h>

#include "scene/scene_change.h"
#include "support/furnished.h"

namespace roomlight::home {
namespace {

UnitGuess guessOf(Scene scene, double metresPerUnit, StatedUnit stated) {
  scaleScene(scene, static_cast<float>(1 / metresPerUnit));
  const RayScene rays(scene);
  return guessUnit(proportionsOf(rays), stated);
}

class Units : public ::testing::TestWithParam<double> {};

TEST_P(Units, ofAFurnishedRoomAreFound) {
  EXPECT_EQ(guessOf(test::furnishedRoom(), GetParam(), StatedUnit::None).metres, GetParam());
  EXPECT_EQ(guessOf(test::furnishedRoom(), GetParam(), StatedUnit::Stated).metres, GetParam());
}
INSTANTIATE_TEST_SUITE_P(All, Units, ::testing::Values(1, 0.01, 0.001, 0.0254, 0.3048));

TEST(Unit, ofAModelOfAHomeMakesItAHome) {
  const UnitGuess guess = guessOf(test::furnishedRoom(), 20, StatedUnit::Stated);
  EXPECT_NEAR(guess.metres, 20, 1);
  EXPECT_NE(guess.because, "");
}

TEST(Unit, ofAChairIsFoundInMetresAndMillimetres) {
  EXPECT_EQ(guessOf(test::chair(), 1, StatedUnit::None).metres, 1);
  EXPECT_EQ(guessOf(test::chair(), 0.001, StatedUnit::Stated).metres, 0.001);
}

TEST(Unit, largeAndEmptyRoomsThatSayMetresStayInMetres) {
  Scene hall;
  test::addRoom(hall, {0, 0, 0}, {30, 7, 20}, std::vector<int>(6, test::addMaterial(hall, test::lambertian(0.5f))));
  EXPECT_EQ(guessOf(hall, 1, StatedUnit::Stated).metres, 1);
}

TEST(Unit, aHallWithTablesIsNoRoomInFeet) {
  Scene hall;
  const int grey = test::addMaterial(hall, test::lambertian(0.5f));
  test::addRoom(hall, {0, 0, 0}, {14, 8, 12}, std::vector<int>(6, grey));
  for (int i = 0; i < 4; ++i)
    test::addBox(hall, {1 + 3.0f * static_cast<float>(i), 0, 2}, {3 + 3.0f * static_cast<float>(i), 0.75f, 9}, grey);
  EXPECT_EQ(guessOf(hall, 1, StatedUnit::Stated).metres, 1);
}

TEST(Unit, namesOfThingsTell) {
  Proportions p;
  p.extent = 40;
  const auto box = [](float x, float low, float high) { return Bounds3{{x, low, 0}, {x + 10, high, 10}}; };
  p.things = {{"Office Chair 1", box(0, 0, 40)},
              {"chair.002", box(20, 0, 38)},
              {"Chair_3 leg", box(40, 0, 20)},
              {"Chair_3 back", box(40, 19, 41)}};
  EXPECT_EQ(guessUnit(p, StatedUnit::Stated).metres, 0.0254);
}

}  // namespace
}  // namespace roomlight::home
