// A lit scene brought up to date shows what one lit anew shows, by every technique.
#include "engine/lit_scene.h"
#include "engine/technique.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <limits>
#include <thread>

#include "base/progress.h"
#include "engine/live_walk.h"
#include "support/rooms.h"
#include "support/techniques.h"

namespace roomlight {
namespace {

// A room with a table, a box of its own that moves, a shining panel and a lamp.
struct Home {
  Scene scene;
  std::vector<uint32_t> box;
  uint32_t panel = 0;

  Home() {
    const int white = test::addMaterial(scene, test::lambertian(0.7f)),
              wood = test::addMaterial(scene, test::lambertian(0.4f));
    const int shining = test::addMaterial(scene, test::lambertian(0, 900));
    test::addRoom(scene, {0, 0, 0}, {4, 2.6f, 5}, std::vector<int>(6, white));
    test::addBox(scene, {2.5f, 0, 1}, {3.5f, 0.7f, 2.5f}, wood);
    panel = static_cast<uint32_t>(scene.instances.size());
    test::addRectangle(scene, {1.5f, 2.55f, 2}, {1, 0, 0}, {0, 0, 1}, shining);
    const auto first = static_cast<uint32_t>(scene.instances.size());
    test::addBox(scene, {0.52f, 0.01f, 0.53f}, {1.03f, 0.97f, 1.04f}, wood);
    for (uint32_t i = first; i < scene.instances.size(); ++i) {
      scene.instances[i].object = scene.instances[first].object;
      box.push_back(i);
    }
    scene.lamps = {test::pointLamp({3.1f, 1.9f, 3.1f}, 80)};
  }
  void openAWall() {
    scene.meshes.emplace_back();
    scene.instances[5].mesh = static_cast<int>(scene.meshes.size()) - 1;  // one that is not there
  }
  SceneChange moveBox(Vec3 by) {
    for (const uint32_t i : box) scene.instances[i].worldFromObject.w += by;
    return {box, {}, false};
  }
  SceneChange dim(float lamp, float emission) {
    scene.lamps[0].intensityCd = Vec3(80 * lamp);
    scene.materials[static_cast<size_t>(scene.meshes[static_cast<size_t>(scene.instances[panel].mesh)].material)]
        .emission = Vec3(900 * emission);
    return {{}, {panel}, true};
  }
};

constexpr int kWidth = 40, kHeight = 24;

RenderSettings small(const std::string& technique) {
  RenderSettings s;
  s.technique = technique;
  s.samples = 8;  // what is learned of the sky may differ, and with it noise
  s.voxel.voxelSizeM = 0.15f;
  s.radiance.residual = 1e-5f;
  s.hybrid.tolerance = 0, s.hybrid.hitCellM = -1;  // cells are found anew for each picture
  s.vxgi.resolution = 32, s.vxgi.levels = 2;
  s.lpv.cells = 16, s.lpv.coarseCells = 0, s.lpv.mapSize = 64;
  s.photon.photons = 20000, s.photon.causticPhotons = 0, s.photon.importons = 1000;
  return s;
}

class LitSceneUpdate : public ::testing::TestWithParam<std::string> {
 protected:
  RenderStats stats_;
  RenderProgress silent_;
  Stages stages_{silent_, stats_};
  Camera camera_ = test::cameraAt({2, 1.4f, 4.6f});

  // For no camera: one that a thing has moved before would tell another room to vxgi and lpv.
  std::unique_ptr<LitScene> open(const Scene& scene) {
    return std::move(lightScene(scene, small(GetParam()), stages_).value());
  }
  // The same, with what is finest about one place around the camera.
  Result<std::unique_ptr<LitScene>> openForCamera(const Scene& scene, Stages& stages) const {
    return lightScene(scene, small(GetParam()), stages, {true, {&camera_, 1}});
  }
  Image picture(const LitScene& lit) const { return lit.picture(camera_, kWidth, kHeight); }

  // Root mean square, relative to the mean; infinite for black pictures.
  static double difference(const Image& a, const Image& b) {
    double squares = 0, mean = 0;
    for (size_t i = 0; i < a.pixels.size(); ++i) {
      const double d = luminance(a.pixels[i]) - luminance(b.pixels[i]);
      squares += d * d, mean += luminance(b.pixels[i]);
    }
    const double n = static_cast<double>(a.pixels.size());
    return mean > 0 ? std::sqrt(squares / n) / (mean / n) : std::numeric_limits<double>::infinity();
  }
  // What bounces leave out is all that may differ.
  static void expectSame(const Image& a, const Image& b) {
    ASSERT_EQ(a.pixels.size(), b.pixels.size());
    EXPECT_LT(difference(a, b), 2e-3);
  }
  // A change was seen.
  static void expectOther(const Image& a, const Image& b) {
    ASSERT_EQ(a.pixels.size(), b.pixels.size());
    EXPECT_GT(difference(a, b), 1e-2);
  }
};

TEST_P(LitSceneUpdate, aMovedThingIsWhereItIs) {
  Home home;
  const auto lit = open(home.scene);
  const Image before = picture(*lit);
  lit->update(home.moveBox({1.1f, 0, 1.3f}), stages_);
  const Image moved = picture(*lit);
  expectSame(moved, picture(*open(home.scene)));
  lit->update(home.moveBox({-1.1f, 0, -1.3f}), stages_);
  expectSame(picture(*lit), before);
  double differs = 0;
  for (size_t i = 0; i < moved.pixels.size(); ++i)
    differs = std::max<double>(
        differs, std::abs(luminance(moved.pixels[i] - before.pixels[i])) / (luminance(before.pixels[i]) + 1));
  EXPECT_GT(differs, 0.2);  // it was seen to move
}

TEST_P(LitSceneUpdate, dimmedLightsGiveLess) {
  Home home;
  const auto lit = open(home.scene);
  const Image before = picture(*lit);
  lit->update(home.dim(0.3f, 0.5f), stages_);
  const Image dimmed = picture(*lit);
  EXPECT_LT(test::meanLuminance(dimmed), 0.6 * test::meanLuminance(before));
  expectSame(dimmed, picture(*open(home.scene)));
  lit->update(home.dim(1, 0), stages_);
  expectSame(picture(*lit), picture(*open(home.scene)));
  lit->update(home.dim(1, 1), stages_);
  expectSame(picture(*lit), before);
}

TEST_P(LitSceneUpdate, lightsThatWereOffAtFirstCanBeSwitchedOn) {
  Home home;
  home.dim(0, 0);
  const auto lit = open(home.scene);
  EXPECT_EQ(test::meanLuminance(picture(*lit)), 0);
  lit->update(home.dim(0.5f, 1), stages_);
  expectSame(picture(*lit), picture(*open(home.scene)));
}

TEST_P(LitSceneUpdate, aHiddenThingIsGone) {
  Home home;
  home.scene.meshes.emplace_back();
  const auto lit = open(home.scene);
  const Image before = picture(*lit);
  for (const uint32_t i : home.box) home.scene.instances[i].mesh = static_cast<int>(home.scene.meshes.size()) - 1;
  lit->update({home.box, {}, false}, stages_);
  const Image gone = picture(*lit);
  expectOther(gone, before);
  expectSame(gone, picture(*open(home.scene)));
}

// Not lit anew with every look, as from above a home where all that is seen lies on one side.
TEST_P(LitSceneUpdate, anEyeOutsideKeepsTheLight) {
  Home home;
  const Camera above = test::cameraAt({2, 8, 2});
  const auto lit = std::move(lightScene(home.scene, small(GetParam()), stages_, {true, {&above, 1}}).value());
  const size_t done = stats_.stages.size();
  lit->lookFrom(above, stages_);
  EXPECT_EQ(stats_.stages.size(), done);
}

// From room to room, not within one.
TEST_P(LitSceneUpdate, lightThatIsFinestAboutOnePlaceFollowsTheEye) {
  const bool isFinestSomewhere = GetParam() == "vxgi" || GetParam() == "lpv";
  Home home;
  const auto lit = std::move(openForCamera(home.scene, stages_).value());
  const size_t done = stats_.stages.size();
  lit->lookFrom(test::cameraAt({1, 1.2f, 4}), stages_);
  EXPECT_EQ(stats_.stages.size(), done);
  lit->lookFrom(test::cameraAt({2, 8, 2}), stages_);
  EXPECT_EQ(stats_.stages.size() > done, isFinestSomewhere);
}

// From another thread, sooner and later: there is no light then, or a whole one.
TEST_P(LitSceneUpdate, canBeCancelledAtAnyTime) {
  constexpr int kTimes = 12;
  Home home;
  const Stopwatch watch;
  const auto undisturbed = openForCamera(home.scene, stages_);
  const double seconds = watch.seconds();
  const Image whole = picture(*undisturbed.value());
  for (int i = 0; i < kTimes; ++i) {
    std::atomic<bool> cancelled = i == 0;
    const auto later = [&](double s) {
      return std::thread([&cancelled, s] {
        std::this_thread::sleep_for(std::chrono::duration<double>(s));
        cancelled = true;
      });
    };
    RenderProgress progress;
    progress.cancelled = &cancelled;
    Stages stages(progress, stats_);
    std::thread first = later(seconds * i / kTimes);
    const auto lit = openForCamera(home.scene, stages);
    first.join();
    ASSERT_TRUE(lit.ok());
    if (i == 0) {
      EXPECT_FALSE(lit.value());
    }
    if (lit.value()) expectSame(picture(*lit.value()), whole);
    const auto other = open(home.scene);
    cancelled = false;
    std::thread second = later(0.5 * seconds * i / kTimes);
    other->update(home.moveBox({0.11f, 0, 0.13f}), stages);
    const bool wasWhole = !cancelled;
    second.join();
    if (wasWhole) expectSame(picture(*other), picture(*open(home.scene)));
    home.moveBox({-0.11f, 0, -0.13f});
  }
}

// Those whose light follows suns and sky; with the others a scene is lit anew.
class LitSceneDaylight : public LitSceneUpdate {};

TEST_P(LitSceneDaylight, theSunMoves) {
  Home home;
  home.openAWall();
  home.scene.sky.luminanceCdM2 = Vec3(200);
  home.scene.suns = {{"sun", normalize(Vec3(0.3f, 0.8f, 1)), Vec3(20000), 0}};
  const auto lit = open(home.scene);
  const Image before = picture(*lit);
  home.scene.suns[0].toLight = normalize(Vec3(-0.4f, 0.5f, 1)), home.scene.sky.luminanceCdM2 = Vec3(90);
  SceneChange change;
  change.daylight = true;
  lit->update(change, stages_);
  const Image later = picture(*lit);
  expectOther(later, before);
  expectSame(later, picture(*open(home.scene)));
  home.scene.suns[0].toLight = normalize(Vec3(0.3f, 0.8f, 1)), home.scene.sky.luminanceCdM2 = Vec3(200);
  change = home.moveBox({1.1f, 0, 1.3f});
  change.daylight = true;
  lit->update(change, stages_);
  expectSame(picture(*lit), picture(*open(home.scene)));
  lit->update(home.moveBox({-1.1f, 0, -1.3f}), stages_);
  expectSame(picture(*lit), before);
}

TEST_P(LitSceneDaylight, daylightThatWasOffAtFirstCanBeSwitchedOn) {
  Home home;
  home.openAWall();
  const auto lit = open(home.scene);
  const Image before = picture(*lit);
  home.scene.sky.luminanceCdM2 = Vec3(200);
  home.scene.suns = {{"sun", normalize(Vec3(0.3f, 0.8f, 1)), Vec3(20000), 0}};
  SceneChange change;
  change.daylight = true;
  lit->update(change, stages_);
  const Image later = picture(*lit);
  expectOther(later, before);
  expectSame(later, picture(*open(home.scene)));
}

INSTANTIATE_TEST_SUITE_P(Techniques, LitSceneUpdate, ::testing::ValuesIn(test::allTechniques()),
                         [](const auto& test) { return test.param; });
INSTANTIATE_TEST_SUITE_P(Techniques, LitSceneDaylight,
                         ::testing::ValuesIn(test::techniquesThatCan(&Technique::followsDaylight)),
                         [](const auto& test) { return test.param; });

TEST(MeasureWalk, playsEveryFrameAndPutsAllBack) {
  Home home;
  Walk walk;
  walk.seconds = 1, walk.framesPerSecond = 4;
  walk.camera = {{0, 1}, {{2, 1}, {1.4f, 1.4f}, {4.6f, 4}, {2, 2}, {1, 1}, {1, 1}, {1, 1}}};
  Walk::Thing thing{home.box, {1, 0.5f, 1}, {}, {{0, 1}, {{0, 1}, {0, 0}, {0, 1}, {0, 2}}}};
  for (const uint32_t i : home.box) thing.atRest.push_back(home.scene.instances[i].worldFromObject);
  walk.things.push_back(thing);
  RenderSettings settings = frameSettings(small("hybrid"));
  settings.width = kWidth, settings.height = kHeight;
  std::vector<int> numbers;
  const Result<WalkFrames> frames = measureWalk(home.scene, walk, settings, {}, [&](const ShownFrame& f) {
    numbers.push_back(f.number);
    EXPECT_GT(test::meanLuminance(f.image), 1);
    return Status(Ok{});
  });
  ASSERT_TRUE(frames.ok());
  EXPECT_TRUE(frames.value().complete);
  EXPECT_EQ(numbers, (std::vector<int>{0, 1, 2, 3}));
  EXPECT_EQ(frames.value().frames.size(), 4u);
  EXPECT_GT(frames.value().framesPerSecond(), 0);
  EXPECT_EQ(home.scene.instances[home.box[0]].worldFromObject.w, thing.atRest[0].w);
}

TEST(MeasureWalk, quickFramesAreAsBright) {
  Home home;
  Walk walk;
  walk.seconds = 1, walk.framesPerSecond = 4;
  walk.camera = {{0, 1}, {{2, 1}, {1.4f, 1.4f}, {4.6f, 4}, {2, 2}, {1, 1}, {1, 1}, {1, 1}}};
  RenderSettings settings = frameSettings(small("hybrid"));
  settings.width = kWidth, settings.height = kHeight;
  const auto brightness = [&](double quickMs) {
    settings.frames.quickMs = quickMs;
    std::vector<double> all;
    const Result<WalkFrames> frames = measureWalk(home.scene, walk, settings, {}, [&](const ShownFrame& f) {
      all.push_back(test::meanLuminance(f.image));
      return Status(Ok{});
    });
    EXPECT_TRUE(frames.ok());
    return all;
  };
  const std::vector<double> whole = brightness(0), quick = brightness(1e4);
  ASSERT_EQ(whole.size(), 4u);
  ASSERT_EQ(quick.size(), 4u);
  for (size_t i = 0; i < quick.size(); ++i) EXPECT_NEAR(quick[i], whole[i], 0.1 * whole[i]) << i;
  settings.technique = "path";
  EXPECT_NE(measureWalk(home.scene, walk, settings).error().find("frames.quickMs"), std::string::npos);
}

}  // namespace
}  // namespace roomlight
