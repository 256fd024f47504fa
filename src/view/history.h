// Steps that can be taken back, shared by all windows.
#pragma once

#include <string>
#include <vector>

#include "view/editable.h"

namespace roomlight::view {

class History {
 public:
  // `now` becomes `next`; edits of one gesture that follow each other are one step. An empty gesture is a step of its
  // own.
  void step(const HomeState& now, const std::string& label, const std::string& gesture);
  // The state before the newest step, if an edit of that gesture goes on with it; else null. Until the next change.
  const HomeState* startOf(const std::string& gesture) const;
  bool canUndo() const { return !past_.empty(); }
  bool canRedo() const { return !future_.empty(); }
  const std::string& undoLabel() const { return past_.back().label; }
  const std::string& redoLabel() const { return future_.back().label; }
  // The state before the newest step, or after the one taken back last.
  HomeState undo(const HomeState& now);
  HomeState redo(const HomeState& now);

 private:
  struct Step {
    HomeState state;
    std::string label;
  };
  static Step taken(std::vector<Step>& from, std::vector<Step>& to, const HomeState& now);
  std::vector<Step> past_, future_;
  std::string gesture_;  // of the newest step, if it may go on
};

}  // namespace roomlight::view
