#include "gather/sun_gloss.h"

#include <gtest/gtest.h>

#include "base/sampling.h"
#include "radiance/radiance_field.h"
#include "support/rooms.h"
#include "trace/bsdf.h"
#include "trace/lights.h"
#include "voxel/voxelise.h"

namespace roomlight {
namespace {

const Vec3 kToSun = normalize(Vec3{1, 1, 0});

// A floor that the sun lights, and the points that stand for it.
struct SunlitFloor {
  Scene scene;
  RayScene rays;
  Lights lights;
  Voxelisation voxels;
  RadianceField field;
  BrightPatches patches;
  SunGloss gloss;

  static Scene floorOf(const Material& material) {
    Scene scene;
    test::addRectangle(scene, {0.013f, 0.007f, 0.021f}, {0, 0, 4}, {4, 0, 0}, test::addMaterial(scene, material));
    Sun sun;
    sun.toLight = kToSun, sun.illuminanceLux = Vec3(50'000), sun.halfAngleRad = 0.0046f;
    scene.suns = {sun};
    return scene;
  }
  static RadianceSettings still() {
    RadianceSettings settings;
    settings.still = true;
    return settings;
  }
  explicit SunlitFloor(const Material& material)
      : scene(floorOf(material)),
        rays(scene),
        lights(scene),
        voxels(voxelise(scene, {.voxelSizeM = 0.1f})),
        field(illuminate(rays, lights, voxels.voxels, still())),
        patches(rays, voxels.voxels, field.sunPoints, {}, 0, 1),
        gloss(rays, voxels.voxels, patches, kToSun) {}
};

Material varnished(float roughness) {
  Material m = test::lambertian(0.3f);
  m.roughness = roughness;
  m.specular = 1;
  return m;
}

TEST(SunGloss, isOneOnWhatReflectsEvenly) {
  const SunlitFloor floor(test::lambertian(0.3f));
  ASSERT_GT(floor.patches.pointCount(), 1000u);
  for (size_t i = 0; i < floor.patches.pointCount(); i += 97) {
    for (const Vec3 wo : {Vec3{0, 1, 0}, normalize(Vec3{-1, 1, 0}), normalize(Vec3{1, 0.2f, 0})})
      EXPECT_NEAR(luminance(floor.gloss.at(i, wo)), 1, 1e-3f);
  }
}

// Where the sun's image is seen it is several times as bright; all directions together send out what the floor reflects
// of light from there.
TEST(SunGloss, throwsLightWhereTheSunGlints) {
  const SunlitFloor floor(varnished(0.4f));
  const size_t point = floor.patches.pointCount() / 2;
  EXPECT_GT(luminance(floor.gloss.at(point, normalize(Vec3{-1, 1, 0}))), 2);
  EXPECT_LT(luminance(floor.gloss.at(point, normalize(Vec3{1, 1, 0}))), 1.1f);
  const MaterialSample m = materialAt(floor.scene, floor.scene.meshes[0], TrianglePoint{});
  double sent = 0;
  constexpr int kSide = 64;
  for (int k = 0; k < kSide * kSide; ++k) {
    const Vec2 u{(static_cast<float>(k % kSide) + 0.5f) / kSide, (static_cast<float>(k / kSide) + 0.5f) / kSide};
    const Vec3 d = sampleCosineHemisphere(u);
    sent += static_cast<double>(luminance(floor.gloss.at(point, {d.x, d.z, d.y}))) / (kSide * kSide);
  }
  const double reflected = static_cast<double>(luminance(Bsdf(m, {0, 1, 0}, {0, 1, 0}, kToSun).albedo()) /
                                               luminance(bihemisphericalAlbedo(m)));
  EXPECT_NEAR(sent, reflected, 0.02 * reflected);
}

TEST(SunGloss, isOneWhereThereIsNoSun) { EXPECT_EQ(luminance(SunGloss().at(0, {0, 1, 0})), 1); }

}  // namespace
}  // namespace roomlight
