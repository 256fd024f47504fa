// A picture put right in the background: pictures that come of it, its end, failures, and who may change the home when.
#include "view/refiner.h"

#include <gtest/gtest.h>

#include <limits>

#include "support/rooms.h"
#include "support/threads.h"
#include "unit/view/lit_room.h"

namespace roomlight::view {
namespace {

constexpr int kSize = 8, kFirstLook = 4;
constexpr float kGlow = 100;

// All that is seen of it is as bright, without noise.
Scene glow() {
  Scene scene;
  test::addRectangle(scene, {-20, -20, 0}, {40, 0, 0}, {0, 40, 0},
                     test::addMaterial(scene, test::lambertian(0, kGlow)));
  return scene;
}

const Camera kCamera = test::cameraAt({1.5f, 1.2f, 2.5f});

PathSettings settings(int size = kSize) {
  PathSettings s;
  s.width = s.height = size;
  return s;
}

Image flat(int size = kSize) {
  Image image(size, size);
  for (Vec3& p : image.pixels) p = Vec3(kGlow);
  return image;
}

// A refiner of a room with noise, which after each picture waits until it may go on.
struct StepByStep {
  test::Signals pictures, mayGoOn;
  LitRoom room;
  Executor executor;
  Refiner refiner{[this] {
                    pictures.give();
                    mayGoOn.take();
                  },
                  executor};

  StepByStep() {
    EXPECT_TRUE(refiner.begin(room.solution, kCamera, settings(), 1, flat(), kFirstLook).ok());
    pictures.take();
  }
  ~StepByStep() { goOn(); }
  void goOn() { mayGoOn.give(1 << 20); }
};

TEST(Refiner, comesToALastPicture) {
  test::Signals pictures;
  LitRoom room([](Stages&) {}, glow());
  Executor executor;
  Refiner refiner([&] { pictures.give(); }, executor);
  ASSERT_TRUE(refiner.begin(room.solution, kCamera, settings(), 1, flat(), kFirstLook).ok());
  EXPECT_EQ(refiner.solution(), room.solution.get());
  pictures.take();
  const std::optional<RefinedPicture> picture = refiner.take();
  ASSERT_TRUE(picture);
  EXPECT_TRUE(picture->last);
  EXPECT_EQ(picture->samples, static_cast<uint32_t>(kFirstLook));
  EXPECT_LT(picture->relativeError, 0.002f);
  ASSERT_EQ(picture->image.width, kSize);
  EXPECT_NEAR(picture->image.at(3, 3).x, kGlow, 0.01f * kGlow);
  EXPECT_FALSE(refiner.take());
  refiner.stop();
  EXPECT_FALSE(refiner.failed());
  EXPECT_FALSE(refiner.working());
  EXPECT_EQ(refiner.solution(), nullptr);
  EXPECT_TRUE(pictures.tryToTake());  // of its end
  EXPECT_FALSE(pictures.tryToTake());
}

TEST(Refiner, picturesHaveMoreAndMoreSamples) {
  StepByStep steps;
  uint32_t samples = 0;
  for (int i = 0; i < 4; ++i) {
    if (i > 0) steps.mayGoOn.give(), steps.pictures.take();
    const std::optional<RefinedPicture> picture = steps.refiner.take();
    ASSERT_TRUE(picture);
    EXPECT_GT(picture->samples, samples);
    EXPECT_FALSE(picture->last);
    samples = picture->samples;
  }
  EXPECT_TRUE(steps.refiner.working());
}

TEST(Refiner, canBeGivenUp) {
  StepByStep steps;
  steps.refiner.giveUp();
  steps.goOn();
  steps.pictures.take();  // of its end
  EXPECT_FALSE(steps.refiner.working());
  EXPECT_FALSE(steps.refiner.failed());
  EXPECT_TRUE(steps.refiner.take());
}

TEST(Refiner, aHomeThatWasLetGoMayEnd) {
  StepByStep steps;
  steps.refiner.letGo();
  EXPECT_EQ(steps.refiner.solution(), nullptr);
  steps.room.solution.reset();
  EXPECT_TRUE(steps.refiner.working());  // and was not waited for
  steps.goOn();
  steps.refiner.stop();
  EXPECT_TRUE(steps.pictures.tryToTake());  // of its end
  EXPECT_FALSE(steps.pictures.tryToTake());
}

TEST(Refiner, betweenPassesItLetsGoAtOnce) {
  StepByStep steps;
  EXPECT_TRUE(steps.refiner.tryLetGo());
  EXPECT_EQ(steps.refiner.solution(), nullptr);
}

// It would go on for minutes: the picture it begins with is as wrong as can be.
TEST(Refiner, canGoWhileItWorks) {
  constexpr int kLarge = 128;
  test::Signals pictures;
  LitRoom room;
  Image wrong = flat(kLarge);
  for (size_t i = 0; i < wrong.pixels.size(); i += 2) wrong.pixels[i] = Vec3(0);
  {
    Executor executor;
    Refiner refiner([&] { pictures.give(); }, executor);
    ASSERT_TRUE(refiner.begin(room.solution, kCamera, settings(kLarge), 1, wrong, kFirstLook).ok());
    pictures.take();
    EXPECT_TRUE(refiner.working());
  }
}

TEST(Refiner, tellsOfAFailureAndCanBeginAgain) {
  test::Signals pictures;
  LitRoom room([](Stages&) {}, glow());
  Executor executor;
  Refiner refiner([&] { pictures.give(); }, executor);
  // No memory holds that.
  ASSERT_TRUE(
      refiner.begin(room.solution, kCamera, settings(std::numeric_limits<int>::max()), 1, flat(), kFirstLook).ok());
  pictures.take();
  EXPECT_TRUE(refiner.failed());
  EXPECT_FALSE(refiner.working());
  EXPECT_FALSE(refiner.take());
  ASSERT_TRUE(refiner.begin(room.solution, kCamera, settings(), 1, flat(), kFirstLook).ok());
  pictures.take();
  EXPECT_FALSE(refiner.failed());
  EXPECT_TRUE(refiner.take());
}

TEST(Refiner, withoutAThreadItIsIdle) {
  test::Signals pictures;
  test::Threads threads;
  LitRoom room([](Stages&) {}, glow());
  Executor executor(threads.starter());
  Refiner refiner([&] { pictures.give(); }, executor);
  threads.none = true;
  const Status begun = refiner.begin(room.solution, kCamera, settings(), 1, flat(), kFirstLook);
  ASSERT_FALSE(begun.ok());
  EXPECT_NE(begun.error().find("no thread can be started"), std::string::npos);
  EXPECT_FALSE(refiner.working());
  EXPECT_EQ(refiner.solution(), nullptr);
  threads.none = false;
  ASSERT_TRUE(refiner.begin(room.solution, kCamera, settings(), 1, flat(), kFirstLook).ok());
  pictures.take();
  EXPECT_TRUE(refiner.take());
}

}  // namespace
}  // namespace roomlight::view
