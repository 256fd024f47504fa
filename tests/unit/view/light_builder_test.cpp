// A home lit afresh in the background.
#include <gtest/gtest.h>

#include <utility>

#include "support/threads.h"
#include "unit/view/lit_room.h"

namespace roomlight::view {
namespace {

LightBuilder::Work workOn(const ViewHome& home, const std::string& technique = "path") {
  LightBuilder::Work work{{technique, ""}, home.atStart(), {}, {}, 7};
  work.settings.technique = technique, work.settings.threads = 1;
  return work;
}

TEST(LightBuilder, lightsAHome) {
  const ViewHome home("room", roomWithALamp());
  test::Signals ready;
  Executor executor;
  LightBuilder builder(executor);
  ASSERT_TRUE(builder.begin(home, workOn(home), {}, [&] { ready.give(); }).ok());
  EXPECT_TRUE(builder.busy());
  ready.take();
  const auto result = builder.take();
  ASSERT_TRUE(result && result->ok());
  ASSERT_TRUE(result->value());
  EXPECT_EQ(result->value()->key.technique, "path");
  EXPECT_EQ(builder.work().revision, 7u);
  EXPECT_FALSE(builder.busy());
  EXPECT_FALSE(builder.take());
}

TEST(LightBuilder, tellsWhyItFailed) {
  const ViewHome home("room", roomWithALamp());
  test::Signals ready;
  Executor executor;
  LightBuilder builder(executor);
  ASSERT_TRUE(builder.begin(home, workOn(home, "magic"), {}, [&] { ready.give(); }).ok());
  ready.take();
  const auto result = builder.take();
  ASSERT_TRUE(result);
  EXPECT_NE(result->error().find("magic"), std::string::npos);
}

// Its first report is waited for, so that it is under way, and holds it until it was given up.
TEST(LightBuilder, canBeGivenUp) {
  const ViewHome home("room", roomWithALamp());
  test::Signals begun, mayGoOn, ready;
  bool told = false;
  RenderProgress progress;
  progress.report = [&](const std::string&, float) {
    if (std::exchange(told, true)) return;
    begun.give();
    mayGoOn.take();
  };
  Executor executor;
  LightBuilder builder(executor);
  ASSERT_TRUE(builder.begin(home, workOn(home), progress, [&] { ready.give(); }).ok());
  begun.take();
  EXPECT_FALSE(builder.take());
  builder.giveUp();
  mayGoOn.give();
  ready.take();
  const auto result = builder.take();
  ASSERT_TRUE(result && result->ok());
  EXPECT_FALSE(result->value());
}

TEST(LightBuilder, withoutAThreadItIsIdle) {
  const ViewHome home("room", roomWithALamp());
  test::Threads threads;
  test::Signals ready;
  Executor executor(threads.starter());
  LightBuilder builder(executor);
  threads.none = true;
  EXPECT_NE(builder.begin(home, workOn(home), {}, [] {}).error().find("no thread can be started"), std::string::npos);
  EXPECT_FALSE(builder.busy());
  EXPECT_FALSE(builder.take());
  threads.none = false;
  ASSERT_TRUE(builder.begin(home, workOn(home), {}, [&] { ready.give(); }).ok());
  ready.take();
  const auto result = builder.take();
  ASSERT_TRUE(result && result->ok());
  EXPECT_TRUE(result->value());
}

}  // namespace
}  // namespace roomlight::view
