#include "bake/home_places.h"

#include <gtest/gtest.h>

#include <cmath>

#include "bake/simplify.h"
#include "support/rooms.h"

namespace roomlight::bake {
namespace {

constexpr float kErrorM = 0.002f, kRadiusM = 0.1f;
const Vec3 kMiddle{2, 1, 1.5f};

// A ball of many triangles in a room. `x`: its extent along x, negative mirrors it.
Scene withBall(float x) {
  Scene scene;
  const int grey = addMaterial(scene, lambertian(0.5f));
  addRoom(scene, {0, 0, 0}, {4, 2.5f, 3}, std::vector<int>(6, grey));
  addSphere(scene, {0, 0, 0}, kRadiusM, grey);
  scene.instances.back().worldFromObject = {{x, 0, 0}, {0, 1, 0}, {0, 0, 1}, kMiddle};
  Room floor;
  floor.floor = {{0, 0}, {0, 3}, {4, 3}, {4, 0}};
  scene.rooms = {floor};
  return scene;
}

// How far places of the ball are from it at most, on the simplified home and once put back.
std::pair<float, float> mostOff(float x) {
  const Scene scene = withBall(x);
  const RayScene home(scene);
  Scene simplified = scene;
  const std::vector<float> moved = simplifyMeshes(simplified, kErrorM);
  const RayScene rays(simplified);
  const SeenSides seen = seenFrom(rays, eyesIn(rays), 1 << 17);
  LitPlaces lit = litPlacesOf(atlasOf(simplified, chartsOf(simplified, seen, {}), {}).value(), rays, seen, 0.02f);
  const auto off = [&] {
    float most = 0;
    for (size_t i = 0; i < lit.places.size(); ++i) {
      if (lit.sides[i].instance + 1 == simplified.instances.size())
        most = std::max(most, std::abs(length(lit.places[i].position - kMiddle) - kRadiusM));
    }
    return most;
  };
  const float before = off();
  const std::vector<SurfaceElement> places = lit.places;
  putOnHome(lit, home, moved);
  for (size_t i = 0; i < places.size(); ++i) {
    if (lit.sides[i].instance + 1 < simplified.instances.size()) {
      EXPECT_TRUE(lit.places[i].position == places[i].position);
    }
  }
  return {before, off()};
}

TEST(HomePlaces, areOnTheHomeAsItIs) {
  for (const float x : {1.0f, -1.0f}) {
    const auto [simplified, put] = mostOff(x);
    EXPECT_GT(simplified, 0.4f * kErrorM) << x;
    EXPECT_LT(put, 0.2f * kErrorM) << x;  // by its own facets
  }
}

}  // namespace
}  // namespace roomlight::bake
