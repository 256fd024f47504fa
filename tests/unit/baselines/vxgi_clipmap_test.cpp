#include "baselines/vxgi_clipmap.h"

#include <gtest/gtest.h>

#include "baselines/vxgi.h"

namespace roomlight {
namespace {

std::array<float, 4> numbers(Float4 v) {
  std::array<float, 4> out;
  v.store(out.data());
  return out;
}

void fill(VxgiClipmap& map, int level, const auto& opacityAt) {
  const int n = map.resolution();
  for (int z = 0; z < n; ++z) {
    for (int y = 0; y < n; ++y) {
      for (int x = 0; x < n; ++x) {
        for (int face = 0; face < 6; ++face) map.set(level, {x, y, z}, face, Vec3(10), opacityAt(Int3{x, y, z}));
      }
    }
  }
}

TEST(VxgiClipmap, levelsLieInOneAnotherOnWholeVoxels) {
  const VxgiClipmap map({1.3f, -0.7f, 22.1f}, 0.1f, 16, 4);
  for (int level = 0; level < 4; ++level) {
    const Int3 c = map.corner(level);
    EXPECT_EQ(c.x % 2, 0);
    EXPECT_EQ(map.levelAt(Vec3{1.3f, -0.7f, 22.1f} + Vec3{0.5f * 12 * map.voxelSizeM(level), 0, 0}), level);
    int finer = 0;
    for (int i = 0; i < 16 * 16 * 16; ++i) finer += map.isMadeOfFiner(level, {i % 16, i / 16 % 16, i / 256}) ? 1 : 0;
    EXPECT_EQ(finer, level == 0 ? 0 : 8 * 8 * 8);
  }
  EXPECT_EQ(map.levelAt({100, 0, 0}), 4);
}

TEST(VxgiClipmap, sampleOfAnEvenFieldIsThatField) {
  VxgiClipmap map({0, 0, 0}, 0.1f, 16, 1);
  fill(map, 0, [](Int3) { return 0.5f; });
  const auto v = numbers(map.sample(0, {0.123f, -0.21f, 0.057f}, normalize(Vec3{1, -2, 3})));
  EXPECT_NEAR(v[0], 8.02, 0.01);
  EXPECT_NEAR(v[3], 0.5 * (1 + 2 + 3) / std::sqrt(14.0), 1e-3) << "half of the area of three faces";
}

TEST(VxgiClipmap, sampleIsLinearBetweenVoxels) {
  VxgiClipmap map({0, 0, 0}, 0.1f, 16, 1);
  fill(map, 0, [](Int3 v) { return 0.01f * static_cast<float>(v.x + 2 * v.y + 3 * v.z); });
  map.findEmpty();
  const Vec3 p{0.033f, -0.087f, 0.211f}, q = p * 10 - Vec3(0.5f) + Vec3(8);
  EXPECT_NEAR(numbers(map.sample(0, p, {0, -1, 0}))[3], 0.01f * (q.x + 2 * q.y + 3 * q.z), 1e-3);
}

// What is noted as empty is empty, and nothing else: right up to the voxels beside a sheet.
TEST(VxgiClipmap, onlyWhereNothingIsIsEmpty) {
  VxgiClipmap map({0, 0, 0}, 0.1f, 16, 1);
  for (int face = 0; face < 6; ++face) map.set(0, {8, 8, 8}, face, Vec3(1), 1);
  map.findEmpty();
  const auto opacity = [&](float x) { return numbers(map.sample(0, {x, 0.05f, 0.05f}, {1, 0, 0}))[3]; };
  EXPECT_NEAR(opacity(0.05f), 1, 1e-3);
  EXPECT_NEAR(opacity(-0.04f), 0.1, 1e-3);
  EXPECT_NEAR(opacity(0.14f), 0.1, 1e-3);
  EXPECT_EQ(opacity(-0.06f), 0);
  EXPECT_EQ(opacity(0.16f), 0);
}

// Two sheets behind one another in one coarse voxel: each direction sees its own, and the other as far as that lets it.
TEST(VxgiClipmap, coarserVoxelsShowWhatIsInFront) {
  VxgiClipmap map({0, 0, 0}, 0.1f, 16, 2);
  for (int y = 8; y < 10; ++y) {
    for (int z = 8; z < 10; ++z) {
      for (int face = 0; face < 6; ++face) {
        map.set(0, {8, y, z}, face, {1, 0, 0}, 1);
        map.set(0, {9, y, z}, face, {0, 1, 0}, 0.5f);
      }
    }
  }
  map.buildCoarser();
  const Int3 v{(map.corner(0).x + 8) / 2 - map.corner(1).x, (map.corner(0).y + 8) / 2 - map.corner(1).y,
               (map.corner(0).z + 8) / 2 - map.corner(1).z};
  const auto fromPlus = numbers(map.get(1, v, 0)), fromMinus = numbers(map.get(1, v, 1)),
             above = numbers(map.get(1, v, 2));
  EXPECT_NEAR(fromPlus[0], 0.5, 1e-3);
  EXPECT_NEAR(fromPlus[1], 0.5, 1e-3);
  EXPECT_NEAR(fromPlus[3], 1, 1e-3);
  EXPECT_NEAR(fromMinus[0], 1, 1e-3);
  EXPECT_NEAR(fromMinus[1], 0, 1e-3);
  EXPECT_NEAR(above[3], 0.5f * (1 + 0.75f), 1e-3);
}

// Through a fog of opacity 0.1 a voxel, a way of 5 voxels: what is left does not depend on how long the steps are.
TEST(VxgiCone, opacityDoesNotDependOnTheStep) {
  VxgiClipmap map({0, 0, 0}, 0.1f, 32, 1);
  fill(map, 0, [](Int3 v) { return v.x >= 16 && v.x < 21 ? 0.1f : 0.0f; });
  for (const float step : {0.1f, 0.25f, 0.5f, 1.0f}) {
    VxgiTracing tracing;
    tracing.step = step, tracing.maxSamples = 1000;
    EXPECT_NEAR(traceVxgiCone(map, {-1, 0, 0}, {1, 0, 0}, 0, tracing).x, 10 * (1 - std::pow(0.9, 5)), 0.02 * 4.1)
        << step;
  }
}

TEST(VxgiCone, conesOfAHemisphereShareItByTheCosine) {
  for (const int count : {1, 8, 32}) {
    const VxgiCones cones(count);
    float sum = 0;
    Vec3 mean;
    for (size_t i = 0; i < cones.direction.size(); ++i) {
      sum += cones.weight[i];
      mean += cones.direction[i] * cones.weight[i];
    }
    EXPECT_NEAR(sum, 1, 1e-5);
    EXPECT_NEAR(mean.z, count == 1 ? 0.5f : 2 / 3.f, 0.01f) << "the mean cosine of cosine-weighted directions";
  }
}

}  // namespace
}  // namespace roomlight
