// Technique hybrid with little time, with much, and without end.
#include <gtest/gtest.h>

#include <cmath>

#include "base/progress.h"
#include "engine/render.h"
#include "engine/time_plan.h"
#include "support/rooms.h"

namespace roomlight {
namespace {

struct LitRoom {
  Scene scene;
  Camera camera;
  LitRoom() {
    const int wall = test::addMaterial(scene, test::lambertian(0.6f));
    test::addRoom(scene, {0, 0, 0}, {4, 2.6f, 3}, std::vector<int>(6, wall));
    test::addBox(scene, {1, 0, 1}, {1.6f, 0.9f, 1.6f}, wall);
    scene.lamps.push_back(test::pointLamp({2.8f, 2.0f, 1.5f}, 100));
    camera.worldFromCamera.w = {2, 1.3f, 2.8f};
  }
};

RenderSettings small(double timeLimitS) {
  RenderSettings settings;
  settings.width = 64, settings.height = 36;
  settings.timeLimitS = timeLimitS;
  return settings;
}

double number(const Rendered& rendered, const std::string& name) {
  for (const auto& [n, value] : rendered.stats.numbers) {
    if (n == name) return value;
  }
  return -1;
}

bool isPicture(const Image& image) {
  if (image.width != 64 || image.height != 36) return false;
  return std::all_of(image.pixels.begin(), image.pixels.end(), [](Vec3 p) { return isFinite(p) && luminance(p) > 0; });
}

TEST(TimeLimit, tooLittleTimeStillGivesAPicture) {
  const LitRoom room;
  const Rendered rendered = render(room.scene, room.camera, small(1e-4)).value();
  EXPECT_TRUE(isPicture(rendered.image));
  EXPECT_TRUE(rendered.complete);
  EXPECT_LT(number(rendered, "pixelsGathered"), 64 * 36);
  EXPECT_EQ(number(rendered, "estimatedMse"), -1) << "no time to tell";
}

TEST(TimeLimit, lightOnVoxelsIsGivenUpWhenItsTimeIsOver) {
  const LitRoom room;
  const RayScene rays(room.scene);
  const Lights lights(room.scene);
  RenderStats stats;
  const RenderProgress quiet;
  Stages stages(quiet, stats);
  RadianceSettings radiance;
  radiance.pyramid = false;
  EXPECT_TRUE(lightVoxelsBefore(0, rays, lights, {}, radiance, stages).field.irradianceLux.empty());
  const VoxelLight light = lightVoxelsBefore(1e9, rays, lights, {}, radiance, stages);
  EXPECT_EQ(light.field.irradianceLux.size(), light.voxels.slots.size());
}

// The allowance is for busy machines.
TEST(TimeLimit, timeThatIsLeftPutsThePictureRight) {
  const LitRoom room;
  const Stopwatch watch;
  const Rendered rendered = render(room.scene, room.camera, small(2)).value();
  EXPECT_LT(watch.seconds(), 4);
  EXPECT_TRUE(isPicture(rendered.image));
  EXPECT_GT(number(rendered, "pathSamples"), 1);
  EXPECT_GT(number(rendered, "estimatedMse"), 0);
  EXPECT_LT(number(rendered, "estimatedMse"), 0.01);
}

TEST(TimeLimit, withoutOneAPictureGoesOnUntilItsErrorIsSmall) {
  const LitRoom room;
  RenderSettings settings = small(0);
  settings.samples = 1, settings.blendUntilMse = 1e-5;  // one sample leaves more
  int estimates = 0;
  RenderProgress progress;
  progress.estimate = [&](double relativeError, double) { estimates += relativeError > 0; };
  const Rendered rendered = render(room.scene, room.camera, settings, progress).value();
  EXPECT_GT(estimates, 0);
  EXPECT_LE(number(rendered, "estimatedMse"), settings.blendUntilMse);
  EXPECT_GT(number(rendered, "pathSamples"), 1);
  settings.blend = false;
  EXPECT_EQ(number(render(room.scene, room.camera, settings).value(), "pathSamples"), -1);
}

// Rays go on as long as more error is estimated, without a path.
TEST(ErrorAim, raysGoOnUntilTheErrorIsSmall) {
  const LitRoom room;
  RenderSettings settings = small(0);
  settings.blend = false, settings.blendUntilMse = 0.1;
  const Rendered rough = render(room.scene, room.camera, settings).value();
  settings.blendUntilMse = 1e-9;
  const Rendered fine = render(room.scene, room.camera, settings).value();
  EXPECT_LT(number(rough, "samples"), 64);
  EXPECT_GT(number(fine, "samples"), number(rough, "samples"));
  EXPECT_GT(number(fine, "rays"), 1.2 * number(rough, "rays"));
}

TEST(TimeLimit, whatIsStoppedWhileItIsPutRightIsKept) {
  const LitRoom room;
  RenderSettings settings = small(0);
  settings.blendUntilMse = 1e-12;
  std::atomic<bool> cancelled = false;
  RenderProgress progress;
  progress.cancelled = &cancelled;
  int estimates = 0;
  progress.estimate = [&](double, double) {
    cancelled = ++estimates > 1;
  };  // the first is that of the gathered picture
  const Rendered rendered = render(room.scene, room.camera, settings, progress).value();
  EXPECT_FALSE(rendered.complete);
  EXPECT_GT(number(rendered, "pathSamples"), 1);
  EXPECT_TRUE(isPicture(rendered.image));
}

TEST(TimeLimit, enlargedPicturesKeepTheirPlace) {
  Image ramp(4, 2);
  for (int y = 0; y < 2; ++y) {
    for (int x = 0; x < 4; ++x) ramp.at(x, y) = Vec3(static_cast<float>(x));
  }
  const Image large = enlarged(ramp, 16, 6);
  EXPECT_NEAR(large.at(0, 0).x, 0, 1e-6);
  EXPECT_NEAR(large.at(15, 5).x, 3, 1e-6);
  for (int x = 2; x < 14; ++x) EXPECT_NEAR(large.at(x, 3).x, (static_cast<float>(x) + 0.5f) / 4 - 0.5f, 1e-5) << x;
}

// A room lit by way of a white ceiling alone.
TEST(NoiseLevel, raysGoOnUntilNoMoreNoiseIsLeft) {
  LitRoom room;
  room.scene.lamps[0].position = {2.8f, 2.55f, 1.5f};
  RenderSettings settings = small(0);
  settings.noiseLevel = 0.1;
  const Rendered rough = render(room.scene, room.camera, settings).value();
  settings.noiseLevel = 0.01;
  const Rendered fine = render(room.scene, room.camera, settings).value();
  EXPECT_GT(number(fine, "rays"), 1.5 * number(rough, "rays"));
  EXPECT_GT(number(fine, "samples"), 2 * number(rough, "samples"));
  for (const Rendered& r : {rough, fine}) {
    EXPECT_GT(number(r, "estimatedError"), 0);
    EXPECT_LT(number(r, "estimatedError"), 0.1);
  }
}

}  // namespace
}  // namespace roomlight
