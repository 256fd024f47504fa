// Light that follows in the background: how it begins, ends, fails, is given up.
#include "view/light_follower.h"

#include <gtest/gtest.h>

#include <stdexcept>
#include <utility>

#include "support/threads.h"
#include "unit/view/lit_room.h"

namespace roomlight::view {
namespace {

void nobodyWaits() {}

// Light that goes on until it is cancelled, and tells when it has begun.
struct EndlessLight {
  test::Signals begun;
  bool cancelled = false;

  ToldLight::Relight relight() {
    return [this](Stages& stages) {
      begun.give();
      while (!stages.cancelled()) std::this_thread::yield();
      cancelled = true;
    };
  }
};

TEST(LightFollower, bringsTheHomeToWhereItIsWanted) {
  test::Signals mayEnd, ready;
  LitRoom room([&](Stages&) { mayEnd.take(); });
  Executor executor;
  LightFollower follower(executor);
  ASSERT_TRUE(follower.begin(room.all, room.solution, room.dimmed(), 1, [&] { ready.give(); }).ok());
  EXPECT_TRUE(follower.busy());
  EXPECT_FALSE(room.solution);  // nobody else can touch it
  EXPECT_FALSE(follower.done());
  mayEnd.give();
  ready.take();
  EXPECT_TRUE(follower.done());
  const FollowedLight followed = follower.finish();
  ASSERT_TRUE(followed.solution);
  ASSERT_TRUE(followed.change);
  EXPECT_TRUE(followed.change->lamps);
  EXPECT_EQ(followed.error, "");
  EXPECT_EQ(followed.solution->state, room.dimmed());
  EXPECT_NEAR(followed.solution->scene.lamps[0].intensityCd.y, 50, 0.01);
  EXPECT_FALSE(follower.busy());
  EXPECT_FALSE(follower.finish().solution);
}

TEST(LightFollower, waitsForItsEnd) {
  bool ended = false;
  LitRoom room([&](Stages&) { ended = true; });
  Executor executor;
  LightFollower follower(executor);
  ASSERT_TRUE(follower.begin(room.all, room.solution, room.dimmed(), 1, nobodyWaits).ok());
  EXPECT_TRUE(follower.finish().change);
  EXPECT_TRUE(ended);
}

TEST(LightFollower, canBeCancelled) {
  EndlessLight light;
  LitRoom room(light.relight());
  Executor executor;
  LightFollower follower(executor);
  ASSERT_TRUE(follower.begin(room.all, room.solution, room.dimmed(), 1, nobodyWaits).ok());
  light.begun.take();
  follower.cancel();
  EXPECT_TRUE(light.cancelled);
  EXPECT_FALSE(follower.busy());
}

TEST(LightFollower, canGoWhileItWorks) {
  EndlessLight light;
  LitRoom room(light.relight());
  {
    Executor executor;
    LightFollower follower(executor);
    ASSERT_TRUE(follower.begin(room.all, room.solution, room.dimmed(), 1, nobodyWaits).ok());
    light.begun.take();
  }
  EXPECT_TRUE(light.cancelled);
}

TEST(LightFollower, tellsWhyItFailedAndCanBeginAgain) {
  bool fails = true;
  LitRoom room([&](Stages&) {
    if (fails) throw std::runtime_error("no room for light");
  });
  Executor executor;
  LightFollower follower(executor);
  ASSERT_TRUE(follower.begin(room.all, room.solution, room.dimmed(), 1, nobodyWaits).ok());
  FollowedLight failed = follower.finish();
  ASSERT_TRUE(failed.solution);
  EXPECT_FALSE(failed.change);
  EXPECT_EQ(failed.error, "no room for light");
  fails = false;
  room.solution = std::move(failed.solution);
  ASSERT_TRUE(follower.begin(room.all, room.solution, room.all.atStart(), 1, nobodyWaits).ok());
  const FollowedLight followed = follower.finish();
  EXPECT_TRUE(followed.change);
  EXPECT_EQ(followed.error, "");
}

TEST(LightFollower, withoutAThreadItIsIdleAndTheHomeAsItWas) {
  test::Threads threads;
  LitRoom room;
  Executor executor(threads.starter());
  LightFollower follower(executor);
  threads.none = true;
  const Status begun = follower.begin(room.all, room.solution, room.dimmed(), 1, nobodyWaits);
  ASSERT_FALSE(begun.ok());
  EXPECT_NE(begun.error().find("no thread can be started"), std::string::npos);
  EXPECT_EQ(begun.error().find('\n'), std::string::npos);
  EXPECT_FALSE(follower.busy());
  ASSERT_TRUE(room.solution);
  EXPECT_EQ(room.solution->state, room.all.atStart());
  threads.none = false;
  ASSERT_TRUE(follower.begin(room.all, room.solution, room.dimmed(), 1, nobodyWaits).ok());
  EXPECT_TRUE(follower.finish().change);
}

}  // namespace
}  // namespace roomlight::view
