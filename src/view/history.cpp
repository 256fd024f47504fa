#include "view/history.h"

namespace roomlight::view {
namespace {

constexpr size_t kMostSteps = 200;

}  // namespace

void History::step(const HomeState& now, const std::string& label, const std::string& gesture) {
  future_.clear();
  const bool goesOn = startOf(gesture) != nullptr;
  gesture_ = gesture;
  if (goesOn) return;
  past_.push_back({now, label});
  if (past_.size() > kMostSteps) past_.erase(past_.begin());
}

const HomeState* History::startOf(const std::string& gesture) const {
  return !gesture.empty() && gesture == gesture_ && !past_.empty() ? &past_.back().state : nullptr;
}

History::Step History::taken(std::vector<Step>& from, std::vector<Step>& to, const HomeState& now) {
  Step step = std::move(from.back());
  from.pop_back();
  to.push_back({now, step.label});
  return step;
}

HomeState History::undo(const HomeState& now) {
  gesture_.clear();
  return taken(past_, future_, now).state;
}

HomeState History::redo(const HomeState& now) {
  gesture_.clear();
  return taken(future_, past_, now).state;
}

}  // namespace roomlight::view
