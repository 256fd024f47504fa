#include "trace/meter.h"

#include <gtest/gtest.h>

#include "base/sampler.h"
#include "scene/primitives.h"

namespace roomlight {
namespace {

// Mean over meters on which one sample of sixteen finds 16 lx more than the others' 1 lx.
double meanOfRare(size_t together) {
  Scene scene;
  addRoom(scene, {0, 0, 0}, {1, 1, 1}, std::vector<int>(6, addMaterial(scene, {})));
  const RayScene rays(scene);
  const Lights lights(scene);
  const std::vector<SurfaceElement> elements(8192, {{0.5f, 0, 0.5f}, {0, 1, 0}});
  const auto sample = [](size_t meter, int first, int count, std::span<Vec3> lux) {
    for (int k = 0; k < count; ++k) {
      Sampler sampler(meter, static_cast<uint32_t>(first + k), 0);
      lux[static_cast<size_t>(k)] += Vec3(sampler.fast1() < 1.0f / 16 ? 17.0f : 1.0f);
    }
  };
  MeterSettings settings{0.3, 16, 64, 0};
  settings.together = together;
  double sum = 0;
  for (const MeterReading& r : readMeters(rays, lights, elements, settings, {sample}))
    sum += static_cast<double>(luminance(r.illuminanceLux));
  return sum / static_cast<double>(elements.size());
}

TEST(Meters, areSureTogetherWithoutBias) {
  EXPECT_LT(meanOfRare(1), 1.9);
  EXPECT_NEAR(meanOfRare(16), 2, 0.02);
}

}  // namespace
}  // namespace roomlight
