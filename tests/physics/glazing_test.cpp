// Window panes in a furnace. Daylight through them: src/validate.
#include <gtest/gtest.h>

#include <numbers>

#include "reference/path_tracer.h"
#include "scene/surface.h"
#include "support/rooms.h"

namespace roomlight {
namespace {

// Between panes that absorb nothing and an even sky all around everything is as bright as the sky: what is not let
// through is reflected.
TEST(GlazingInAFurnace, isInvisible) {
  for (const int panes : {1, 2}) {
    Scene scene;
    scene.sky.luminanceCdM2 = Vec3(100);
    Material window;
    glaze(window, {panes, 1.52f, 1});
    test::addRectangle(scene, {-1, -1, 0}, {2, 0, 0}, {0, 2, 0}, test::addMaterial(scene, window));
    const RayScene rays(scene);
    const Lights lights(scene);
    for (const Vec3 n : {Vec3{0, 0, 1}, Vec3{0, 0, -1}, Vec3{0.6f, 0, 0.8f}}) {
      const double e =
          static_cast<double>(luminance(measureIlluminance(rays, lights, n * -0.2f, n, 1 << 16, 5).illuminanceLux));
      EXPECT_NEAR(e, 100 * std::numbers::pi, 0.005 * 100 * std::numbers::pi) << panes;
    }
  }
}

}  // namespace
}  // namespace roomlight
