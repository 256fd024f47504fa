#include "measure/luminaires.h"

#include <gtest/gtest.h>

#include "photometry/colour_temperature.h"
#include "support/rooms.h"

namespace roomlight {
namespace {

TEST(Luminaires, tellFluxWattsAndColour) {
  Scene scene;
  scene.lamps.push_back(test::pointLamp({1, 2, 3}, 100));
  Lamp& bulb = scene.lamps[0];
  bulb.name = "Bulb", bulb.wattsW = 12, bulb.intensityCd = blackBodyColour(2700) * 100;
  Lamp panel;
  panel.name = "Panel", panel.kind = LampKind::Area, panel.position = {0, 2.5f, 0}, panel.widthM = 0.5f,
  panel.heightM = 2, panel.luminanceCdM2 = Vec3(1000);
  scene.lamps.push_back(panel);
  addAreaLampMeshes(scene);
  const std::vector<Luminaire> list = luminairesOf(scene);
  ASSERT_EQ(list.size(), 2u);
  EXPECT_EQ(list[0].name, "Bulb");
  EXPECT_EQ(list[0].kind, "point");
  EXPECT_NEAR(list[0].fluxLm, 4 * 3.14159265 * 100, 0.5);
  EXPECT_EQ(list[0].wattsW, 12);
  ASSERT_TRUE(list[0].kelvin);
  EXPECT_NEAR(*list[0].kelvin, 2700, 60);
  EXPECT_EQ(list[1].kind, "area");
  EXPECT_NEAR(list[1].fluxLm, 3.14159265 * 1000, 1) << "once, though its rectangle shines too";
  EXPECT_FALSE(list[1].kelvin) << "plain white says nothing of its colour";
}

TEST(Luminaires, shiningMeshesAreLuminairesAndColouredLightHasNoTemperature) {
  Scene scene;
  Material green = test::lambertian(0, 100);
  green.emission = {0, 500, 0};
  test::addSphere(scene, {0, 1, 0}, 0.1f, test::addMaterial(scene, green));
  const std::vector<Luminaire> list = luminairesOf(scene);
  ASSERT_EQ(list.size(), 1u);
  EXPECT_EQ(list[0].kind, "shining mesh");
  EXPECT_NEAR(list[0].position.y, 1, 0.01);
  EXPECT_NEAR(list[0].fluxLm, 3.14159265 * 0.7152 * 500 * 4 * 3.14159265 * 0.01, 3);
  EXPECT_FALSE(list[0].kelvin);
}

TEST(Luminaires, thoseAlikeAreOneRow) {
  std::vector<Luminaire> list(4);
  for (Luminaire& l : list) l.name = "Spot", l.kind = "spot", l.fluxLm = 500, l.room = "Hall";
  list[1].room = "Bath";
  list[3].fluxLm = 501;
  const Schedule s = scheduleOf(list);
  ASSERT_EQ(s.rows.size(), 2u);
  EXPECT_EQ(s.rows[0].count, 3u);
  EXPECT_EQ(s.rows[1].count, 1u);
  EXPECT_EQ(s.rowOf, (std::vector<size_t>{0, 1, 0, 0}));
}

}  // namespace
}  // namespace roomlight
