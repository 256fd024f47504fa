#include "bake/lean.h"

#include <gtest/gtest.h>

#include "bake/bake.h"
#include "support/rooms.h"

namespace roomlight::bake {
namespace {

TEST(Lean, isTowardsALampInABlackRoom) {
  Scene scene;
  const int black = addMaterial(scene, lambertian(0));
  addRoom(scene, {0, 0, 0}, {4, 2.5f, 3}, std::vector<int>(6, black));
  Material bumpy = lambertian(0);
  scene.textures.push_back({"bumps", 1, 1, Wrap::Repeat, Wrap::Repeat, {160, 128, 250, 255}});
  bumpy.normalTexture.texture = 0;
  addRectangle(scene, {0.5f, 0.5f, 2.5f}, {3, 0, 0}, {0, 0, -2}, addMaterial(scene, bumpy));
  const Vec3 lamp{2.2f, 2, 1.4f};
  scene.lamps = {pointLamp(lamp, 100)};
  Room floor;
  floor.floor = {{0, 0}, {0, 3}, {4, 3}, {4, 0}};
  scene.rooms = {floor};
  const BakeSettings settings = bakeSettings("draft").value();
  const RayScene rays(scene);
  const SeenSides seen = seenFrom(rays, eyesIn(rays), 1 << 16);
  const Atlas atlas = atlasOf(scene, chartsOf(scene, seen, settings.charts), settings.atlas).value();
  const LitPlaces lit = litPlacesOf(atlas, rays, seen, settings.placesApartM);
  const TurnedPlaces turned = turnedPlaces(scene, atlas, lit);
  Scene smooth = scene;
  smooth.textures[0].rgba = {130, 128, 255, 255};
  EXPECT_TRUE(turnedPlaces(smooth, atlas, lit).of.empty());
  std::vector<SurfaceElement> places = lit.places;
  places.insert(places.end(), turned.turned.begin(), turned.turned.end());
  const RenderProgress quiet;
  RenderStats stats;
  Stages stages(quiet, stats);
  BakedLayer layer = lampLayers(scene, places, settings.layers, stages).value().layers.at(0);
  takeLean(turned, lit, layer);
  ASSERT_EQ(layer.lux.size(), lit.places.size());
  ASSERT_EQ(layer.lean.size(), atlas.elements.size());
  size_t checked = 0;
  for (size_t i = 0; i < atlas.elements.size(); ++i) {
    const SurfaceElement& place = atlas.elements[i];
    const bool bumps = place.position.y > 0.4f && place.position.y < 0.6f && place.normal.y > 0.9f;
    if (!bumps) {
      EXPECT_TRUE(isBlack(layer.lean[i])) << i;
      continue;
    }
    const Vec3 to = lamp - place.position;
    const Chart& chart = atlas.charts[atlas.chartOf[i]].chart;
    const auto expected = [&](Vec3 axis) { return 0.5f + dot(to, axis) / to.y / 4; };
    const Vec3 share = layer.lean[i] / kLeanOfOne;
    // At the edge the mean is of places on one side alone, half a block further in; a block is five texels of 12 cm.
    EXPECT_NEAR(share.x, expected(chart.alongU), 0.33f / to.y / 4);
    EXPECT_NEAR(share.y, expected(chart.alongV), 0.33f / to.y / 4);
    EXPECT_FLOAT_EQ(share.z, 1);
    ++checked;
  }
  EXPECT_GT(checked, 100u);
  EXPECT_LT(turned.of.size(), checked / 12);
}

}  // namespace
}  // namespace roomlight::bake
