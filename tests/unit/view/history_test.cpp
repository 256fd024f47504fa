#include "view/history.h"

#include <gtest/gtest.h>

namespace roomlight::view {
namespace {

HomeState dimmed(float dim) {
  HomeState s;
  s.lamps.emplace_back().dim = dim;
  return s;
}

TEST(History, goesBackAndForth) {
  History history;
  history.step(dimmed(1), "one", "");
  history.step(dimmed(0.5f), "two", "");
  EXPECT_EQ(history.undoLabel(), "two");
  EXPECT_EQ(history.undo(dimmed(0.2f)), dimmed(0.5f));
  EXPECT_EQ(history.redoLabel(), "two");
  EXPECT_EQ(history.undo(dimmed(0.5f)), dimmed(1));
  EXPECT_FALSE(history.canUndo());
  EXPECT_EQ(history.redo(dimmed(1)), dimmed(0.5f));
  EXPECT_EQ(history.redo(dimmed(0.5f)), dimmed(0.2f));
  EXPECT_FALSE(history.canRedo());
}

TEST(History, oneGestureIsOneStep) {
  History history;
  history.step(dimmed(1), "drag", "a");
  history.step(dimmed(0.9f), "drag", "a");
  history.step(dimmed(0.8f), "drag", "b");
  history.step(dimmed(0.7f), "drag", "a");
  EXPECT_EQ(history.undo(dimmed(0.6f)), dimmed(0.7f));
  EXPECT_EQ(history.undo(dimmed(0.7f)), dimmed(0.8f));
  EXPECT_EQ(history.undo(dimmed(0.8f)), dimmed(1));
  EXPECT_FALSE(history.canUndo());
}

TEST(History, aNewStepForgetsWhatWasTakenBack) {
  History history;
  history.step(dimmed(1), "one", "g");
  history.undo(dimmed(0.5f));
  history.step(dimmed(1), "two", "g");
  EXPECT_FALSE(history.canRedo());
  EXPECT_EQ(history.undoLabel(), "two");
}

TEST(History, keepsTwoHundredSteps) {
  History history;
  for (int i = 0; i < 300; ++i) history.step(dimmed(static_cast<float>(i)), "", "");
  int steps = 0;
  HomeState now;
  for (; history.canUndo(); ++steps) now = history.undo(now);
  EXPECT_EQ(steps, 200);
  EXPECT_EQ(now, dimmed(100));
}

}  // namespace
}  // namespace roomlight::view
