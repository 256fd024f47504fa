// The light of the sky on slots, by samples and links together, against what a hole in the wall gives.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "radiance/light_cache.h"
#include "support/rooms.h"
#include "voxel/voxelise.h"

namespace roomlight {
namespace {

constexpr float kSkyCdM2 = 1000;
constexpr Vec3 kLow{1, 1, 5}, kHigh{1.5f, 2, 5};  // of the hole

// A black room; the sky shines in through a hole.
struct RoomWithHole {
  Scene scene;
  Voxels voxels;
  RoomWithHole() {
    const int black = test::addMaterial(scene, test::lambertian(0));
    test::addRoom(scene, {0, 0, 0}, {4, 2.6f, 5}, std::vector<int>(6, black));
    scene.meshes.pop_back(), scene.instances.pop_back();  // the wall at z = 5
    for (const auto& [x0, y0, x1, y1] :
         {std::array{0.0f, 0.0f, 4.0f, kLow.y}, std::array{0.0f, kHigh.y, 4.0f, 2.6f},
          std::array{0.0f, kLow.y, kLow.x, kHigh.y}, std::array{kHigh.x, kLow.y, 4.0f, kHigh.y}})
      test::addRectangle(scene, {x0, y0, 5}, {0, y1 - y0, 0}, {x1 - x0, 0, 0}, black);
    scene.sky.luminanceCdM2 = Vec3(kSkyCdM2);
    VoxelSettings settings;
    settings.voxelSizeM = 0.1f;
    voxels = voxelise(scene, settings).voxels;
  }

  // The integral over the hole, lx.
  double exactLux(const FaceSlot& slot) const {
    constexpr int kSteps = 24;
    double sum = 0;
    for (int i = 0; i < kSteps * kSteps; ++i) {
      const float u = (static_cast<float>(i % kSteps) + 0.5f) / kSteps,
                  v = (static_cast<float>(i / kSteps) + 0.5f) / kSteps;
      const Vec3 d = Vec3(kLow.x + u * (kHigh.x - kLow.x), kLow.y + v * (kHigh.y - kLow.y), 5) - slot.position;
      const float squared = lengthSquared(d);
      sum += static_cast<double>(std::max(0.0f, dot(d, slot.normal)) * std::max(0.0f, d.z) / (squared * squared));
    }
    const double area = static_cast<double>((kHigh.x - kLow.x) * (kHigh.y - kLow.y));
    return static_cast<double>(kSkyCdM2) * sum * area / (kSteps * kSteps);
  }
};

// How the light on all slots is off, over seeds.
struct Off {
  double flux = 0;   // of all, relative
  double square = 0; // of single slots, relative to the mean of the light
  double most = 0;   // of any, in means of the light
};

// Of slots at least so far from the wall with the hole.
Off offExact(const RoomWithHole& room, bool still, float apartM) {
  Off out;
  const RayScene rays(room.scene);
  const Lights lights(room.scene);
  double flux = 0, exactFlux = 0, area = 0, squares = 0;
  constexpr uint64_t kSeeds = 8;
  std::vector<double> most;
  for (uint64_t seed = 0; seed < kSeeds; ++seed) {
    RadianceSettings settings;
    settings.pyramid = false, settings.still = still, settings.seed = seed;
    const RadianceField field = illuminate(rays, lights, room.voxels, settings);
    for (size_t s = 0; s < room.voxels.slots.size(); ++s) {
      const FaceSlot& slot = room.voxels.slots[s];
      const bool inside = slot.position.z < 5 - apartM && dot(slot.normal, Vec3(2, 1.3f, 2.5f) - slot.position) > 0;
      if (!inside) continue;
      const double exact = room.exactLux(slot), lux = static_cast<double>(luminance(field.irradianceLux[s])),
                   of = static_cast<double>(slot.areaM2);
      flux += of * lux, exactFlux += of * exact, area += of, squares += of * (lux - exact) * (lux - exact);
      most.push_back(lux - exact);
    }
  }
  const double mean = exactFlux / area;
  out.flux = flux / exactFlux - 1, out.square = squares / area / (mean * mean);
  out.most = *std::max_element(most.begin(), most.end()) / mean;
  return out;
}

// Beside the wall the hole is seen by few links, which samples that follow them seldom try.
TEST(SkyLinks, shareTheLightOfTheSkyWithSamples) {
  const RoomWithHole room;
  const Off alone = offExact(room, false, 0.3f), shared = offExact(room, true, 0.3f);
  EXPECT_NEAR(shared.flux, 0, 0.01);
  EXPECT_LT(shared.most, 0.5 * alone.most);
  EXPECT_LT(shared.square, 0.95 * alone.square);
}

TEST(SkyLinks, takeLittleFromSamplesThatKnowWhereTheSkyIs) {
  const RoomWithHole room;
  const Off alone = offExact(room, false, 1), shared = offExact(room, true, 1);
  EXPECT_NEAR(shared.flux, 0, 0.01);
  EXPECT_LT(shared.square, 1.25 * alone.square);
}

}  // namespace
}  // namespace roomlight
