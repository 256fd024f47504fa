#include "trace/light_tree.h"

#include <gtest/gtest.h>

#include "base/random.h"
#include "support/light_densities.h"
#include "support/rooms.h"
#include "trace/light_parts.h"

namespace roomlight {
namespace {

constexpr int kLamps = 300;

Vec3 place(Sampler& sampler) {
  const Vec2 u = sampler.next2();
  return {10 * u.x, 3 * sampler.next1(), 10 * u.y};
}

// Points and downlights by turns.
Scene manyLamps() {
  Scene scene;
  Sampler sampler(1, 0, 7);
  for (int i = 0; i < kLamps; ++i) {
    Lamp lamp;
    lamp.position = place(sampler), lamp.intensityCd = Vec3(1 + 50 * sampler.next1());
    if (i % 2)
      lamp.kind = LampKind::Spot, lamp.direction = {0, -1, 0}, lamp.innerConeRad = 0.2f, lamp.outerConeRad = 0.7f;
    scene.lamps.push_back(lamp);
  }
  return scene;
}

// Squares of light, one-sided, that look down.
Scene manyPanels() {
  Scene scene;
  Sampler sampler(2, 0, 7);
  Material shining = lambertian(0.5f);
  shining.emission = Vec3(100), shining.doubleSided = false;
  const int material = addMaterial(scene, shining);
  for (int i = 0; i < 100; ++i) {
    const Vec3 p = place(sampler);
    Mesh mesh;
    mesh.material = material;
    mesh.positions = {p, p + Vec3{0.2f, 0, 0}, p + Vec3{0.2f, 0, 0.2f}, p + Vec3{0, 0, 0.2f}};
    mesh.indices = {0, 1, 2, 0, 2, 3};
    Instance instance;
    instance.mesh = i;
    scene.meshes.push_back(std::move(mesh)), scene.instances.push_back(instance);
  }
  return scene;
}

// Lights in a flat and what each could give, as if all were points.
struct Points {
  std::vector<LightTree::Light> lights;
  LightTree tree;
  explicit Points(int count) {
    Sampler sampler(3, 0, 7);
    for (int i = 0; i < count; ++i) {
      const Vec3 p = place(sampler);
      lights.push_back({{p, p}, 1 + 50 * sampler.next1(), {0, 1, 0}, kPi});
    }
    tree = LightTree(lights);
  }
  auto weigh(Vec3 p) const {
    return
        [this, p](size_t i) { return lights[i].intensityCd / std::max(lengthSquared(p - lights[i].bounds.lo), 1e-4f); };
  }
};

TEST(LightTree, chancesOfAllLightsAreOne) {
  const Points points(3000);
  Sampler sampler(8, 0, 7);
  for (int k = 0; k < 10; ++k) {
    const Vec3 p = place(sampler);
    double sum = 0;
    for (size_t i = 0; i < points.lights.size(); ++i)
      sum += static_cast<double>(points.tree.chance(i, p, points.weigh(p)));
    EXPECT_NEAR(sum, 1, 1e-3);
  }
}

TEST(LightTree, choosesWithTheChanceThatItTells) {
  const Points points(200);
  Sampler sampler(9, 0, 7);
  for (int k = 0; k < 5; ++k) {
    const Vec3 p = place(sampler);
    constexpr int kTries = 100000;
    std::vector<int> chosen(points.lights.size());
    for (int t = 0; t < kTries; ++t) {
      const LightTree::Choice c = points.tree.choose(p, (static_cast<float>(t) + 0.5f) / kTries, points.weigh(p));
      ASSERT_GT(c.chance, 0);
      ASSERT_GE(c.rest, 0);
      ASSERT_LT(c.rest, 1);
      ++chosen[c.index];
    }
    for (size_t i = 0; i < chosen.size(); ++i)
      EXPECT_NEAR(static_cast<double>(chosen[i]) / kTries,
                  static_cast<double>(points.tree.chance(i, p, points.weigh(p))), 2e-4)
          << i;
  }
}

// Nearly as what each could give: the worst by which one is chosen too seldom decides on the noise.
TEST(LightTree, choosesNearlyByWhatEachCouldGive) {
  const Points points(3000);
  Sampler sampler(10, 0, 7);
  for (int k = 0; k < 10; ++k) {
    const Vec3 p = place(sampler);
    const auto weigh = points.weigh(p);
    double all = 0;
    for (size_t i = 0; i < points.lights.size(); ++i) all += static_cast<double>(weigh(i));
    double squares = 0;  // second moment of the estimate of `all`, in units of its square
    for (size_t i = 0; i < points.lights.size(); ++i)
      squares += static_cast<double>(weigh(i)) / all * static_cast<double>(weigh(i)) / all /
                 static_cast<double>(points.tree.chance(i, p, weigh));
    EXPECT_LT(squares, 1.1) << k;
  }
}

// The light of all lamps, for what one of them stands for is divided by its chance: every sum over even random numbers
// is the sum of the lamps.
TEST(LightTree, oneOfManyLampsStandsForAll) {
  const Scene scene = manyLamps();
  const Lights lights(scene);
  Sampler sampler(5, 0, 7);
  for (int k = 0; k < 10; ++k) {
    const Vec3 p = place(sampler);
    double all = 0, sum = 0;
    for (size_t i = 0; i < lights.lampCount(); ++i)
      all += static_cast<double>(luminance(lights.sampleLamp(i, p, {}).radiance));
    constexpr int kTries = 200000;
    for (int t = 0; t < kTries; ++t) {
      const LightSample s = sampleLocal(lights, {}, p, {0.5f, 0.5f}, (static_cast<float>(t) + 0.5f) / kTries);
      if (s.valid()) sum += static_cast<double>(luminance(s.radiance)) / kTries;
    }
    EXPECT_NEAR(sum / all, 1, 0.01) << k;
  }
}

// And is chosen by what it could give: a lamp near by hides none of its light behind chance.
TEST(LightTree, choosesWhatIsNear) {
  const Scene scene = manyLamps();
  const Lights lights(scene);
  const Vec3 p = scene.lamps[0].position - Vec3{0, 0.02f, 0};
  int near = 0;
  for (int t = 0; t < 1000; ++t)
    near += sampleLocal(lights, {}, p, {0.5f, 0.5f}, (static_cast<float>(t) + 0.5f) / 1000).lamp == 0 ? 1 : 0;
  EXPECT_GT(near, 800);
}

// Multiple importance sampling asks for the density of a sample that was taken, and of points that rays find.
TEST(LightTree, densityOfASampleOnManyPanelsIsThatOfItsPoint) {
  const Scene scene = manyPanels();
  const Lights lights(scene);
  const RayScene rays(scene);
  Sampler sampler(6, 0, 7);
  int compared = 0;
  for (int k = 0; k < 2000; ++k) {
    const Vec3 p = place(sampler);
    const Vec2 u = sampler.next2();
    const LightSample s = lights.sampleEmitters(p, u, sampler.next1());
    compared +=
        test::expectDensityOfItsPoint(rays, p, s, [&](const SurfacePoint& q) { return lights.pdfEmitters(p, q); }) ? 1
                                                                                                                   : 0;
  }
  EXPECT_GT(compared, 200);
}

}  // namespace
}  // namespace roomlight
