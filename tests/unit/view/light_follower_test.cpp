// Light that follows in the background: how it begins, ends, fails, is given up.
#include "view/light_follower.h"

#include <gtest/gtest.h>

#include <stdexcept>

#include "support/signals.h"
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
  LightFollower follower;
  ASSERT_TRUE(follower.begin(room.all, *room.home, room.dimmed(), 1, [&] { ready.give(); }).ok());
  EXPECT_EQ(follower.home(), room.home.get());
  EXPECT_FALSE(follower.done());
  mayEnd.give();
  ready.take();
  EXPECT_TRUE(follower.done());
  const FollowedLight followed = follower.finish();
  EXPECT_EQ(followed.home, room.home.get());
  ASSERT_TRUE(followed.change);
  EXPECT_TRUE(followed.change->lamps);
  EXPECT_EQ(followed.error, "");
  EXPECT_EQ(room.home->state, room.dimmed());
  EXPECT_NEAR(room.home->scene.lamps[0].intensityCd.y, 50, 0.01);
  EXPECT_EQ(follower.home(), nullptr);
  EXPECT_EQ(follower.finish().home, nullptr);
}

TEST(LightFollower, waitsForItsEnd) {
  bool ended = false;
  LitRoom room([&](Stages&) { ended = true; });
  LightFollower follower;
  ASSERT_TRUE(follower.begin(room.all, *room.home, room.dimmed(), 1, nobodyWaits).ok());
  EXPECT_TRUE(follower.finish().change);
  EXPECT_TRUE(ended);
}

TEST(LightFollower, canBeCancelled) {
  EndlessLight light;
  LitRoom room(light.relight());
  LightFollower follower;
  ASSERT_TRUE(follower.begin(room.all, *room.home, room.dimmed(), 1, nobodyWaits).ok());
  light.begun.take();
  follower.cancel();
  EXPECT_TRUE(light.cancelled);
  EXPECT_EQ(follower.home(), nullptr);
}

TEST(LightFollower, canGoWhileItWorks) {
  EndlessLight light;
  LitRoom room(light.relight());
  {
    LightFollower follower;
    ASSERT_TRUE(follower.begin(room.all, *room.home, room.dimmed(), 1, nobodyWaits).ok());
    light.begun.take();
  }
  EXPECT_TRUE(light.cancelled);
}

TEST(LightFollower, tellsWhyItFailedAndCanBeginAgain) {
  bool fails = true;
  LitRoom room([&](Stages&) {
    if (fails) throw std::runtime_error("no room for light");
  });
  LightFollower follower;
  ASSERT_TRUE(follower.begin(room.all, *room.home, room.dimmed(), 1, nobodyWaits).ok());
  const FollowedLight failed = follower.finish();
  EXPECT_EQ(failed.home, room.home.get());
  EXPECT_FALSE(failed.change);
  EXPECT_EQ(failed.error, "no room for light");
  fails = false;
  ASSERT_TRUE(follower.begin(room.all, *room.home, room.all.atStart(), 1, nobodyWaits).ok());
  const FollowedLight followed = follower.finish();
  EXPECT_TRUE(followed.change);
  EXPECT_EQ(followed.error, "");
}

TEST(LightFollower, withoutAThreadItIsIdleAndTheHomeAsItWas) {
  test::Threads threads;
  LitRoom room;
  LightFollower follower(threads.starter());
  threads.none = true;
  const Status begun = follower.begin(room.all, *room.home, room.dimmed(), 1, nobodyWaits);
  ASSERT_FALSE(begun.ok());
  EXPECT_NE(begun.error().find("no thread can be started"), std::string::npos);
  EXPECT_EQ(begun.error().find('\n'), std::string::npos);
  EXPECT_EQ(follower.home(), nullptr);
  EXPECT_EQ(room.home->state, room.all.atStart());
  threads.none = false;
  ASSERT_TRUE(follower.begin(room.all, *room.home, room.dimmed(), 1, nobodyWaits).ok());
  EXPECT_TRUE(follower.finish().change);
}

}  // namespace
}  // namespace roomlight::view
