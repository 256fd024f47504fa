#include "bake/lit_places.h"

#include <gtest/gtest.h>

#include <cmath>

#include "support/rooms.h"

namespace roomlight::bake {
namespace {

struct Laid {
  explicit Laid(Scene s) : scene(std::move(s)), rays(scene), seen(seenFrom(rays, eyesIn(rays), 1 << 17)) {
    atlas = atlasOf(scene, chartsOf(scene, seen, {}), {}).value();
    lit = litPlacesOf(atlas, rays, seen, 0.08f);
  }
  Scene scene;
  RayScene rays;
  SeenSides seen;
  Atlas atlas;
  LitPlaces lit;
};

// A cupboard of 1 x 1 m stands on the floor.
Scene room() {
  Scene scene;
  const int grey = addMaterial(scene, lambertian(0.5f));
  addRoom(scene, {0, 0, 0}, {4, 2.5f, 3}, std::vector<int>(6, grey));
  addBox(scene, {2, 0.001f, 1}, {3, 2, 2}, grey);
  addSphere(scene, {1, 1, 1}, 0.1f, grey);
  Room floor;
  floor.floor = {{0, 0}, {0, 3}, {4, 3}, {4, 0}};
  scene.rooms = {floor};
  return scene;
}

TEST(LitPlaces, whatIsUnderACupboardTakesTheLightBesideIt) {
  const Laid laid(room());
  size_t under = 0;
  for (size_t i = 0; i < laid.atlas.elements.size(); ++i) {
    const SurfaceElement& e = laid.atlas.elements[i];
    const LightShares& s = laid.lit.ofElement[i];
    float sum = 0;
    for (const float w : s.weight) sum += w;
    EXPECT_NEAR(sum, 1, 1e-5);
    const Vec3 from = laid.lit.places[s.place[0]].position;
    const bool isFloor = e.position.y < 0.0005f && e.normal.y > 0.9f;
    if (isFloor && e.position.x > 2.1f && e.position.x < 2.9f && e.position.z > 1.1f && e.position.z < 1.9f) {
      ++under;
      EXPECT_FALSE(from.x > 2.06f && from.x < 2.94f && from.z > 1.06f && from.z < 1.94f) << from.x << " " << from.z;
    } else if (isFloor && (e.position.x < 1.9f || e.position.x > 3.1f)) {
      EXPECT_TRUE(from == e.position);
    }
  }
  EXPECT_GT(under, 100u);
}

// Walls go on above a ceiling that hangs 8 cm under the roof, where they see each other, but nobody sees them.
TEST(LitPlaces, wallsAboveACeilingTakeTheLightBelow) {
  Scene scene = room();
  addBox(scene, {-0.01f, 2.4f, -0.01f}, {4.01f, 2.42f, 3.01f}, 0);
  const Laid laid(std::move(scene));
  size_t above = 0;
  for (size_t i = 0; i < laid.atlas.elements.size(); ++i) {
    const SurfaceElement& e = laid.atlas.elements[i];
    const bool middle = (e.position.x > 0.5f && e.position.x < 3.5f) || (e.position.z > 0.5f && e.position.z < 2.5f);
    if (!middle || e.position.y < 2.43f || std::abs(e.normal.y) > 0.1f) continue;
    ++above;
    EXPECT_LT(laid.lit.places[laid.lit.ofElement[i].place[0]].position.y, 2.42f) << e.position.x << " " << e.position.z;
  }
  EXPECT_GT(above, 200u);
}

TEST(LitPlaces, verticesOfFineThingsShare) {
  const Laid laid(room());
  size_t vertices = 0, places = 0;
  for (size_t i = 0; i < laid.atlas.elements.size(); ++i)
    vertices += laid.atlas.charts[laid.atlas.chartOf[i]].chart.byVertices;
  for (const SurfaceElement& p : laid.lit.places) places += length(p.position - Vec3(1, 1, 1)) < 0.11f;
  EXPECT_GT(vertices, 500u);
  EXPECT_LT(places, vertices / 3);
  // A light that grows along x by 100 a metre is kept, but for what the cells are wide.
  std::vector<float> light;
  for (const SurfaceElement& p : laid.lit.places) light.push_back(100 * p.position.x);
  const std::vector<float> spread = laid.lit.spread<float>(light);
  for (size_t i = 0; i < spread.size(); ++i) {
    if (!laid.atlas.charts[laid.atlas.chartOf[i]].chart.byVertices) continue;
    EXPECT_NEAR(spread[i], 100 * laid.atlas.elements[i].position.x, 8);
  }
}

}  // namespace
}  // namespace roomlight::bake
