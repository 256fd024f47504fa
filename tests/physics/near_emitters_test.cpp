// Small emissive meshes close to other surfaces: where their light goes in voxels, and what meters read.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "engine/lit_scene.h"
#include "support/record.h"
#include "support/rooms.h"
#include "voxel/voxelise.h"

namespace roomlight {
namespace {

struct Lit {
  Voxels voxels;
  RadianceField field;
  double emittedLm;
};

Lit light(const Scene& scene, float voxelSizeM) {
  const RayScene rays(scene);
  const Lights lights(scene);
  Lit lit{voxelise(scene, {.voxelSizeM = voxelSizeM}).voxels, {}, lights.emittedFluxLm()};
  lit.field = illuminate(rays, lights, lit.voxels, {});
  return lit;
}

// What arrives on slots. Where surfaces lie one behind the other in a voxel the foremost takes the light.
double receivedLm(const Lit& lit) {
  double sum = 0;
  for (size_t i = 0; i < lit.field.irradianceLux.size(); ++i) {
    const FaceSlot& slot = lit.voxels.slots[i];
    const float h = lit.voxels.voxelSizeM,
                area = std::min(slot.areaM2, h * h / std::max(0.577f, maxComponent(abs(slot.normal))));
    sum += static_cast<double>(luminance(lit.field.irradianceLux[i]) * area);
  }
  return sum;
}

class Bulb : public testing::TestWithParam<float> {};

// In a black room every ray ends where it arrives first.
TEST_P(Bulb, atTheCeilingKeepsItsFlux) {
  Scene scene;
  const int black = test::addMaterial(scene, test::lambertian(0)),
            bulb = test::addMaterial(scene, test::lambertian(0, 10000));
  test::addRoom(scene, {0, 0, 0}, {2.03f, 2.03f, 2.03f}, std::vector<int>(6, black));
  test::addSphere(scene, {1.07f, 1.97f, 0.93f}, 0.03f, bulb);
  const Lit lit = light(scene, GetParam());
  EXPECT_NEAR(receivedLm(lit), lit.emittedLm, 0.02 * lit.emittedLm);
}

TEST_P(Bulb, inAShadeKeepsItsFlux) {
  Scene scene;
  const int black = test::addMaterial(scene, test::lambertian(0)),
            bulb = test::addMaterial(scene, test::lambertian(0, 10000));
  test::addRoom(scene, {0, 0, 0}, {2.03f, 2.03f, 2.03f}, std::vector<int>(6, black));
  test::addSphere(scene, {1.07f, 1.01f, 0.93f}, 0.03f, bulb);
  test::addTube(scene, {1.07f, 0.9f, 0.93f}, 0.12f, 0.22f, black);
  const Lit lit = light(scene, GetParam());
  EXPECT_NEAR(receivedLm(lit), lit.emittedLm, 0.02 * lit.emittedLm);
}
INSTANTIATE_TEST_SUITE_P(Voxels, Bulb, testing::Values(0.03f, 0.06f, 0.1f));

std::vector<MeterReading> readings(const Scene& scene, const char* technique,
                                   const std::vector<SurfaceElement>& elements, float voxelSizeM = 0) {
  RenderSettings settings;
  settings.voxel.voxelSizeM = voxelSizeM;
  settings.technique = technique;
  RenderStats stats;
  const RenderProgress quiet;
  Stages stages(quiet, stats);
  MeterSettings meter;
  meter.tolerance = 0.005;
  meter.mostSamples = 1 << 19;
  return lightScene(scene, settings, stages, {.changes = false}).value()->illuminance(elements, meter);
}

void expectSame(const char* reference, const std::vector<SurfaceElement>& elements,
                const std::vector<MeterReading>& expected, const std::vector<MeterReading>& measured) {
  for (size_t i = 0; i < elements.size(); ++i) {
    const double e = static_cast<double>(luminance(expected[i].illuminanceLux)),
                 m = static_cast<double>(luminance(measured[i].illuminanceLux));
    const Vec3 p = elements[i].position;
    test::record("Table lamp, a bulb in an open shade, illuminance, lx",
                 fmt::format("at ({:.1f}, {:.2f}, {:.1f}), {}", p.x, p.y, p.z, reference), "hybrid", e, m);
    EXPECT_NEAR(m, e, 0.03 * e) << i;
  }
}

TEST(TableLamp, hybridReadsWhatPathReads) {
  const std::vector<SurfaceElement> elements{{{0.85f, 0.75f, 0.75f}, {0, 1, 0}}, {{0.9f, 2.52f, 0.8f}, {0, -1, 0}}};
  expectSame("path", elements, readings(test::tableLamp(true), "path", elements),
             readings(test::tableLamp(true), "hybrid", elements));
}

// Where none of the bulb is seen paths hardly find the lit inside of the shade: a point they find from both ends.
TEST(TableLamp, hybridReadsOfABulbWhatPathReadsOfAPoint) {
  const std::vector<SurfaceElement> elements{{{1.3f, 0.75f, 0.9f}, {0, 1, 0}},
                                             {{3, 0.85f, 2}, {0, 1, 0}},
                                             {{2, 2.52f, 3}, {0, -1, 0}},
                                             {{2, 1.2f, 3.5f}, {0, 0, -1}},
                                             {{0.001f, 1.1f, 0.7f}, {1, 0, 0}}};
  expectSame("path with a point", elements, readings(test::tableLamp(false), "path", elements),
             readings(test::tableLamp(true), "hybrid", elements));
}

// A bulb in a white shade under a ceiling; the shade's outside is another surface some millimetres away, so that a
// voxel as large as those of homes holds both. Most of the light comes by way of the white inside, a good part of it
// more than once.
TEST(Pendant, hybridReadsWhatPathReads) {
  Scene scene;
  const int wall = test::addMaterial(scene, test::lambertian(0.5f)),
            bulb = test::addMaterial(scene, test::lambertian(0, 10000)),
            outside = test::addMaterial(scene, test::lambertian(0.3f)),
            inside = test::addMaterial(scene, test::lambertian(0.95f));
  const Vec3 place{2.07f, 1.6f, 1.53f};
  test::addRoom(scene, {0, 0, 0}, {4.03f, 2.57f, 3.01f}, std::vector<int>(6, wall));
  test::addSphere(scene, place + Vec3{0, 0.1f, 0}, 0.03f, bulb);
  for (const float step : {0.0f, 0.1f, 0.2f}) {  // wider towards its foot
    const Vec3 foot = place + Vec3{0, step, 0};
    test::addTube(scene, foot, 0.21f - 0.4f * step, 0.1f, inside);
    test::addTube(scene, foot, 0.216f - 0.4f * step, 0.1f, outside);
  }
  test::addBox(scene, place + Vec3{-0.09f, 0.04f, -0.09f}, place + Vec3{0.09f, 0.045f, 0.09f},
               outside);  // against glare
  test::addBox(scene, place + Vec3{-0.14f, 0.3f, -0.14f}, place + Vec3{0.14f, 0.32f, 0.14f}, inside);
  test::addBox(scene, {1.3f, 0.7f, 1}, {2.8f, 0.75f, 2}, wall);
  const std::vector<SurfaceElement> elements{
      {{2.0f, 0.75f, 1.5f}, {0, 1, 0}}, {{1.4f, 0.75f, 1.2f}, {0, 1, 0}}, {{0.5f, 0, 2.2f}, {0, 1, 0}}};
  expectSame("white shade, path", elements, readings(scene, "path", elements),
             readings(scene, "hybrid", elements, 0.12f));
}

}  // namespace
}  // namespace roomlight
