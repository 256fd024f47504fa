// What a session does next, from facts alone: no threads, no clock, no light.
#include "view/schedule.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace roomlight::view {
namespace {

using std::chrono::hours;
using std::chrono::milliseconds;
using std::chrono::seconds;

const TimePoint kNow{hours(1000)};
const LightKey kHybrid{"hybrid", ""}, kPath{"path", ""};

// Looks at a home that is lit, as well as it gets.
WindowFacts restingWindow(const std::string& name = "a", const LightKey& key = kHybrid) {
  WindowFacts w;
  w.name = name, w.isConnected = w.hasSize = w.takesFrames = true;
  w.inputAt = kNow - seconds(60), w.serial = 5;
  SideFacts side;
  side.key = key, side.isCurrent = side.isAveraged = side.isSettled = side.quickSettled = true, side.samples = 64;
  w.sides = {side};
  return w;
}

HomeFacts litHome(const LightKey& key = kHybrid) {
  HomeFacts h;
  h.key = key, h.isLive = h.hasState = h.isSettled = true, h.revision = 1;
  return h;
}

Situation atRest() {
  Situation s;
  s.windows = {restingWindow()}, s.homes = {litHome()};
  return s;
}

SideFacts& side(Situation& s) { return s.windows[0].sides[0]; }

// Quick frames have shown the newest input, nothing better yet.
Situation afterQuickFrames(milliseconds sinceInput) {
  Situation s = atRest();
  s.windows[0].inputAt = kNow - sinceInput;
  side(s).isAveraged = side(s).isSettled = false, side(s).samples = 0;
  return s;
}

template <class A>
const A* find(const Plan& plan) {
  const auto a = std::find_if(plan.actions.begin(), plan.actions.end(),
                              [](const Action& x) { return std::holds_alternative<A>(x); });
  return a == plan.actions.end() ? nullptr : &std::get<A>(*a);
}
template <class A>
bool has(const Plan& plan) {
  return find<A>(plan) != nullptr;
}

TEST(Schedule, whereAllIsDoneItSleepsUntilSomethingHappens) {
  const Plan plan = planNext(atRest(), kNow);
  EXPECT_TRUE(plan.actions.empty());
  EXPECT_EQ(plan.wakeAt, TimePoint::max());
}

TEST(Schedule, aHomeThatIsLookedAtIsLit) {
  Situation s = atRest();
  s.homes.clear();
  const Plan plan = planNext(s, kNow);
  ASSERT_TRUE(has<LightHome>(plan));
  EXPECT_EQ(find<LightHome>(plan)->window, "a");
  s.building = kHybrid;
  EXPECT_FALSE(has<LightHome>(planNext(s, kNow)));
  EXPECT_FALSE(has<GiveUpLighting>(planNext(s, kNow)));
  s.building = kPath;
  EXPECT_TRUE(has<GiveUpLighting>(planNext(s, kNow)));
}

TEST(Schedule, whatCouldNotBeLitIsNotTriedAgainAndOthersAre) {
  Situation s = atRest();
  s.homes.clear(), s.failed = {"hybrid"};
  EXPECT_TRUE(planNext(s, kNow).actions.empty());
  s.windows.push_back(restingWindow("b", kPath));
  ASSERT_TRUE(has<LightHome>(planNext(s, kNow)));
  EXPECT_EQ(find<LightHome>(planNext(s, kNow))->window, "b");
}

TEST(Schedule, aHomeWhoseLightCannotFollowTheSunIsLitAnew) {
  Situation s = atRest();
  s.homes[0].canFollow = false;
  EXPECT_TRUE(has<LightHome>(planNext(s, kNow)));
}

TEST(Schedule, afterAThreadCouldNotBeStartedItWaits) {
  Situation s = atRest();
  s.homes.clear(), s.mayStartAt = kNow + seconds(2);
  const Plan plan = planNext(s, kNow);
  EXPECT_TRUE(plan.actions.empty());
  EXPECT_EQ(plan.wakeAt, s.mayStartAt);
  EXPECT_TRUE(has<LightHome>(planNext(s, plan.wakeAt)));
}

TEST(Schedule, aNewInputIsShownQuickly) {
  Situation s = atRest();
  side(s).isCurrent = false;
  const Plan plan = planNext(s, kNow);
  ASSERT_TRUE(has<MakeFrame>(plan));
  EXPECT_EQ(find<MakeFrame>(plan)->kind, FrameKind::Quick);
  s.windows[0].takesFrames = false;
  EXPECT_FALSE(has<MakeFrame>(planNext(s, kNow)));
}

TEST(Schedule, atRestThePictureGrowsBetterAndNotBefore) {
  Situation s = afterQuickFrames(milliseconds(30));
  const Plan early = planNext(s, kNow);
  EXPECT_TRUE(early.actions.empty());
  EXPECT_EQ(early.wakeAt, kNow + milliseconds(50));
  const Plan later = planNext(s, early.wakeAt);
  ASSERT_TRUE(has<MakeFrame>(later));
  EXPECT_EQ(find<MakeFrame>(later)->kind, FrameKind::Better);
}

TEST(Schedule, whileQuickFramesGetBetterTheyGoOn) {
  Situation s = afterQuickFrames(milliseconds(30));
  side(s).quickSettled = false;
  ASSERT_TRUE(has<MakeFrame>(planNext(s, kNow)));
  EXPECT_EQ(find<MakeFrame>(planNext(s, kNow))->kind, FrameKind::Quick);
}

TEST(Schedule, nobodysPictureGrowsBetterWhileAnotherMoves) {
  Situation s = afterQuickFrames(seconds(5));
  s.windows.push_back(restingWindow("b"));
  s.windows[1].inputAt = kNow - milliseconds(20);
  const Plan plan = planNext(s, kNow);
  EXPECT_FALSE(has<MakeFrame>(plan));
  EXPECT_EQ(plan.wakeAt, kNow + milliseconds(60));
  s.windows[1].isConnected = false, s.windows[1].leftAt = kNow;
  EXPECT_TRUE(has<MakeFrame>(planNext(s, kNow)));
}

TEST(Schedule, anotherDisplayShowsTheSamePicture) {
  Situation s = atRest();
  side(s).isToBeShownAgain = true;
  ASSERT_TRUE(has<MakeFrame>(planNext(s, kNow)));
  EXPECT_EQ(find<MakeFrame>(planNext(s, kNow))->kind, FrameKind::Again);
}

TEST(Schedule, theWindowThatWaitedLongestAndTheSideThatIsBehindComeFirst) {
  Situation s = atRest();
  s.windows.push_back(restingWindow("b"));
  for (WindowFacts& w : s.windows) w.sides[0].isCurrent = false;
  EXPECT_EQ(find<MakeFrame>(planNext(s, kNow))->window, "a");
  SideFacts behind = side(s);
  side(s).isCurrent = true, side(s).lightCame = true, side(s).samples = 0;
  s.windows[0].sides.push_back(behind);
  EXPECT_EQ(find<MakeFrame>(planNext(s, kNow))->side, 1u);
}

TEST(Schedule, lightFollowsAChangeWhileFramesShowIt) {
  Situation s = atRest();
  s.homes[0].hasState = false, side(s).isCurrent = false;
  const Plan plan = planNext(s, kNow);
  EXPECT_TRUE(has<FollowLight>(plan));
  EXPECT_TRUE(has<MakeFrame>(plan));
  s.homes[0].isLive = false;  // there is nothing to look at while it follows
  const Plan still = planNext(s, kNow);
  EXPECT_TRUE(has<FollowLight>(still));
  EXPECT_FALSE(has<MakeFrame>(still));
}

TEST(Schedule, whatTheEyeHasComeToIsShownBeforeBounces) {
  Situation s = atRest();
  s.homes[0].isLive = false, s.homes[0].isSettled = false, side(s).lightCame = true;
  const Plan plan = planNext(s, kNow);
  EXPECT_FALSE(has<FollowLight>(plan));
  EXPECT_TRUE(has<MakeFrame>(plan));
  side(s).lightCame = false;
  EXPECT_TRUE(has<FollowLight>(planNext(s, kNow)));
}

TEST(Schedule, oneHomesLightFollowsAtATimeInTurn) {
  Situation s = atRest();
  s.windows.push_back(restingWindow("b", kPath));
  s.homes.push_back(litHome(kPath));
  s.homes[0].hasState = s.homes[1].hasState = false;
  s.homes[0].followedAt = 4, s.homes[1].followedAt = 3;
  EXPECT_EQ(find<FollowLight>(planNext(s, kNow))->key, kPath);
  s.homes[0].isAway = true;
  EXPECT_FALSE(has<FollowLight>(planNext(s, kNow)));
}

TEST(Schedule, whileLightFollowsQuickFramesLeaveItTheMachine) {
  Situation s = afterQuickFrames(milliseconds(500));
  s.homes[0].isAway = true, side(s).quickSettled = false;
  const Plan plan = planNext(s, kNow);
  EXPECT_FALSE(has<MakeFrame>(plan));
  EXPECT_EQ(plan.wakeAt, kNow + seconds(2));
  EXPECT_TRUE(has<MakeFrame>(planNext(s, plan.wakeAt)));
}

TEST(Schedule, aPickIsAnsweredAtOnceAndAMeterWhenLightHasCome) {
  Situation s = atRest();
  s.windows[0].picks = s.windows[0].meters = true;
  s.windows[0].metersSince = kNow, s.windows[0].metersRevision = 2;
  ASSERT_TRUE(has<AnswerPoints>(planNext(s, kNow)));
  EXPECT_TRUE(find<AnswerPoints>(planNext(s, kNow))->meter);
  s.homes[0].isAway = true;
  EXPECT_FALSE(find<AnswerPoints>(planNext(s, kNow))->meter);
  s.windows[0].picks = false;
  EXPECT_FALSE(has<AnswerPoints>(planNext(s, kNow)));
}

TEST(Schedule, whereChangesGoOnAMeterWaitsASecondForBounces) {
  Situation s = atRest();
  s.windows[0].meters = true, s.windows[0].metersSince = kNow - milliseconds(400);
  s.homes[0].isSettled = false, s.homes[0].revision = 7, s.windows[0].metersRevision = 7;
  const Plan early = planNext(s, kNow);
  EXPECT_FALSE(has<AnswerPoints>(early));
  EXPECT_EQ(early.wakeAt, kNow + milliseconds(600));
  const Plan later = planNext(s, early.wakeAt);
  EXPECT_TRUE(has<AnswerPoints>(later));
  EXPECT_FALSE(has<FollowLight>(later));  // not before it was read
  s.windows[0].metersRevision = 8;
  EXPECT_FALSE(has<AnswerPoints>(planNext(s, early.wakeAt)));
}

Situation averaged() {
  Situation s = atRest();
  side(s).isSettled = false, side(s).samples = 24;
  return s;
}

TEST(Schedule, anAveragedPictureIsRefined) {
  Situation s = averaged();
  EXPECT_TRUE(has<Refine>(planNext(s, kNow)));
  s.refinerWorks = true;
  EXPECT_FALSE(has<Refine>(planNext(s, kNow)));
  s.refinerWorks = false, side(s).failedToRefine = true;
  EXPECT_FALSE(has<Refine>(planNext(s, kNow)));
}

TEST(Schedule, refiningEndsWithAnInputAndForAFinalPicture) {
  Situation s = averaged();
  s.refining = RefiningFacts{"a", 0, 5, 60, 10}, s.refinerWorks = true;
  EXPECT_FALSE(has<StopRefining>(planNext(s, kNow)));
  s.rendersFinal = true;
  EXPECT_TRUE(has<StopRefining>(planNext(s, kNow)));
  s.rendersFinal = false, s.windows[0].serial = 6;
  EXPECT_TRUE(has<StopRefining>(planNext(s, kNow)));
  s.windows[0].serial = 5, s.windows[0].isConnected = false, s.windows[0].leftAt = kNow;
  EXPECT_TRUE(has<StopRefining>(planNext(s, kNow)));
}

TEST(Schedule, picturesTakeTurnsInBeingRefined) {
  Situation s = averaged();
  side(s).samples = 90;
  s.windows.push_back(restingWindow("b"));
  s.windows[1].sides[0].isSettled = false, s.windows[1].sides[0].samples = 24;
  s.refining = RefiningFacts{"a", 0, 5, 60, 30}, s.refinerWorks = true;
  EXPECT_TRUE(planNext(s, kNow).actions.empty());
  s.refining->samples = 60;
  EXPECT_TRUE(has<StopRefining>(planNext(s, kNow)));
  s.refining.reset(), s.refinerWorks = false;
  ASSERT_TRUE(has<Refine>(planNext(s, kNow)));
  EXPECT_EQ(find<Refine>(planNext(s, kNow))->window, "b");
}

TEST(Schedule, homesThatNobodyLooksAtAreDroppedBeyondAFew) {
  Situation s = atRest();
  for (const char* t : {"cone", "path", "photon", "vxgi"}) s.homes.push_back(litHome({t, ""}));
  s.homes[4].isAway = true;
  const Plan plan = planNext(s, kNow);
  ASSERT_EQ(plan.actions.size(), 2u);
  EXPECT_EQ(std::get<DropHome>(plan.actions[0]).key.technique, "photon");
  EXPECT_EQ(std::get<DropHome>(plan.actions[1]).key.technique, "path");
}

TEST(Schedule, lostWindowsAreKeptForAWhile) {
  Situation s = atRest();
  s.windows[0].isConnected = false, s.windows[0].leftAt = kNow - std::chrono::minutes(9);
  const Plan plan = planNext(s, kNow);
  EXPECT_TRUE(plan.actions.empty());
  EXPECT_EQ(plan.wakeAt, kNow + std::chrono::minutes(1));
  EXPECT_TRUE(has<ForgetWindow>(planNext(s, plan.wakeAt)));
  for (int i = 0; i < 64; ++i) s.windows.push_back(restingWindow("w" + std::to_string(i)));
  EXPECT_TRUE(has<ForgetWindow>(planNext(s, kNow)));
}

}  // namespace
}  // namespace roomlight::view
