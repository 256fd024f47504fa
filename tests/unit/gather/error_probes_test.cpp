// Estimates of a picture's error held against what it is off by, in a room whose every light is known.
#include "gather/error_probes.h"

#include <gtest/gtest.h>

#include "base/random.h"
#include "gather/ray_gather.h"
#include "gather/ray_shader.h"
#include "support/rooms.h"
#include "voxel/voxelise.h"

namespace roomlight {
namespace {

// A closed room whose walls shine alike: every pixel has 10 / (1 - 0.5) cd/m².
struct Furnace {
  Scene scene;
  Camera camera;

  Furnace() {
    const int wall = test::addMaterial(scene, test::lambertian(0.5f, 10));
    test::addRoom(scene, {0.013f, 0.007f, 0.021f}, {4, 2.6f, 3}, std::vector<int>(6, wall));
    camera.worldFromCamera = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {2, 1.3f, 2.5f}};
  }
};

class Probes : public testing::Test {
 protected:
  Probes()
      : rays_(furnace_.scene),
        lights_(furnace_.scene),
        voxels_(voxelise(furnace_.scene, {.voxelSizeM = 0.1f}).voxels),
        field_(illuminate(rays_, lights_, voxels_, {})) {
    settings_.width = settings_.height = 64, settings_.hitCellM = -1;
  }
  ErrorLeft errorOf(const Image& picture, bool closely = false) const {
    const RayShader shader(rays_, lights_, voxels_, field_, settings_);
    return ErrorProbes({rays_, lights_}, shader, furnace_.camera, settings_, closely, {}).of(picture);
  }
  Image even(float luminance) const {
    Image image(settings_.width, settings_.height);
    std::fill(image.pixels.begin(), image.pixels.end(), Vec3(luminance));
    return image;
  }

  Furnace furnace_;
  RayScene rays_;
  Lights lights_;
  Voxels voxels_;
  RadianceField field_;
  RayGatherSettings settings_;
};

TEST_F(Probes, errorOfARightPictureIsSmall) {
  EXPECT_GE(errorOf(even(20)).relative, 0);
  EXPECT_LT(errorOf(even(20)).relative, 0.01);
  EXPECT_LT(errorOf(even(20)).srgbMse, 1e-4);
}

// Of an even picture and of one with noise of its own.
TEST_F(Probes, tellsByHowMuchAPictureIsOff) {
  EXPECT_NEAR(errorOf(even(22)).relative, 2 / (22 * 1.05), 0.004);
  Image noisy = even(20);
  for (size_t i = 0; i < noisy.pixels.size(); ++i) noisy.pixels[i] *= mix64(i) & 1 ? 1.1f : 0.9f;
  EXPECT_NEAR(errorOf(noisy).relative, 2 / (20 * 1.05), 0.006);
}

// Encoded, 18 % grey exposed as the mean of an even picture becomes 0.461; a tenth more, 0.481.
TEST_F(Probes, tellsTheErrorOfWhatIsEncoded) { EXPECT_NEAR(std::sqrt(errorOf(even(22), true).srgbMse), 0.0195, 0.002); }

// Of a picture of single samples, and of one of many: what probes differ by among themselves is no error.
TEST(ErrorOfNoise, isToldThroughTheNoiseOfProbes) {
  Scene scene;
  const int wall = test::addMaterial(scene, test::lambertian(0.6f));
  test::addRoom(scene, {0.013f, 0.007f, 0.021f}, {4, 2.6f, 3}, std::vector<int>(6, wall));
  test::addBox(scene, {1, 0, 1}, {1.6f, 0.9f, 1.6f}, wall);
  test::addBox(scene, {0.5f, 2.2f, 1}, {0.6f, 2.3f, 1.1f}, test::addMaterial(scene, test::lambertian(0, 5000)));
  Camera camera;
  camera.worldFromCamera.w = {2, 1.3f, 2.8f};
  const RayScene rays(scene);
  const Lights lights(scene);
  const Voxels voxels = voxelise(scene, {.voxelSizeM = 0.1f}).voxels;
  const RadianceField field = illuminate(rays, lights, voxels, {});
  RayGatherSettings settings;
  settings.width = 96, settings.height = 64, settings.hitCellM = -1, settings.filterPasses = 0, settings.tolerance = 0;
  const RayShader shader(rays, lights, voxels, field, settings);
  const auto picture = [&](int samples, uint64_t seed) {
    RayGatherSettings some = settings;
    some.samples = samples, some.seed = seed;
    return gatherPicture(rays, lights, shader, camera, some, {}).image;
  };
  const Image few = picture(1, 5), many = picture(128, 6);
  double mean = 0, squares = 0;
  for (const Vec3& p : many.pixels) mean += static_cast<double>(luminance(p)) / static_cast<double>(many.pixels.size());
  for (size_t i = 0; i < many.pixels.size(); ++i) {
    const double level = static_cast<double>(luminance(few.pixels[i])) + 0.05 * mean,
                 off = std::clamp(static_cast<double>(luminance(few.pixels[i] - many.pixels[i])) / level, -1.0, 1.0);
    squares += off * off / static_cast<double>(many.pixels.size());
  }
  const ErrorProbes probes({rays, lights}, shader, camera, settings, true, {});
  EXPECT_GT(std::sqrt(squares), 0.05);
  EXPECT_NEAR(probes.of(few).relative, std::sqrt(squares), 0.25 * std::sqrt(squares));
  EXPECT_LT(probes.of(many).relative, 0.3 * std::sqrt(squares));
}

TEST_F(Probes, knowsNothingOfAPictureWithoutPixels) { EXPECT_LT(errorOf(Image()).relative, 0); }

}  // namespace
}  // namespace roomlight
