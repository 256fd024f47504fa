#include "radiance/lamp_cells.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "base/sampler.h"
#include "support/rooms.h"

namespace roomlight {
namespace {

// Negative places, lamps on the borders of cubes and far from the origin included.
TEST(LampCells, allLampsNearABoxAreFoundAndFewOthers) {
  constexpr float kRadius = 0.5f;
  for (const float offset : {0.0f, -3.0f, 4000.0f}) {
    Scene scene;
    for (uint32_t i = 0; i < 2000; ++i) {
      Sampler sampler(i, 0, 1);
      Vec3 p = Vec3{sampler.next1(), sampler.next1(), sampler.next1()} * 10.0f;
      if (i % 2) p = {std::round(2 * p.x) / 2, std::round(2 * p.y) / 2, std::round(2 * p.z) / 2};
      scene.lamps.push_back(test::pointLamp(p + Vec3(offset), 1));
    }
    const Lights lights(scene);
    const LampCells cells(lights, kRadius);
    size_t most = 0;
    std::vector<size_t> found;
    for (uint32_t k = 0; k < 500; ++k) {
      Sampler sampler(k, 1, 1);
      const Vec3 p = Vec3{sampler.next1(), sampler.next1(), sampler.next1()} * 10.0f + Vec3(offset);
      Bounds3 box;
      box.add(p), box.add(p + Vec3(0.3f));
      cells.around(box, found);
      most = std::max(most, found.size());
      for (size_t i = 0; i < lights.lampCount(); ++i) {
        const Vec3 q = lights.lamp(i).position, nearest = max(box.lo, min(box.hi, q));
        if (lengthSquared(q - nearest) >= kRadius * kRadius) continue;
        EXPECT_EQ(std::count(found.begin(), found.end(), i), 1) << i;
      }
    }
    EXPECT_LT(most, 150u) << offset;
    cells.around({}, found);
    EXPECT_TRUE(found.empty());
  }
}

}  // namespace
}  // namespace roomlight
